//! The policy network: decisions with it, and what its features do not depend on.

use phase_agent::{
    BeliefView, Consideration, Contest, Mind, PhaseParameters, PolicyNetwork, Prior, policy::Features,
};
use phase_forward::Forward;
use phase_model::{
    Action, AgentId, BodySet, Scene, State,
    random::{Purpose, stream},
};
use phase_perception::observed_set;

/// An open arena; agent 0 at a place (u) with a heading (rad), and its landmark in a corner; agent 1 in the
/// centre with a heading, and its landmark.
fn scene([x, y, angle]: [f32; 3], landmark: u8, [heading, other]: [f32; 2]) -> Scene {
    let json = format!(
        r#"{{"layout": {{"base": 0}}, "objects": [], "event": "independent", "agents": [
        {{"size_level": 0, "strength_level": 2, "alpha": 0, "start": {{"x": {x}, "y": {y}, "angle": {angle}}},
         "goal": {{"kind": "agent_on_landmark", "agent": 0, "landmark": {landmark}, "sign": 1}}}},
        {{"size_level": 0, "strength_level": 2, "alpha": 0, "start": {{"x": 16, "y": 12, "angle": {heading}}},
         "goal": {{"kind": "agent_on_landmark", "agent": 1, "landmark": {other}, "sign": 1}}}}]}}"#
    );
    Scene::from_json(&json).expect("a scene")
}

fn mind(scene: &Scene, parameters: PhaseParameters) -> Mind<Forward> {
    Mind::new(scene, AgentId::ZERO, Forward::new(&scene.physics()), parameters).expect("a mind")
}

fn view<'a>(particles: &'a [State; 1], observed: BodySet) -> BeliefView<'a> {
    BeliefView { particles, suppositions: &[], observed, last_action: None, contest: Contest::default() }
}

fn considered(scene: &Scene) -> Consideration {
    let state = scene.initial_state();
    let observed = observed_set(&scene.physics(), &state, AgentId::ZERO);
    let considered = mind(scene, PhaseParameters::default()).consider(view(&[state], observed));
    considered.expect("something to choose")
}

/// The network that comes with the program is whole, and gives probabilities.
#[test]
fn the_bundled_network_gives_probabilities() {
    let Consideration { features, actions, .. } = considered(&scene([23.5, 12.0, 0.0], 1, [0.0, 0.0]));
    let found = PolicyNetwork::bundled().evaluate(&features, actions);
    assert_eq!(found.policy.len(), actions.len());
    assert!((found.policy.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(found.policy.iter().all(|p| *p > 0.0) && found.value.is_finite());
}

/// An agent that faces its landmark pushes forward; one that has it to its left or right turns or moves
/// there, seldom to the other side: with the network as prior of a short search, and alone.
#[test]
fn the_network_steers_to_the_goal() {
    let quarter = core::f32::consts::FRAC_PI_2;
    let left = [Action::TurnLeft, Action::Left, Action::UpLeft, Action::DownLeft];
    for (prior, simulations) in [(Prior::Network, 50), (Prior::NetworkAlone, 1000)] {
        for (angle, expected) in [(0.0, &[Action::Up][..]), (-quarter, &left), (quarter, &left)] {
            let scene = scene([23.5, 12.0, angle], 1, [0.0, 0.0]);
            let state = scene.initial_state();
            let observed = observed_set(&scene.physics(), &state, AgentId::ZERO);
            let parameters = PhaseParameters { prior, simulations, ..PhaseParameters::default() };
            let mut random = stream(1, Purpose::Search, 0);
            let decided = mind(&scene, parameters).decide(view(&[state], observed), &mut random);
            let (_, thought) = decided.expect("a decision");
            // What is right at a heading to the left is its mirror image at one to the right.
            let share = |mirrored: bool| -> f64 {
                let of = |action: Action| if mirrored { action.mirrored() } else { action };
                let found = thought.actions.iter().filter(|found| expected.contains(&of(found.action)));
                found.map(|found| f64::from(found.visits)).sum()
            };
            let all: f64 = thought.actions.iter().map(|found| f64::from(found.visits)).sum();
            let (right, wrong) = (share(angle > 0.0), if angle == 0.0 { 0.0 } else { share(angle <= 0.0) });
            assert!(right > 0.6 * all && wrong < 0.25 * all, "{} {angle}: {right} {wrong}", prior.name());
        }
    }
}

/// Without a search the visits are the network's probabilities, to within rounding.
#[test]
fn the_network_alone_reports_its_policy_as_visits() {
    let scene = scene([23.5, 12.0, 0.4], 1, [0.0, 0.0]);
    let state = scene.initial_state();
    let observed = observed_set(&scene.physics(), &state, AgentId::ZERO);
    let Consideration { features, actions, .. } = considered(&scene);
    let expected = PolicyNetwork::bundled().evaluate(&features, actions).policy;
    let parameters = PhaseParameters { prior: Prior::NetworkAlone, ..PhaseParameters::default() };
    let mut random = stream(1, Purpose::Search, 0);
    let decided = mind(&scene, parameters).decide(view(&[state], observed), &mut random);
    let (_, thought) = decided.expect("a decision");
    for (found, p) in thought.actions.iter().zip(expected) {
        assert!((f64::from(found.visits) / 1000.0 - p).abs() <= 0.0005 + 1e-9);
    }
}

/// Features are in the agent's frame: turned by a quarter about the arena's centre, everything is as before.
#[test]
fn features_do_not_depend_on_the_direction_of_the_world() {
    let quarter = core::f32::consts::FRAC_PI_2;
    let one = considered(&scene([23.0, 13.0, 0.3], 1, [0.0, 0.0])).features;
    // x, y becomes 16 - (y - 12), 12 + (x - 16), and each landmark the next one.
    let turned = considered(&scene([15.0, 19.0, 0.3 + quarter], 0, [quarter, 3.0])).features;
    let numbers = |features: &Features| -> Vec<f32> {
        features.shared.iter().chain(features.actions.as_flattened()).copied().collect()
    };
    // Ways are on a grid, on which not all directions are equally long.
    for (k, (a, b)) in numbers(&one).iter().zip(numbers(&turned)).enumerate() {
        assert!((a - b).abs() < 0.2, "feature {k}: {a} {b}");
    }
}
