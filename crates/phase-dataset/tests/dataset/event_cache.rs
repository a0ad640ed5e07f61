//! An event comes back from the cache as it was.

use crate::support::plain_event;
use phase_dataset::event_cache::EventCache;
use phase_event::BelievedIntent;
use phase_model::{Attitude, Awareness, Intent, Level, Sight};

#[test]
fn an_event_comes_back_with_its_seed_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = EventCache::new(folder.path(), [7; 32]);
    let mut event = plain_event(3);
    event.scene.agents[1].awareness =
        Awareness { sees: Sight::Objects, waits: 3, ..Awareness::ignorant(Level::Two) };
    let intent = Intent { attitude: Attitude::Hinder, goal: event.scene.agents[0].goal };
    event.steps[1].thoughts[1].intents.push(BelievedIntent { intent, particles: 7 });
    assert_eq!(cache.load("a", event.seed), None);
    cache.store("a", &event).expect("stored");
    assert_eq!(cache.load("a", event.seed), Some(event.clone()));
    assert_eq!(cache.load("a", event.seed - 1), None);
}
