//! Worlds stepped together have the bits of worlds stepped one by one.

#[allow(dead_code)]
mod scenes;

use phase_forward::{Exertion, Forward};
use phase_model::{
    AGENT_COUNT, Action, AgentBody, Body, Dynamics, Grip, ObjectId, PhysicsConfig, Side, State, Strength,
    Vec2, arena::SUBSTEPS,
};
use proptest::prelude::*;
use scenes::{physiques, separated_bodies};

/// Steps of each world.
const STEPS: usize = 12;
/// Most worlds of a batch.
const WORLDS: usize = 19;

/// Every bit of what a step may change.
fn bits(physics: &PhysicsConfig, state: &State) -> (Vec<u32>, [Option<Grip>; AGENT_COUNT], u32) {
    let numbers = |body: &Body| {
        let Body { position, velocity, angle, angular_velocity } = *body;
        [position.x, position.y, velocity.x, velocity.y, angle, angular_velocity].map(f32::to_bits)
    };
    let contacts = phase_model::Entity::ALL
        .into_iter()
        .flat_map(|a| phase_model::Entity::ALL.map(|b| (a, b)))
        .fold(0, |bits, (a, b)| bits << 1 | u32::from(state.contacts.touching(a, b)));
    let bodies = state.bodies[..physics.entity_count()].iter().flat_map(numbers).collect();
    (bodies, state.grips, contacts)
}

type StepAll = fn(&Forward, &mut [State], &[[Action; AGENT_COUNT]]);
type StepOne = fn(&Forward, &mut State, [Action; AGENT_COUNT]);

/// Steps all worlds with their caches together and one by one, by agents of any strength, and compares states, substeps and caches.
fn compare_warm(
    forward: &Forward,
    physics: &PhysicsConfig,
    starts: &[State],
    actions: &[Vec<[Action; AGENT_COUNT]>],
) -> Result<(), TestCaseError> {
    let mut states = starts.to_vec();
    let mut caches: Vec<_> = starts.iter().map(|state| forward.fresh_cache(state)).collect();
    for (step, actions) in actions.iter().enumerate() {
        let strength = |world: usize, agent: usize| Strength::ALL[(world * (agent + 1) + step) % 4];
        let exertion = |world: usize| Exertion {
            actions: actions[world],
            max_forces: [0, 1].map(|agent| strength(world, agent).max_force()),
        };
        let exertions: Vec<_> = (0..starts.len()).map(exertion).collect();
        let mut substeps = vec![[State::new([Body::default(); 4]); SUBSTEPS]; starts.len()];
        let (before, before_caches) = (states.clone(), caches.clone());
        forward.step_warm_batch(&mut states, &mut caches, &exertions, &mut substeps);
        for world in 0..starts.len() {
            let (mut state, mut cache) = (before[world], before_caches[world]);
            let alone = forward.step_warm_with(&mut state, &mut cache, &exertions[world]);
            let bits_of = |state: &State| bits(physics, state);
            let context =
                format!("step {step} of world {world}: {:?} from {:?}", exertions[world], before[world]);
            prop_assert_eq!(
                substeps[world].each_ref().map(bits_of),
                alone.each_ref().map(bits_of),
                "{}",
                context
            );
            prop_assert_eq!(bits_of(&states[world]), bits_of(&state), "{}", context);
            prop_assert_eq!(format!("{:?}", caches[world]), format!("{cache:?}"), "{}", context);
        }
    }
    Ok(())
}

/// Steps all worlds both ways and compares them after each step.
fn compare(
    forward: &Forward,
    physics: &PhysicsConfig,
    starts: &[State],
    actions: &[Vec<[Action; AGENT_COUNT]>],
) -> Result<(), TestCaseError> {
    let ways: [(&str, StepAll, StepOne); 2] = [
        ("exact", Forward::step_batch, |forward, state, actions| forward.step(state, actions)),
        ("coarse", Forward::step_approximate_batch, Forward::step_coarse),
    ];
    for (name, all, one) in ways {
        let mut together = starts.to_vec();
        for (step, actions) in actions.iter().enumerate() {
            let mut alone = together.clone();
            all(forward, &mut together, &actions[..starts.len()]);
            for (world, (state, &actions)) in alone.iter_mut().zip(actions).enumerate() {
                let before = *state;
                one(forward, state, actions);
                prop_assert_eq!(
                    bits(physics, &together[world]),
                    bits(physics, state),
                    "{} step {} of world {}: {:?} from {:?}",
                    name,
                    step,
                    world,
                    actions,
                    before
                );
            }
        }
    }
    Ok(())
}

/// Actions of all worlds in each step; grabbing and pushing are drawn more often than the rest.
fn actions() -> impl Strategy<Value = Vec<Vec<[Action; AGENT_COUNT]>>> {
    let action = || {
        prop_oneof![
            6 => prop::sample::select(Action::ALL.to_vec()),
            1 => Just(Action::Attach),
            2 => Just(Action::Up)
        ]
    };
    prop::collection::vec(prop::collection::vec([action(), action()], WORLDS), STEPS)
}

/// Bodies anywhere in the arena, even in walls and in each other, moving at up to a hundred units a second.
fn bodies() -> impl Strategy<Value = [Body; 4]> {
    let body = || {
        (6.1..25.9_f32, 2.1..21.9_f32, -70.0..70.0_f32, -70.0..70.0_f32, -20.0..20.0_f32, 0..3_u8).prop_map(
            |(x, y, vx, vy, angle, moves)| Body {
                position: Vec2::new(x, y),
                velocity: if moves == 0 { Vec2::new(vx, vy) } else { Vec2::ZERO },
                angle,
                angular_velocity: 0.0,
            },
        )
    };
    [body(), body(), body(), body()]
}

/// No grip, or one of any object at any side, wherever its object may be.
fn grips() -> impl Strategy<Value = [Option<Grip>; AGENT_COUNT]> {
    let grip = || {
        let side = prop::sample::select(Side::ALL.to_vec());
        prop::option::weighted(
            0.4,
            (0..2_u8, side, -1.0..1.0_f32).prop_map(|(object, side, relative_angle)| Grip {
                object: ObjectId::ALL[usize::from(object)],
                side,
                relative_angle,
            }),
        )
    };
    [grip(), grip()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Worlds that begin alike and in which different things are done.
    #[test]
    fn worlds_from_one_state((physics, state) in separated_bodies(), actions in actions(), worlds in 1..=WORLDS) {
        compare(&Forward::new(&physics), &physics, &vec![state; worlds], &actions)?;
        compare_warm(&Forward::new(&physics), &physics, &vec![state; worlds], &actions)?;
    }

    /// The same without collisions between bodies.
    #[test]
    fn worlds_of_points((physics, state) in separated_bodies(), actions in actions()) {
        let forward = Forward::new(&physics).without_collisions();
        compare(&forward, &physics, &[state; 8], &actions)?;
        compare_warm(&forward, &physics, &[state; 8], &actions)?;
    }

    /// Any states of one scene: overlapping, fast, with stretched grips.
    #[test]
    fn any_worlds(
        physics in physiques(),
        starts in prop::collection::vec((bodies(), grips()), WORLDS),
        actions in actions(),
    ) {
        let starts: Vec<State> = starts
            .into_iter()
            .map(|(bodies, grips)| State { grips, ..State::new(bodies) })
            .collect();
        compare(&Forward::new(&physics), &physics, &starts, &actions)?;
        compare_warm(&Forward::new(&physics), &physics, &starts, &actions)?;
    }
}

/// An agent's centre of mass stays inside the arena, and its position, which lies ahead of it, is moved there.
#[test]
fn agents_pulled_through_the_boundary() {
    let physics = PhysicsConfig {
        walls: Vec::new(),
        agents: [0.8, 1.2].map(|radius| AgentBody { radius, max_force: 150.0 }),
        object_radii: [0.8; 2],
        object_count: 1,
    };
    let body = |x, y, angle| Body { position: Vec2::new(x, y), angle, ..Body::default() };
    let [agent, holder, mut object, other] =
        [(18.0, 3.3, 0.0), (6.1, 22.0, -0.6), (15.2, 20.7, -0.6), (6.1, 2.1, 0.0)]
            .map(|(x, y, angle)| body(x, y, angle));
    (object.velocity, object.angular_velocity) = (Vec2::new(-1.4, -4.5), -0.5);
    // The object is far from its holder, which is therefore pulled and turned.
    let grip = Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 };
    let start = State { grips: [None, Some(grip)], ..State::new([agent, holder, object, other]) };
    let actions = vec![vec![[Action::NoForce; AGENT_COUNT]; 8]; STEPS];
    compare(&Forward::new(&physics), &physics, &[start; 8], &actions).expect("the same bits");
    compare_warm(&Forward::new(&physics), &physics, &[start; 8], &actions).expect("the same bits");
}

/// The planner's imagined dynamics have springs, which are stepped one by one.
#[test]
fn imagined_worlds() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let strategy = (separated_bodies(), actions());
    runner
        .run(&strategy, |((physics, state), actions)| {
            compare(&Forward::imagined(&physics), &physics, &[state; 8], &actions)?;
            compare_warm(&Forward::imagined(&physics), &physics, &[state; 8], &actions)
        })
        .unwrap_or_else(|error| panic!("{error}"));
}
