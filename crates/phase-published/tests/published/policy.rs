//! The policy network: decisions with it, and what its features do not depend on.

use crate::common::{ME, OTHER, ball_on, on_landmark, random, scene};
use core::f32::consts::FRAC_PI_2;
use phase_model::{Action, Attitude, Goal, LandmarkId, Scene, Strength};
use phase_published::{Consideration, Mind, PolicyNetwork, PublishedParameters, policy::Features};

fn mind(scene: &Scene) -> Mind {
    let parameters = PublishedParameters { network_alone: true, ..PublishedParameters::default() };
    Mind::new(scene, ME, parameters).unwrap()
}

fn considered(scene: &Scene) -> Consideration {
    mind(scene).consider(&[scene.initial_state()]).unwrap()
}

/// An open arena: the agent with its heading (rad) at a place (u), the other in the centre.
fn open(place: (f32, f32, f32), goal: Goal, other: f32) -> Scene {
    let bodies = [place, (16.0, 12.0, other), (8.0, 20.0, 0.0), (8.0, 4.0, 0.0)];
    let mut scene = scene(0, [goal, on_landmark(OTHER, LandmarkId::TOP_LEFT)], Attitude::Neutral, bodies);
    scene.objects.truncate(1);
    scene
}

/// The network that comes with the program is whole, and its policy is that of the decisions.
#[test]
fn the_network_alone_reports_its_policy_as_visits() {
    for goal in [on_landmark(ME, LandmarkId::TOP_RIGHT), ball_on(LandmarkId::BOTTOM_RIGHT)] {
        let scene = open((23.5, 12.0, 0.4), goal, 0.0);
        let Consideration { actions, features, .. } = considered(&scene);
        let (policy, value) = PolicyNetwork::bundled().evaluate(&features, &actions);
        assert!((policy.iter().sum::<f64>() - 1.0).abs() < 1e-12 && value.is_finite());
        let (_, thought) = mind(&scene).decide(&[scene.initial_state()], &mut random(1)).unwrap();
        assert!(thought.actions.iter().map(|found| found.action).eq(actions.iter().copied()));
        for (found, p) in thought.actions.iter().zip(&policy) {
            assert!((f64::from(found.visits) / 1000.0 - p).abs() <= 0.0005 + 1e-9);
        }
    }
}

/// The agent decides in states that are not finite, too.
#[test]
fn a_state_that_is_not_finite_is_no_reason_to_panic() {
    let scene = open((23.5, 12.0, 0.4), on_landmark(ME, LandmarkId::TOP_RIGHT), 0.0);
    for value in [f32::NAN, f32::INFINITY, f32::MAX] {
        for body in 0..3 {
            let mut state = scene.initial_state();
            (state.bodies[body].velocity.x, state.bodies[body].position.y) = (value, value);
            let (_, thought) = mind(&scene).decide(&[state], &mut random(1)).unwrap();
            assert!(!thought.actions.is_empty(), "{body}: {value}");
        }
    }
}

/// Actions are drawn in proportion to the fourth power of their probabilities.
#[test]
fn actions_are_drawn_by_the_policy() {
    const DRAWS: usize = 2000;
    let scene = open((23.5, 12.0, 0.9), on_landmark(ME, LandmarkId::TOP_RIGHT), 0.0);
    let Consideration { actions, features, .. } = considered(&scene);
    let (policy, _) = PolicyNetwork::bundled().evaluate(&features, &actions);
    let weights: Vec<f64> = policy.iter().map(|p| p.powi(4)).collect();
    let mut mind = mind(&scene);
    let mut random = random(3);
    let drawn: Vec<Action> =
        (0..DRAWS).map(|_| mind.decide(&[scene.initial_state()], &mut random).unwrap().0).collect();
    for (action, weight) in actions.iter().zip(&weights) {
        let share = drawn.iter().filter(|it| *it == action).count() as f64 / DRAWS as f64;
        let expected = weight / weights.iter().sum::<f64>();
        assert!((share - expected).abs() < 0.04, "{action:?}: {share}, {expected}");
    }
}

/// An agent pushes forward if it faces its landmark. If the landmark is to its left it seldom turns right,
/// and the other way round.
#[test]
fn the_network_steers_to_the_goal() {
    for (angle, wrong) in
        [(0.0, None), (-FRAC_PI_2, Some(Action::TurnRight)), (FRAC_PI_2, Some(Action::TurnLeft))]
    {
        let scene = open((23.5, 12.0, angle), on_landmark(ME, LandmarkId::TOP_RIGHT), 0.0);
        let Consideration { actions, features, .. } = considered(&scene);
        let (policy, _) = PolicyNetwork::bundled().evaluate(&features, &actions);
        let of = |action: Action| policy[actions.iter().position(|it| *it == action).unwrap()];
        match wrong {
            None => assert!(of(Action::Up) > 0.5, "{policy:?}"),
            Some(wrong) => assert!(of(wrong.mirrored()) > 2.0 * of(wrong), "{angle}: {policy:?}"),
        }
    }
}

/// Features are in the agent's frame: turned by a quarter about the arena's centre, everything is as before.
#[test]
fn features_do_not_depend_on_the_direction_of_the_world() {
    let without_objects = |mut scene: Scene| {
        scene.objects.clear();
        considered(&scene).features
    };
    let one = without_objects(open((23.0, 13.0, 0.3), on_landmark(ME, LandmarkId::TOP_RIGHT), 0.0));
    // x, y becomes 16 - (y - 12), 12 + (x - 16), and each landmark the next one.
    let turned = without_objects(open(
        (15.0, 19.0, 0.3 + FRAC_PI_2),
        on_landmark(ME, LandmarkId::TOP_LEFT),
        FRAC_PI_2,
    ));
    let numbers = |features: &Features| -> Vec<f32> {
        features.shared.iter().chain(features.actions.as_flattened()).copied().collect()
    };
    for (k, (a, b)) in numbers(&one).iter().zip(numbers(&turned)).enumerate() {
        assert!((a - b).abs() < 0.02, "feature {k}: {a} {b}");
    }
}

/// Futures that were imagined for other goals, from other places and by other bodies do not change what is
/// thought in a state.
#[test]
fn features_do_not_depend_on_what_was_considered_before() {
    let goals = [
        on_landmark(ME, LandmarkId::TOP_RIGHT),
        on_landmark(ME, LandmarkId::BOTTOM_LEFT),
        ball_on(LandmarkId::BOTTOM_RIGHT),
    ];
    let mut scenes: Vec<Scene> = Vec::new();
    for place in [(23.5, 12.0, 0.4), (23.5, 12.5, 0.4), (9.5, 18.0, 2.0)] {
        scenes.extend(goals.map(|goal| open(place, goal, 0.0)));
        scenes.extend(goals.map(|goal| {
            let mut stronger = open(place, goal, 0.0);
            stronger.agents[ME].strength = Strength::Mighty;
            stronger
        }));
    }
    // One thread knows what it imagined before.
    let alone = |scene: &Scene| {
        std::thread::scope(|scope| scope.spawn(|| considered(scene)).join().expect("a decision"))
    };
    for scene in scenes.iter().chain(scenes.iter().rev()) {
        assert_eq!(considered(scene).features, alone(scene).features);
    }
}
