//! The entities that are observed: by sight, touch and their consequences.

use crate::common::{BALL, BOX, ME, OTHER, any_physique, any_state, grip, looking, physics, with};
use phase_model::{AgentId, BodySet, Entity, Size, State};
use phase_perception::{observe, observed_set, sees};
use proptest::prelude::*;

/// All other bodies behind agent 0's back, out of its view, and far apart.
fn unseen() -> State {
    let state = with(looking((16.0, 16.0), 0.0), OTHER, (16.0, 10.0));
    with(with(state, BALL, (10.0, 6.0)), BOX, (22.0, 6.0))
}

fn touching(mut state: State, a: Entity, b: Entity) -> State {
    state.contacts.insert(a, b);
    state
}

fn holding(mut state: State, agent: usize, object: u8) -> State {
    state.grips[agent] = grip(object);
    state
}

#[test]
fn sight_touch_and_what_touches_that() {
    let seen = |entity| with(unseen(), entity, (16.0, 19.0));
    let cases: [(&str, State, &[Entity], &[Entity]); 12] = [
        ("nothing", unseen(), &[], &[]),
        ("an object in view", seen(BALL), &[BALL], &[]),
        ("an agent in view", seen(OTHER), &[OTHER], &[]),
        ("touched from behind", touching(unseen(), ME, OTHER), &[OTHER], &[OTHER]),
        ("an object held behind", holding(unseen(), 0, 1), &[BOX], &[BOX]),
        ("an object held by an agent in view", holding(seen(OTHER), 1, 0), &[OTHER, BALL], &[]),
        ("an agent that touches an object in view", touching(seen(BOX), OTHER, BOX), &[OTHER, BOX], &[]),
        ("objects that touch", touching(seen(BOX), BALL, BOX), &[BALL, BOX], &[]),
        (
            "the other holds what I touch",
            holding(touching(unseen(), ME, BALL), 1, 0),
            &[OTHER, BALL],
            &[BALL],
        ),
        ("the other holds what I hold", holding(holding(unseen(), 0, 0), 1, 0), &[OTHER, BALL], &[BALL]),
        (
            "a chain of three: what I touch touches another, which holds the last",
            holding(touching(touching(unseen(), ME, BALL), BALL, OTHER), 1, 1),
            &[OTHER, BALL, BOX],
            &[BALL],
        ),
        ("the others touch among themselves", touching(holding(unseen(), 1, 1), BALL, OTHER), &[], &[]),
    ];
    let physics = physics(Vec::new(), Size::Small);
    for (name, state, observed, touched) in cases {
        let observation = observe(&physics, &state, AgentId::ZERO);
        let expected = observed.iter().copied().chain([ME]).collect::<BodySet>();
        assert_eq!(observation.observed, expected, "{name}");
        assert_eq!(observed_set(&physics, &state, AgentId::ZERO), expected, "{name}");
        assert_eq!(observation.touched, touched.iter().copied().collect(), "{name}");
    }
}

#[test]
fn what_one_holds_hides_what_is_behind_it() {
    let physics = physics(Vec::new(), Size::Small);
    let ahead = with(looking((16.0, 8.0), 0.0), BOX, (16.0, 12.0));
    assert!(observed_set(&physics, &ahead, AgentId::ZERO).contains(BOX));
    let carrying = holding(with(ahead, BALL, (16.0, 9.6)), 0, 0);
    assert!(!observed_set(&physics, &carrying, AgentId::ZERO).contains(BOX));
}

#[test]
fn absent_objects_are_not_observed() {
    let mut physics = physics(Vec::new(), Size::Small);
    physics.object_count = 0;
    let state = holding(touching(with(unseen(), BALL, (16.0, 19.0)), ME, BOX), 0, 1);
    let observation = observe(&physics, &state, AgentId::ZERO);
    assert_eq!(observation.observed, [ME].into_iter().collect());
    assert!(observation.touched.is_empty());
}

proptest! {
    #[test]
    fn observed_is_the_closure_of_seen_and_felt(
        physics in any_physique(), state in any_state(), agent in 0_usize..2,
    ) {
        let observation = observe(&physics, &state, AgentId::ALL[agent]);
        prop_assert_eq!(observation.observed, observed_set(&physics, &state, AgentId::ALL[agent]));
        // Reachability over links of touch, by Warshall.
        let entities = || physics.entities();
        let mut linked = [[false; 4]; 4];
        for (a, b) in entities().flat_map(|a| entities().map(move |b| (a, b))) {
            linked[a.index()][b.index()] = a == b || state.touching(a, b);
        }
        for via in 0..4 {
            for from in 0..4 {
                for to in 0..4 {
                    linked[from][to] |= linked[from][via] && linked[via][to];
                }
            }
        }
        let own = Entity::Agent(AgentId::ALL[agent]);
        let sources: Vec<_> =
            entities().filter(|&it| it == own || sees(&physics, &state, AgentId::ALL[agent], it)).collect();
        let expected: BodySet = entities()
            .filter(|entity| sources.iter().any(|source| linked[source.index()][entity.index()]))
            .collect();
        prop_assert_eq!(observation.observed, expected);
    }

    #[test]
    fn what_is_observed_is_the_truth_and_the_rest_is_silence(
        physics in any_physique(), state in any_state(), elsewhere in any_state(), agent in 0_usize..2,
    ) {
        let observation = observe(&physics, &state, AgentId::ALL[agent]);
        for entity in physics.entities() {
            let known = observation.observed.contains(entity);
            prop_assert_eq!(observation.body(entity), known.then(|| state.body(entity)));
            for other in physics.entities() {
                let either = known || observation.observed.contains(other);
                let expected = either.then(|| state.touching(entity, other));
                prop_assert_eq!(observation.touching(entity, other), expected);
            }
        }
        for other in AgentId::ALL {
            let known = observation.observed.contains(Entity::Agent(other));
            prop_assert_eq!(observation.grip(other), known.then(|| state.grips[other]));
        }

        // Moving unobserved bodies to other unobserved positions makes no difference, unless they occluded
        // cells of their own footprint.
        let mut other = state;
        for entity in physics.entities().filter(|&entity| !observation.observed.contains(entity)) {
            *other.body_mut(entity) = *elsewhere.body(entity);
        }
        let moved = observe(&physics, &other, AgentId::ALL[agent]);
        if moved.observed == observation.observed && moved.visible == observation.visible {
            prop_assert_eq!(moved, observation);
        }
    }
}
