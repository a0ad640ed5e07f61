//! One step of an event, simulated under all possible actions.

use super::path::{Path, argmin};
use phase_event::ObservedEvent;
use phase_forward::{Forward, SolverCache};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Entity, MAX_ENTITIES, State, Strength, Vec2,
    arena::{SUBSTEP_SECONDS, SUBSTEPS},
};

/// Number of strengths.
pub(super) const LEVELS: usize = Strength::ALL.len();
/// Residual of a step that the physics explains (u).
const RESIDUAL_SCALE: f64 = 0.02;
/// Prediction error beyond which a body is reset to the observation (u, rad).
const RESET_THRESHOLD: f32 = 0.4;
/// Below this difference (u, rad), the simulated contacts are still valid.
const CACHE_TOLERANCE: f32 = 0.02;
/// Duration of a step (s).
const STEP_SECONDS: f32 = SUBSTEP_SECONDS * SUBSTEPS as f32;
/// Cost of attaching or detaching beside its residual, in logarithms: it is rare.
const GRIP_CHANGE_COST: f64 = 2.0;
/// Number of rounds in which the agents are explained alternately, since one agent's actions may affect the
/// other's motion.
const ROUNDS: usize = 3;
/// Actions that change no grip.
const GRIP_PRESERVING_ACTIONS: [Action; 12] = [
    Action::TurnLeft,
    Action::TurnRight,
    Action::Up,
    Action::Down,
    Action::Left,
    Action::Right,
    Action::UpLeft,
    Action::UpRight,
    Action::DownLeft,
    Action::DownRight,
    Action::Stop,
    Action::NoForce,
];

/// A state to step from.
#[derive(Clone, Debug)]
pub(super) struct TrackedState {
    pub(super) state: State,
    pub(super) cache: SolverCache,
    /// Whether a substep of the step has passed already.
    pub(super) late: bool,
}

/// A predicted step, with the row that was observed.
pub(super) struct PredictedStep {
    end: TrackedState,
    differences: [Difference; MAX_ENTITIES],
    pub(super) residual: f32,
}

/// The correction from a predicted body to the observed one.
#[derive(Clone, Copy, Default)]
struct Difference {
    position: Vec2,
    velocity: Vec2,
    angle: f32,
}

/// Filter that follows an event through the forward model.
pub(super) struct Tracker<'a> {
    observed: &'a ObservedEvent,
    /// By both agents' strengths.
    worlds: Vec<Forward>,
    radii: [f32; MAX_ENTITIES],
}

impl<'a> Tracker<'a> {
    pub(super) fn new(observed: &'a ObservedEvent) -> Self {
        let forces = Strength::ALL.map(Strength::max_force);
        let pairs = forces.into_iter().flat_map(|first| forces.map(|second| [first, second]));
        let worlds = pairs.map(|pair| Forward::new(&observed.physics(pair))).collect();
        let physics = observed.physics([0.0; AGENT_COUNT]);
        let mut radii = [0.0; MAX_ENTITIES];
        for entity in observed.entities() {
            radii[entity.index()] = match entity {
                Entity::Agent(agent) => physics.agents[agent].radius,
                Entity::Object(object) => physics.object_radii[object],
            };
        }
        Self { observed, worlds, radii }
    }

    /// The beginning of an event.
    pub(super) fn path(&self, state: State, late: bool) -> Path {
        let tracked = TrackedState { state, cache: self.fresh_cache(&state), late };
        Path {
            tracked,
            late_start: late,
            cost: 0.0,
            strength_costs: [[0.0; LEVELS]; AGENT_COUNT],
            history: Vec::new(),
        }
    }

    /// The contacts that follow from a state alone; strengths play no part in it.
    pub(super) fn fresh_cache(&self, state: &State) -> SolverCache {
        self.worlds[0].fresh_cache(state)
    }

    /// A step of agents of these strengths, compared with what was observed.
    pub(super) fn step(
        &self,
        tracked: &TrackedState,
        row: &[Body; MAX_ENTITIES],
        levels: [usize; AGENT_COUNT],
        actions: [Action; AGENT_COUNT],
    ) -> PredictedStep {
        let mut end = tracked.clone();
        let world = &self.worlds[levels[0] * LEVELS + levels[1]];
        let mut substeps = world.step_warm(&mut end.state, &mut end.cache, actions);
        if tracked.late {
            // The first substep is where it starts, and the last does not belong to it any more.
            substeps.rotate_right(1);
            substeps[0] = tracked.state;
            end.state = substeps[SUBSTEPS - 1];
            end.state.bodies.iter_mut().for_each(|body| body.angular_velocity = 0.0);
            end.cache = self.fresh_cache(&end.state);
            end.late = false;
        }
        let mut differences = [Difference::default(); MAX_ENTITIES];
        let mut squares = 0.0;
        for entity in self.observed.entities().map(Entity::index) {
            let difference = Difference::between(&mean(&substeps, entity), &row[entity]);
            squares += difference.square(self.radii[entity]);
            differences[entity] = difference;
        }
        PredictedStep { end, differences, residual: squares.sqrt() }
    }

    /// The ways in which a path can continue to a row: the best without a change of grips, and the best with
    /// one.
    pub(super) fn successors(&self, path: &Path, row: &[Body; MAX_ENTITIES], between: &State) -> Vec<Path> {
        // What has to do with grips comes further down.
        let mut actions = path.last_actions().map(|action| match action {
            Action::Attach | Action::Detach => Action::NoForce,
            action => action,
        });
        let mut levels = path.strength_costs.map(|costs| argmin(&costs));
        let mut costs = [[0.0; LEVELS]; AGENT_COUNT];
        for _ in 0..ROUNDS {
            let before = (actions, levels);
            for agent in AgentId::ALL {
                let (by_level, best) = self.by_level(&path.tracked, row, agent, levels, actions);
                let sums: [f64; LEVELS] =
                    core::array::from_fn(|level| path.strength_costs[agent][level] + by_level[level]);
                levels[agent] = argmin(&sums);
                actions[agent] = best[levels[agent]];
                costs[agent] = by_level;
            }
            if before == (actions, levels) {
                break;
            }
        }
        let predicted = self.step(&path.tracked, row, levels, actions);
        let mut paths = vec![self.extend(path, actions, predicted, between, 0.0, Some(costs))];
        for agent in AgentId::ALL {
            let held = path.tracked.state.grips[agent].is_some();
            let mut actions = actions;
            actions[agent] = if held { Action::Detach } else { Action::Attach };
            let predicted = self.step(&path.tracked, row, levels, actions);
            if predicted.end.state.grips != path.tracked.state.grips {
                paths.push(self.extend(path, actions, predicted, between, GRIP_CHANGE_COST, None));
            }
        }
        paths
    }

    /// The minimum cost of explaining an agent for each of its strengths, and the action that attains it.
    fn by_level(
        &self,
        tracked: &TrackedState,
        row: &[Body; MAX_ENTITIES],
        agent: AgentId,
        levels: [usize; AGENT_COUNT],
        actions: [Action; AGENT_COUNT],
    ) -> ([f64; LEVELS], [Action; LEVELS]) {
        let mut costs = [f64::INFINITY; LEVELS];
        let mut best = [Action::NoForce; LEVELS];
        for action in GRIP_PRESERVING_ACTIONS {
            let mut known = None;
            for level in 0..LEVELS {
                // Only pushing and turning need strength.
                let forceless = action.push().is_none() && action.turn() == 0.0;
                let cost = known.filter(|_| forceless).unwrap_or_else(|| {
                    let (mut levels, mut actions) = (levels, actions);
                    (levels[agent], actions[agent]) = (level, action);
                    cost(self.step(tracked, row, levels, actions).residual)
                });
                known = Some(cost);
                if cost < costs[level] {
                    (costs[level], best[level]) = (cost, action);
                }
            }
        }
        (costs, best)
    }

    /// A path extended by one step and corrected by the observation. Where nothing distinguishes strengths,
    /// all have to bear the cost of the step.
    fn extend(
        &self,
        path: &Path,
        actions: [Action; AGENT_COUNT],
        predicted: PredictedStep,
        between: &State,
        extra: f64,
        costs: Option<[[f64; LEVELS]; AGENT_COUNT]>,
    ) -> Path {
        let PredictedStep { mut end, differences, residual } = predicted;
        let cost = cost(residual);
        let mut furthest = 0.0_f32;
        for entity in self.observed.entities().map(Entity::index) {
            let difference = &differences[entity];
            let off = difference.position.length().max(difference.angle.abs());
            furthest = furthest.max(off);
            let body = &mut end.state.bodies[entity];
            *body = if off > RESET_THRESHOLD {
                Body { angular_velocity: body.angular_velocity, ..between.bodies[entity] }
            } else {
                difference.added_to(body)
            };
        }
        if furthest > CACHE_TOLERANCE {
            end.cache = self.fresh_cache(&end.state);
        }
        let mut strength_costs = path.strength_costs;
        for (agent, sums) in strength_costs.iter_mut().enumerate() {
            for (level, sum) in sums.iter_mut().enumerate() {
                *sum += costs.map_or(cost, |costs| costs[agent][level]);
            }
        }
        let mut history = path.history.clone();
        history.push((end.state, (actions, residual)));
        Path {
            tracked: end,
            late_start: path.late_start,
            cost: path.cost + cost + extra,
            strength_costs,
            history,
        }
    }
}

impl Difference {
    fn between(predicted: &Body, observed: &Body) -> Self {
        Self {
            position: observed.position - predicted.position,
            velocity: observed.velocity - predicted.velocity,
            angle: libm::remainderf(observed.angle - predicted.angle, core::f32::consts::TAU),
        }
    }

    /// Squared magnitude (u²): velocities are weighted by the distance covered in a step, angles by the
    /// motion of the rim.
    fn square(&self, radius: f32) -> f32 {
        let turned = self.angle * radius;
        self.position.length_squared() + (self.velocity * STEP_SECONDS).length_squared() + turned * turned
    }

    fn added_to(&self, body: &Body) -> Body {
        Body {
            position: body.position + self.position,
            velocity: body.velocity + self.velocity,
            angle: body.angle + self.angle,
            angular_velocity: body.angular_velocity,
        }
    }
}

/// Cost of a residual, in logarithms: a heavy-tailed distribution, since motion that cannot be explained does
/// occur.
fn cost(residual: f32) -> f64 {
    let scaled = f64::from(residual) / RESIDUAL_SCALE;
    libm::log1p(scaled * scaled)
}

fn mean(substeps: &[State; SUBSTEPS], entity: usize) -> Body {
    let mut mean = Body::default();
    for substep in substeps {
        let body = &substep.bodies[entity];
        mean.position += body.position / SUBSTEPS as f32;
        mean.velocity += body.velocity / SUBSTEPS as f32;
        mean.angle += body.angle / SUBSTEPS as f32;
    }
    mean
}
