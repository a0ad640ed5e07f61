//! Every kind of scene keeps its promises.

use phase_model::{
    Attitude, EventKind, Layout, Relation, Sign,
    random::{Purpose, stream},
};
use phase_predicates::achieved;
use phase_sampler::sample;

/// Scenes drawn of each kind.
const SCENES: u64 = 40;

#[test]
fn scenes_keep_the_promises_of_their_kind() {
    let used: Vec<Layout> = Layout::all_used().collect();
    for kind in EventKind::ALL {
        let mut layouts = std::collections::BTreeSet::new();
        for index in 0..SCENES {
            let scene = sample(kind, &mut stream(7, Purpose::Scene, index)).unwrap();
            assert_eq!(scene.kind, kind);
            assert_eq!(scene.validate_apart(), Ok(()), "{kind:?} {index}");
            assert!(used.contains(&scene.layout));
            layouts.insert(scene.layout);
            let (physique, state) = (scene.physique(), scene.initial_state());
            for goal in scene.goals() {
                let wanted = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
                assert!(!achieved(&physique, &state, wanted), "{kind:?} {index} starts solved");
            }
            let (relation, attitude) = match kind {
                EventKind::Helping => (Relation::Friendly, Attitude::Help),
                EventKind::Hindering => (Relation::Adversarial, Attitude::Hinder),
                EventKind::Chasing | EventKind::Competing => (Relation::Adversarial, Attitude::Neutral),
                EventKind::Collaborating => (Relation::Friendly, Attitude::Neutral),
                EventKind::Independent => (Relation::Neutral, Attitude::Neutral),
            };
            assert_eq!(scene.relation(), relation, "{kind:?} {index}");
            assert_eq!(scene.attitudes(), [attitude, Attitude::Neutral], "{kind:?} {index}");
        }
        assert!(layouts.len() > 12, "{kind:?} uses only {} layouts", layouts.len());
    }
}

#[test]
fn one_stream_one_scene() {
    for kind in EventKind::ALL {
        let draw = |index| sample(kind, &mut stream(3, Purpose::Scene, index)).unwrap();
        assert_eq!(draw(0), draw(0));
        assert_ne!(draw(0), draw(1));
    }
}
