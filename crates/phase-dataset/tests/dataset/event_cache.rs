//! An event comes back from the cache as it was.

use crate::support::plain_event;
use phase_dataset::event_cache::EventCache;

#[test]
fn an_event_comes_back_with_its_seed_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = EventCache::new(folder.path(), [7; 32]);
    let event = plain_event(3);
    assert_eq!(cache.load("a", event.seed), None);
    cache.store("a", &event).expect("stored");
    assert_eq!(cache.load("a", event.seed), Some(event.clone()));
    assert_eq!(cache.load("a", event.seed - 1), None);
}
