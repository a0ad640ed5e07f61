//! The input of the policy network: a decision in numbers.

use crate::{
    habits,
    objective::{KINDS, Objective},
    rollout_policy,
    search_model::{SearchModel, SearchState},
};
use phase_model::{Action, AgentId, Attitude, Body, Dynamics, Entity, MAX_OBJECTS, ObjectId, State, Vec2};
use phase_predicates::achieved;

/// Number of all actions.
const ACTIONS: usize = Action::ALL.len();
/// Of an object: present, place, gap, velocity, held by either, touched, meant, within reach.
const OF_OBJECT: usize = 11;
/// Of the other agent: place, gap, velocity, heading, in motion, touched, holding the same, way, turn.
const OF_OTHER: usize = 13;
/// Of the agent: velocity, radius, acceleration, strength relative to the other, free hands, releasing.
const OF_SELF: usize = 7;
/// Of the way: the moved body is an object, direction, length, velocity along and across, turn, Φ twice,
/// whether there is something to grasp, and the kind of pursuit.
const OF_WAY: usize = 10 + KINDS;
/// Of goals: attitude, whether they are rewarded, which of them hold.
const OF_GOALS: usize = 6;
/// Features of a decision that all its actions have in common: those above, whether the agent has acted, and
/// the greatest imagined return.
pub const SHARED: usize = 2 + OF_SELF + OF_WAY + OF_OTHER + MAX_OBJECTS * OF_OBJECT + OF_GOALS;
/// Imagined futures of an action.
const FUTURES: usize = 5;
/// Features of an action: its prior by habit, whether it was the last, whether the heuristic takes it; the
/// approach and the reward of each future, as they are and among those of all actions; which action it is.
pub const OF_ACTION: usize = 3 + 4 * FUTURES + ACTIONS;

/// Scale of distances (u).
const LENGTH: f32 = 10.0;
/// Scale of gaps and of changes of Φ (u): those that matter for the next steps are small.
const NEAR: f32 = 2.0;
/// Scale of speeds (u/s).
const SPEED: f32 = 10.0;
/// Scale of accelerations (u/s²).
const ACCELERATION: f32 = 50.0;
/// Greatest size of a feature without a bound of its own.
const BOUND: f32 = 10.0;
/// Steps after which a future is looked at in which an action is repeated.
const REPEATED: [usize; 3] = [1, 2, 4];
/// Steps after which a future is looked at in which the heuristic follows an action.
const FOLLOWED: [usize; 2] = [5, 10];
/// Smallest range of numbers that are put in relation to one another.
const LEAST_RANGE: f32 = 1e-4;

/// A decision in numbers, for the policy network.
///
/// All directions are in the agent's frame, so that what is learnt in one place holds in all others.
#[derive(Clone, PartialEq, Debug)]
pub struct Features {
    /// Features that all actions have in common.
    pub shared: [f32; SHARED],
    /// Of each action, in the order of [`Action::ALL`]; zeros for those that are not searched.
    pub actions: [[f32; OF_ACTION]; ACTIONS],
}

impl Features {
    /// All zeros.
    pub(crate) const NONE: Self = Self { shared: [0.0; SHARED], actions: [[0.0; OF_ACTION]; ACTIONS] };

    /// The features of a decision in a state.
    pub(crate) fn of<D: Dynamics>(model: &SearchModel<'_, D>, search_state: &SearchState) -> Self {
        let objective = &model.objective;
        let state = search_state.state();
        let frame = Frame::of(state, objective.agent());
        let (actions, greatest) = of_actions(model, search_state);
        let mut list = List { values: [0.0; SHARED], length: 0 };
        list.flag(search_state.last_action().is_none());
        list.push(greatest);
        list.myself(objective, state, frame);
        list.way(objective, state, frame, search_state.distance());
        list.other(model, state, frame);
        for object in ObjectId::ALL {
            list.object(objective, state, frame, object);
        }
        list.goals(model, state);
        Self { shared: list.values, actions }
    }

    /// Adds a share of other features.
    pub(crate) fn add(&mut self, other: &Self, share: f32) {
        let ours = self.shared.iter_mut().chain(self.actions.as_flattened_mut());
        let theirs = other.shared.iter().chain(other.actions.as_flattened());
        ours.zip(theirs).for_each(|(ours, theirs)| *ours += share * theirs);
    }
}

/// The features of every action, and the greatest return of the longest future.
fn of_actions<D: Dynamics>(
    model: &SearchModel<'_, D>,
    search_state: &SearchState,
) -> ([[f32; OF_ACTION]; ACTIONS], f32) {
    let heuristic = rollout_policy::action(&model.objective, search_state.state());
    let context = search_state.context(heuristic);
    let futures: Vec<[f32; 2 * FUTURES]> =
        model.actions.iter().map(|&action| futures(model, search_state, action)).collect();
    let bound = |k: usize, start: f32, pick: fn(f32, f32) -> f32| {
        futures.iter().map(|of_action| of_action[k]).fold(start, pick)
    };
    let least: [f32; 2 * FUTURES] = core::array::from_fn(|k| bound(k, f32::INFINITY, f32::min));
    let greatest: [f32; 2 * FUTURES] = core::array::from_fn(|k| bound(k, f32::NEG_INFINITY, f32::max));
    let mut features = [[0.0; OF_ACTION]; ACTIONS];
    for (&action, futures) in model.actions.iter().zip(&futures) {
        let of_action = &mut features[action.index()];
        let weight = habits::weight(action, &model.objective, search_state.state(), context);
        of_action[0] = libm::log(weight) as f32;
        of_action[1] = f32::from(u8::from(Some(action) == search_state.last_action()));
        of_action[2] = f32::from(u8::from(action == heuristic));
        for (k, &number) in futures.iter().enumerate() {
            let range = greatest[k] - least[k];
            of_action[3 + 2 * k] = number;
            of_action[4 + 2 * k] = if range > LEAST_RANGE { (number - least[k]) / range } else { 0.0 };
        }
        of_action[3 + 4 * FUTURES + action.index()] = 1.0;
    }
    (features, greatest[2 * FUTURES - 1].clamp(-BOUND, BOUND))
}

/// By how much Φ shrinks in each imagined future of an action, and the sum of its rewards.
fn futures<D: Dynamics>(
    model: &SearchModel<'_, D>,
    search_state: &SearchState,
    action: Action,
) -> [f32; 2 * FUTURES] {
    let mut numbers = [0.0; 2 * FUTURES];
    let mut places = numbers.chunks_exact_mut(2);
    let mut first = *search_state;
    let first_reward = model.imagine(&mut first, action).reward as f32;
    let mut follow = |until: &[usize], next: &dyn Fn(&SearchState) -> Action| {
        let (mut after, mut reward, mut steps) = (first, first_reward, 1);
        for &until in until {
            while steps < until {
                let next = next(&after);
                reward += model.imagine(&mut after, next).reward as f32;
                steps += 1;
            }
            if let Some(place) = places.next() {
                let approach = (search_state.distance() - after.distance()) / NEAR;
                place.copy_from_slice(&[approach.clamp(-BOUND, BOUND), reward.clamp(-BOUND, BOUND)]);
            }
        }
    };
    follow(&REPEATED, &|_| action);
    follow(&FOLLOWED, &|after| rollout_policy::action(&model.objective, after.state()));
    numbers
}

/// The agent's frame.
#[derive(Clone, Copy)]
struct Frame {
    body: Body,
    forward: Vec2,
}

impl Frame {
    fn of(state: &State, agent: AgentId) -> Self {
        let body = *state.body(Entity::Agent(agent));
        Self { body, forward: body.forward() }
    }

    /// A direction of the world: to the right and forward.
    fn vector(&self, vector: Vec2) -> Vec2 {
        let right = Vec2::new(self.forward.y, -self.forward.x);
        Vec2::new(vector.dot(right), vector.dot(self.forward))
    }
}

/// Shared features so far.
struct List {
    values: [f32; SHARED],
    length: usize,
}

impl List {
    fn push(&mut self, value: f32) {
        self.values[self.length] = value;
        self.length += 1;
    }

    fn flag(&mut self, flag: bool) {
        self.push(f32::from(u8::from(flag)));
    }

    fn vector(&mut self, vector: Vec2) {
        self.push(vector.x);
        self.push(vector.y);
    }

    fn myself(&mut self, objective: &Objective<'_>, state: &State, frame: Frame) {
        let agents = objective.physics().agents;
        let me = agents[objective.agent()];
        let other = agents[objective.agent().other()];
        self.vector(frame.vector(frame.body.velocity) / SPEED);
        self.push(me.radius);
        self.push(me.max_force / me.mass() / ACCELERATION);
        self.push(libm::logf(me.max_force / other.max_force));
        self.flag(rollout_policy::is_free(state, objective.agent()));
        self.flag(objective.releases(state));
    }

    fn way(&mut self, objective: &Objective<'_>, state: &State, frame: Frame, distance: f32) {
        let motion = objective.motion(state);
        let way = motion.waypoint - state.position(motion.entity);
        let direction = way.normalize_or_zero();
        let velocity = state.body(motion.entity).velocity;
        self.flag(matches!(motion.entity, Entity::Object(_)));
        self.vector(frame.vector(direction));
        self.push(way.length() / NEAR);
        self.push(velocity.dot(direction) / SPEED);
        self.push(velocity.perp_dot(direction) / SPEED);
        self.push(motion.turn);
        self.push((distance / LENGTH).min(BOUND));
        self.push(libm::tanhf(distance / NEAR));
        self.flag(objective.wanted_object(state).is_some());
        self.values[self.length + objective.kind()] = 1.0;
        self.length += KINDS;
    }

    fn other<D: Dynamics>(&mut self, model: &SearchModel<'_, D>, state: &State, frame: Frame) {
        let objective = &model.objective;
        let me = objective.agent();
        let other = Entity::Agent(me.other());
        let body = state.body(other);
        let held = state.held_object(me);
        let away = body.position - frame.body.position;
        let physics = objective.physics();
        self.vector(frame.vector(away) / LENGTH);
        self.push(((away.length() - physics.radius(other) - physics.agents[me].radius) / NEAR).min(BOUND));
        self.vector(frame.vector(body.velocity - frame.body.velocity) / SPEED);
        self.vector(frame.vector(body.forward()));
        self.flag(body.velocity.length() > objective.parameters().moving_speed);
        self.flag(state.contacts.touching(Entity::Agent(me), other));
        self.flag(held.is_some() && held == state.held_object(me.other()));
        let motion = model.other_objective.motion(state);
        let way = (motion.waypoint - state.position(motion.entity)).normalize_or_zero();
        self.vector(frame.vector(way));
        self.push(motion.turn);
    }

    fn object(&mut self, objective: &Objective<'_>, state: &State, frame: Frame, object: ObjectId) {
        let physics = objective.physics();
        if object.index() >= physics.object_count {
            self.length += OF_OBJECT;
            return;
        }
        let me = objective.agent();
        let entity = Entity::Object(object);
        let body = state.body(entity);
        let away = body.position - frame.body.position;
        self.flag(true);
        self.vector(frame.vector(away) / LENGTH);
        self.push(((away.length() - physics.radius(entity) - physics.agents[me].radius) / NEAR).min(BOUND));
        self.vector(frame.vector(body.velocity - frame.body.velocity) / SPEED);
        self.flag(state.holds(me, object));
        self.flag(state.holds(me.other(), object));
        self.flag(state.contacts.touching(Entity::Agent(me), entity));
        self.flag(objective.object() == Some(object));
        self.flag(state.attachable(physics, me).is_some_and(|(nearest, _)| nearest == object));
    }

    fn goals<D>(&mut self, model: &SearchModel<'_, D>, state: &State) {
        let me = model.objective.agent();
        for attitude in [Attitude::Neutral, Attitude::Help, Attitude::Hinder] {
            self.flag(model.attitude == attitude);
        }
        self.flag(model.rewards_goals);
        for agent in [me, me.other()] {
            self.flag(achieved(model.physics, state, model.goals[agent]));
        }
    }
}
