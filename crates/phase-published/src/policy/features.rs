//! The input of the policy network: a search in numbers.

use super::futures::{self, BEFORE_FORWARD, FORWARD, Futures, MOST_REPEATED};
use crate::{aim::Aim, search::Task};
use phase_model::{Action, AgentId, Body, Entity, MAX_OBJECTS, ObjectId, RoomId, Sign, State, Vec2, arena};

/// Number of all actions.
pub(super) const ACTIONS: usize = Action::ALL.len();
/// Of the agent: velocity, radius, acceleration, strength relative to the other, free hands.
const OF_SELF: usize = 6;
/// Kinds of subgoals that are searched for.
const KINDS: usize = 6;
/// Of the subgoal: its kind, sign, distance twice; whose body is to move, its place and velocity; the place
/// of the target.
const OF_AIM: usize = KINDS + 4 + 2 + 3 * 2;
/// Of the other agent: place, gap, velocity, heading, touched, holding the same.
const OF_OTHER: usize = 9;
/// Of an object: present, place, gap, velocity, held by either, touched, meant, within reach.
const OF_OBJECT: usize = 11;
/// Features of a search that all its actions have in common: those above, the number of actions, the return
/// of the best repeated action, and by how much the worst one's is less.
pub const SHARED: usize = 3 + OF_SELF + OF_AIM + OF_OTHER + MAX_OBJECTS * OF_OBJECT;
/// Steps for which an action is repeated in imagined futures.
const REPEATED: [usize; 4] = [1, 2, 4, MOST_REPEATED];
/// Imagined futures of an action.
const FUTURES: usize = REPEATED.len() + BEFORE_FORWARD.len();
/// Features of an action: the approach and the return of each future, as they are and among those of all
/// actions; which action it is.
pub const OF_ACTION: usize = 4 * FUTURES + ACTIONS;

/// Most particles of which features are averaged; they are evenly spaced among all.
const SUMMARISED: usize = 2;
/// Scale of distances (u).
const LENGTH: f32 = 10.0;
/// Scale of gaps and of approaches (u): those that matter for the next steps are small.
const NEAR: f32 = 2.0;
/// Scale of speeds (u/s).
const SPEED: f32 = 10.0;
/// Scale of accelerations (u/s²).
const ACCELERATION: f32 = 50.0;
/// Scale of differences between returns, which are shares of the arena's diagonal.
const RETURN: f32 = 0.1;
/// Greatest size of a feature without a bound of its own.
const BOUND: f32 = 10.0;
/// Smallest range of numbers that are put in relation to one another.
const LEAST_RANGE: f32 = 1e-4;

/// A search in numbers, for the policy network.
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
    /// The mean of the features of some of the states that a search begins in.
    pub(crate) fn of(task: &Task<'_>) -> Self {
        let roots = task.roots;
        let different = if roots.iter().all(|root| *root == roots[0]) { &roots[..1] } else { roots };
        let count = different.len().min(SUMMARISED);
        let mut mean = Self { shared: [0.0; SHARED], actions: [[0.0; OF_ACTION]; ACTIONS] };
        for k in 0..count {
            let of_root = Self::of_root(task, &different[k * different.len() / count]);
            let ours = mean.shared.iter_mut().chain(mean.actions.as_flattened_mut());
            let theirs = of_root.shared.iter().chain(of_root.actions.as_flattened());
            ours.zip(theirs).for_each(|(ours, theirs)| *ours += theirs / count as f32);
        }
        mean
    }

    fn of_root(task: &Task<'_>, root: &State) -> Self {
        let futures = futures::each(task, root, |action, imagined| future(task, root, action, imagined));
        let (actions, best, range) = of_actions(task.actions, &futures);
        let frame = Frame { body: *root.body(Entity::Agent(task.agent)) };
        let mut list = List { values: [0.0; SHARED], length: 0 };
        list.push(task.actions.len() as f32 / ACTIONS as f32);
        list.push(best);
        list.push((range / RETURN).min(BOUND));
        list.myself(task, root, frame);
        list.aim(task, root, frame);
        list.other(task, root, frame);
        for object in ObjectId::ALL {
            list.object(task, root, frame, object);
        }
        Self { shared: list.values, actions }
    }
}

/// By how much each imagined future of an action shortens the subgoal's distance (u), and its return.
#[derive(Clone, Copy)]
struct Future([(f32, f32); FUTURES]);

/// The features of every action, the best return of the longest repetition, and how much worse the worst is.
fn of_actions(actions: &[Action], futures: &[Future]) -> ([[f32; OF_ACTION]; ACTIONS], f32, f32) {
    let bounds = |of: fn(&(f32, f32)) -> f32, k: usize| {
        let numbers = futures.iter().map(move |future| of(&future.0[k]));
        numbers.fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), it| (least.min(it), most.max(it)))
    };
    let share = |number: f32, (least, most): (f32, f32)| {
        if most - least > LEAST_RANGE { (number - least) / (most - least) } else { 0.0 }
    };
    let mut features = [[0.0; OF_ACTION]; ACTIONS];
    for k in 0..FUTURES {
        let approaches = bounds(|it| it.0, k);
        let returns = bounds(|it| it.1, k);
        for (&action, future) in actions.iter().zip(futures) {
            let (approach, gain) = future.0[k];
            features[action.index()][4 * k..4 * k + 4].copy_from_slice(&[
                (approach / NEAR).clamp(-BOUND, BOUND),
                share(approach, approaches),
                ((gain - returns.1) / RETURN).max(-BOUND),
                share(gain, returns),
            ]);
        }
    }
    for &action in actions {
        features[action.index()][4 * FUTURES + action.index()] = 1.0;
    }
    let (least, most) = bounds(|it| it.1, REPEATED.len() - 1);
    (features, most.clamp(-BOUND, BOUND), most - least)
}

fn future(task: &Task<'_>, root: &State, action: Action, imagined: &Futures) -> Future {
    let sign = f64::from(task.aim.sign().value());
    let start = task.aim.distance(task.rooms, root);
    // Adds the rewards of states after an action to a return, given the weight of the first.
    let gain = |(gained, weight): &mut (f64, f64), states: &[State], action: Action| {
        for state in states {
            *gained += *weight * task.aim.reward(task.rooms, state, action);
            *weight *= task.parameters.discount;
        }
    };
    let told = |state: &State, (gained, _): (f64, f64)| {
        let approach = sign * (start - task.aim.distance(task.rooms, state));
        (approach as f32, gained as f32)
    };
    let repeated = imagined.repeated();
    let after = |steps: usize| {
        let mut sum = (0.0, 1.0);
        gain(&mut sum, &repeated[..steps], action);
        sum
    };
    let mut numbers = [(0.0, 0.0); FUTURES];
    let (of_repeated, of_forward) = numbers.split_at_mut(REPEATED.len());
    for (steps, number) in REPEATED.into_iter().zip(of_repeated) {
        *number = told(&repeated[steps - 1], after(steps));
    }
    for ((steps, states), number) in imagined.forward().zip(of_forward) {
        let mut sum = after(steps);
        gain(&mut sum, states, Action::Up);
        *number = told(&states[FORWARD - 1], sum);
    }
    Future(numbers)
}

/// The agent's frame.
#[derive(Clone, Copy)]
struct Frame {
    body: Body,
}

impl Frame {
    /// A direction of the world: to the right and forward.
    fn vector(&self, vector: Vec2) -> Vec2 {
        let forward = self.body.forward();
        let right = Vec2::new(forward.y, -forward.x);
        Vec2::new(vector.dot(right), vector.dot(forward))
    }

    /// The way to a place.
    fn to(&self, place: Vec2) -> Vec2 {
        self.vector(place - self.body.position)
    }
}

/// The body that a subgoal is about and the place that it has to reach or leave.
fn course(aim: Aim, agent: AgentId, state: &State) -> (usize, Entity, Vec2) {
    let at = |entity| state.position(entity);
    let middle = |room: RoomId| arena::LANDMARKS[room.landmark()];
    match aim {
        Aim::Stop => (0, Entity::Agent(agent), at(Entity::Agent(agent))),
        Aim::AgentToLandmark(whose, landmark, _) => (0, Entity::Agent(whose), arena::LANDMARKS[landmark]),
        Aim::ObjectToLandmark(object, landmark, _) => (1, Entity::Object(object), arena::LANDMARKS[landmark]),
        Aim::Touch(whose, entity, _) => (2, Entity::Agent(whose), at(entity)),
        Aim::AgentToRoom(whose, room, _) => (3, Entity::Agent(whose), middle(room)),
        Aim::ObjectToRoom(object, room) => (4, Entity::Object(object), middle(room)),
        Aim::Grab(whose, object, _) => (5, Entity::Agent(whose), at(Entity::Object(object))),
    }
}

/// The object that a subgoal is about.
fn meant(aim: Aim) -> Option<ObjectId> {
    match aim {
        Aim::ObjectToLandmark(object, ..)
        | Aim::ObjectToRoom(object, _)
        | Aim::Grab(_, object, _)
        | Aim::Touch(_, Entity::Object(object), _) => Some(object),
        _ => None,
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

    fn myself(&mut self, task: &Task<'_>, state: &State, frame: Frame) {
        let agents = &task.physics.agents;
        let me = agents[task.agent];
        let other = agents[task.agent.other()];
        self.vector(frame.vector(frame.body.velocity) / SPEED);
        self.push(me.radius);
        self.push(me.max_force / me.mass() / ACCELERATION);
        self.push(libm::logf(me.max_force / other.max_force));
        self.flag(state.held_object(task.agent).is_none());
    }

    fn aim(&mut self, task: &Task<'_>, state: &State, frame: Frame) {
        let Task { aim, agent, .. } = *task;
        let (kind, moved, target) = course(aim, agent, state);
        self.values[self.length + kind] = 1.0;
        self.length += KINDS;
        self.flag(aim.sign() == Sign::Positive);
        let distance = aim.distance(task.rooms, state) as f32;
        self.push((distance / LENGTH).clamp(-BOUND, BOUND));
        self.push(libm::tanhf(distance / NEAR));
        self.flag(moved == Entity::Agent(agent));
        self.flag(moved == Entity::Agent(agent.other()));
        self.flag(matches!(aim, Aim::Touch(_, Entity::Agent(_), _)));
        self.vector(frame.to(state.position(moved)) / LENGTH);
        self.vector(frame.vector(state.body(moved).velocity) / SPEED);
        self.vector(frame.to(target) / LENGTH);
    }

    fn other(&mut self, task: &Task<'_>, state: &State, frame: Frame) {
        let me = task.agent;
        let other = Entity::Agent(me.other());
        let held = state.held_object(me);
        self.body(task, state, frame, other);
        self.vector(frame.vector(state.body(other).forward()));
        self.flag(state.contacts.touching(Entity::Agent(me), other));
        self.flag(held.is_some() && held == state.held_object(me.other()));
    }

    /// Place, gap and velocity.
    fn body(&mut self, task: &Task<'_>, state: &State, frame: Frame, entity: Entity) {
        let physics = task.physics;
        let away = state.position(entity) - frame.body.position;
        let gap = away.length() - physics.radius(entity) - physics.agents[task.agent].radius;
        self.vector(frame.vector(away) / LENGTH);
        self.push((gap / NEAR).min(BOUND));
        self.vector(frame.vector(state.body(entity).velocity - frame.body.velocity) / SPEED);
    }

    fn object(&mut self, task: &Task<'_>, state: &State, frame: Frame, object: ObjectId) {
        let physics = task.physics;
        if object.index() >= physics.object_count {
            self.length += OF_OBJECT;
            return;
        }
        let me = task.agent;
        let entity = Entity::Object(object);
        self.flag(true);
        self.body(task, state, frame, entity);
        self.flag(state.holds(me, object));
        self.flag(state.holds(me.other(), object));
        self.flag(state.contacts.touching(Entity::Agent(me), entity));
        self.flag(meant(task.aim) == Some(object));
        self.flag(state.attachable(physics, me).is_some_and(|(nearest, _)| nearest == object));
    }
}
