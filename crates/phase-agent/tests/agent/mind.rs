//! Steering, action sets, reward and decisions in hand-made states.

use phase_agent::{
    AscribedPolicy, BeliefView, HabitPolicy, Mind, PhaseParameters, Scrutiny, TheoryParameters, action_set,
    objective::Objective,
    rollout_policy,
    search_model::{SearchModel, SearchState},
};
use phase_belief::{Belief, Contest};
use phase_forward::Forward;
use phase_model::{
    Action, AgentId, AgentSpec, Attitude, Body, BodySet, Dynamics, Entity, EventKind, Goal, Grip, LandmarkId,
    Layout, Literal, ObjectId, ObjectSpec, PhysicsConfig, Predicate, PredicateTarget, Scene, Side, Sign,
    Size, State, Strength, Subgoal, Vec2, arena,
    random::{Purpose, stream},
};
use phase_navigation::Navigator;
use phase_perception::observe;
use phase_pomcp::GenerativeModel;

const ON_2: Goal =
    Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark: LandmarkId::BOTTOM_RIGHT, sign: Sign::Positive };
const OTHER_ON_0: Goal =
    Goal::AgentOnLandmark { agent: AgentId::ONE, landmark: LandmarkId::TOP_LEFT, sign: Sign::Positive };

/// No walls; agent 0 at a point with a heading, agent 1 and the object out of the way.
fn scene(position: Vec2, angle: f32) -> Scene {
    let agent = |position, angle, goal| AgentSpec {
        size: Size::Small,
        strength: Strength::Strong,
        goal,
        attitude: Attitude::Neutral,
        awareness: phase_model::Awareness::default(),
        start: Body::at_rest(position, angle),
    };
    Scene {
        layout: Layout::new(0, None).expect("layout 0"),
        agents: [agent(position, angle, ON_2), agent(Vec2::new(9.0, 7.0), 0.0, OTHER_ON_0)],
        objects: vec![ObjectSpec { size: Size::Small, start: Body::at_rest(Vec2::new(9.0, 14.0), 0.0) }],
        kind: EventKind::Independent,
    }
}

fn achieve(predicate: Predicate) -> Subgoal {
    Subgoal::Achieve(Literal::is(predicate))
}

/// A subgoal of agent 0, compiled in a state, by a mind that believes that the other agent only coasts.
fn compiled<'a>(physics: &'a PhysicsConfig, scene: &Scene, state: &State, subgoal: Subgoal) -> Objective<'a> {
    let parameters = PhaseParameters { other_initiative: 0.0, ..PhaseParameters::default() };
    let costs = parameters.navigation();
    let mut navigator = Navigator::new(scene.layout, costs);
    Objective::new(physics, &mut navigator, state, AgentId::ZERO, subgoal, &parameters)
}

/// The heuristic's action for a subgoal of agent 0.
fn heuristic(scene: &Scene, state: &State, subgoal: Subgoal) -> Action {
    rollout_policy::action(&compiled(&scene.physics(), scene, state, subgoal), state)
}

#[test]
fn the_heuristic_turns_goes_and_stops() {
    let to_landmark = achieve(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::BOTTOM_RIGHT));
    // Landmark 2 lies at (23.5, 4.5); heading π faces down.
    let above = Vec2::new(23.5, 14.0);
    for (angle, expected) in [
        (core::f32::consts::PI, Action::Up),
        (core::f32::consts::PI - 1.2, Action::TurnLeft),
        (core::f32::consts::PI + 1.2, Action::TurnRight),
    ] {
        let scene = scene(above, angle);
        assert_eq!(heuristic(&scene, &scene.initial_state(), to_landmark), expected, "{angle}");
    }
    let near = scene(Vec2::new(23.5, 5.5), core::f32::consts::PI);
    let mut fast = near.initial_state();
    fast.bodies[0].velocity = Vec2::new(0.0, -20.0);
    assert_eq!(heuristic(&near, &fast, to_landmark), Action::Stop);
}

#[test]
fn the_heuristic_attaches_and_detaches() {
    let beside = scene(Vec2::new(9.0, 12.3), 0.0);
    let attach = achieve(Predicate::Attach(AgentId::ZERO, ObjectId::ZERO));
    assert_eq!(heuristic(&beside, &beside.initial_state(), attach), Action::Attach);
    let mut holding = beside.initial_state();
    holding.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    let release = Subgoal::Achieve(Literal::not(Predicate::Attach(AgentId::ZERO, ObjectId::ZERO)));
    assert_eq!(heuristic(&beside, &holding, release), Action::Detach);
}

#[test]
fn every_subgoal_has_its_actions() {
    let close = achieve(Predicate::Close(
        Entity::Agent(AgentId::ZERO),
        PredicateTarget::Landmark(LandmarkId::TOP_RIGHT),
    ));
    let carry = achieve(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::TOP_RIGHT));
    let release = Subgoal::Achieve(Literal::not(Predicate::Attach(AgentId::ZERO, ObjectId::ZERO)));
    for (subgoal, count) in [
        (Subgoal::Stay, 1),
        (close, 12),
        (achieve(Predicate::Touch(AgentId::ZERO, Entity::Agent(AgentId::ONE))), 12),
        (achieve(Predicate::Attach(AgentId::ZERO, ObjectId::ZERO)), 13),
        (carry, 12),
        (release, 3),
    ] {
        assert_eq!(action_set::actions(AgentId::ZERO, subgoal).len(), count, "{subgoal}");
    }
}

#[test]
fn rewards_follow_equation_1() {
    // Agent 0 rests on its landmark, agent 1 on its own; the subgoal is 10 u away.
    let mut scene = scene(Vec2::new(23.5, 4.5), 0.0);
    scene.agents[1].start.position = Vec2::new(8.5, 19.5);
    // Weak enough that one push does not carry it off the landmark.
    scene.agents[0].strength = Strength::Weak;
    let physics = scene.physics();
    let state = scene.initial_state();
    let forward = Forward::new(&physics);
    let subgoal = achieve(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::TOP_RIGHT));
    let objective = compiled(&physics, &scene, &state, subgoal);
    let other_objective = compiled(&physics, &scene, &state, Subgoal::Stay);
    let goals = [ON_2, OTHER_ON_0];
    for (attitude, social) in [(Attitude::Neutral, 1.0), (Attitude::Help, 1.0), (Attitude::Hinder, -1.0)] {
        for (action, cost) in [(Action::Stop, 0.0), (Action::Left, 0.02)] {
            let actions = [action];
            let model = SearchModel {
                dynamics: &forward,
                physics: &physics,
                objective: objective.clone(),
                other_objective: other_objective.clone(),
                actions: &actions,
                goals,
                rewards_goals: true,
                attitude,
                scrutiny: None,
                root_prior: Vec::new(),
            };
            let mut after = SearchState::new(&objective, state, None);
            let reward = model.rollout_step(&mut after, 0, &mut stream(1, Purpose::Search, 0)).reward;
            let mut by_hand = state;
            forward.step_approximate(&mut by_hand, [action, Action::NoForce]);
            assert_eq!(*after.state(), by_hand);
            let distance = objective.distance(&by_hand);
            assert!((distance - 15.0).abs() < 0.7, "landmark 1 is 15 u above landmark 2: {distance}");
            let expected = social - cost - f64::from(distance / arena::DIAGONAL);
            assert!((reward - expected).abs() < 1e-6, "{attitude:?} {action:?}: {reward} {expected}");
            // While an agent goes to verify whether a goal holds, no satisfied goal is rewarded.
            let looking = SearchModel { rewards_goals: false, ..model };
            let mut after = SearchState::new(&objective, state, None);
            let reward = looking.rollout_step(&mut after, 0, &mut stream(1, Purpose::Search, 0)).reward;
            assert!((reward - (expected - social)).abs() < 1e-6, "{attitude:?} {action:?}: {reward}");
        }
    }
}

/// Agent 0 wants to hinder on its way up to landmark 1; a pretext would send it down to landmark 2.
///
/// While agent 1 looks, a step up makes hindering likelier, and more so than a turn towards the pretext, by
/// Bayes' rule with the habits as likelihoods; while it looks away, neither tells anything.
#[test]
fn being_seen_through_costs() {
    const POSSIBLE: usize = 16;
    let theory = TheoryParameters::default();
    let up = achieve(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::TOP_RIGHT));
    let down = achieve(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::BOTTOM_RIGHT));
    // Agent 1 stands in the same room, 6 u above agent 0, and looks down or up.
    let mut scene = scene(Vec2::new(23.5, 11.0), 0.0);
    scene.agents[1].start.position = Vec2::new(23.5, 17.0);
    let physics = scene.physics();
    let forward = Forward::new(&physics);
    let cost = |angle: f32, action: Action| {
        let mut scene = scene.clone();
        scene.agents[1].start.angle = angle;
        let state = scene.initial_state();
        let objective = compiled(&physics, &scene, &state, up);
        let pretext = compiled(&physics, &scene, &state, down);
        let each = 1.0 / POSSIBLE as f64;
        let actions = [action];
        let reward = |scrutiny: Option<Scrutiny<'_>>| {
            let model = SearchModel {
                dynamics: &forward,
                physics: &physics,
                objective: objective.clone(),
                other_objective: compiled(&physics, &scene, &state, Subgoal::Stay),
                actions: &actions,
                goals: [ON_2, OTHER_ON_0],
                rewards_goals: true,
                attitude: Attitude::Hinder,
                scrutiny,
                root_prior: Vec::new(),
            };
            let mut after = SearchState::new(&model.objective, state, None);
            if let Some(scrutiny) = &model.scrutiny {
                after = after.under(scrutiny);
            }
            model.rollout_step(&mut after, 0, &mut stream(1, Purpose::Search, 0)).reward
        };
        let scrutiny = Scrutiny::new(each, vec![(pretext.clone(), each, 1)], POSSIBLE, theory);
        let likelihood = |objective: &Objective<'_>| {
            let weights = HabitPolicy { sharpness: theory.sharpness }.weights(objective, &state, None);
            let share = weights[action.index()] / weights.iter().sum::<f64>();
            ((1.0 - theory.lapse) * share + theory.lapse / Action::ALL.len() as f64)
                .powf(theory.inverse_temperature)
        };
        let [own, other] = [likelihood(&objective), likelihood(&pretext)];
        let others = (1.0 / Action::ALL.len() as f64).powf(theory.inverse_temperature);
        let posterior = each * own / (each * (own + other) + (1.0 - 2.0 * each) * others);
        let expected = theory.discretion * ((1.0 - theory.forgetting) * posterior + theory.forgetting * each);
        (reward(None) - reward(Some(scrutiny)), expected)
    };
    let before = theory.discretion / POSSIBLE as f64;
    let feint = heuristic(&scene, &scene.initial_state(), down);
    assert_ne!(feint, Action::Up);
    let costs = [Action::Up, feint].map(|action| {
        let (seen, expected) = cost(core::f32::consts::PI, action);
        assert!((seen - expected).abs() < 1e-9, "{action:?}: {seen} {expected}");
        let (unseen, _) = cost(0.0, action);
        assert!((unseen - before).abs() < 1e-9, "{action:?}: {unseen} {before}");
        seen
    });
    assert!(costs[0] > before && costs[1] < 0.8 * costs[0], "{costs:?}, {before} unseen");
}

/// The first decision of agent 0 with a small search.
fn decide(scene: &Scene, seed: u64) -> (Action, Subgoal) {
    let physics = scene.physics();
    let state = scene.initial_state();
    let observation = observe(&physics, &state, AgentId::ZERO);
    let parameters = PhaseParameters { simulations: 300, particles: 20, ..PhaseParameters::default() };
    let mut random = stream(seed, Purpose::Belief, 0);
    let belief = Belief::new(&physics, &observation, parameters.particles, &mut random);
    let mut mind =
        Mind::new(scene, AgentId::ZERO, Forward::new(&physics), parameters).expect("good parameters");
    let view = BeliefView {
        particles: belief.particles(),
        observed: observation.observed,
        last_action: None,
        suppositions: &[],
        contest: belief.contest(),
    };
    let (action, thought) = mind.decide(view, &mut stream(seed, Purpose::Search, 0)).expect("a decision");
    (action, thought.subgoal)
}

#[test]
fn a_landmark_straight_ahead_is_walked_to_and_then_stayed_on() {
    for seed in 0..5 {
        let ahead = scene(Vec2::new(23.5, 14.0), core::f32::consts::PI);
        assert_eq!(
            decide(&ahead, seed),
            (Action::Up, achieve(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::BOTTOM_RIGHT))),
            "{seed}"
        );
        let there = scene(Vec2::new(23.5, 4.5), 0.0);
        assert_eq!(decide(&there, seed), (Action::Stop, Subgoal::Stay), "{seed}");
    }
}

#[test]
fn an_object_within_reach_is_taken() {
    for seed in 0..5 {
        let mut beside = scene(Vec2::new(9.0, 12.3), 0.0);
        beside.agents[0].goal = Goal::ObjectOnLandmark {
            object: ObjectId::ZERO,
            landmark: LandmarkId::TOP_RIGHT,
            sign: Sign::Positive,
        };
        assert_eq!(
            decide(&beside, seed),
            (Action::Attach, achieve(Predicate::Attach(AgentId::ZERO, ObjectId::ZERO))),
            "{seed}"
        );
    }
}

#[test]
fn an_object_in_the_hands_of_another_out_of_sight_is_looked_after() {
    let mut scene = scene(Vec2::new(8.5, 19.5), 0.0);
    let object = ObjectId::ZERO;
    let landmark = LandmarkId::BOTTOM_RIGHT;
    scene.agents[0].goal = Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive };
    scene.objects[0].start.position = Vec2::new(23.5, 4.5);
    scene.agents[1].start.position = Vec2::new(23.5, 7.0);
    let lying = scene.initial_state();
    let mut carried = lying;
    carried.grips[1] = Some(Grip { object, side: Side::Head, relative_angle: 0.0 });
    let physics = scene.physics();
    let mut observed = BodySet::EMPTY;
    observed.insert(Entity::Agent(AgentId::ZERO));
    let subgoal = |state: State| {
        let parameters = PhaseParameters { simulations: 20, ..PhaseParameters::default() };
        let mut mind =
            Mind::new(&scene, AgentId::ZERO, Forward::new(&physics), parameters).expect("good parameters");
        let view = BeliefView {
            particles: &[state; 4],
            observed,
            last_action: None,
            suppositions: &[],
            contest: Contest::default(),
        };
        mind.decide(view, &mut stream(1, Purpose::Search, 0)).expect("a decision").1.subgoal
    };
    // All particles agree on where the object is, but only one that lies stays there.
    assert_eq!(subgoal(lying), Subgoal::Stay);
    assert_ne!(subgoal(carried), Subgoal::Stay);
}
