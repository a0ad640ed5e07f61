//! One step of an event, simulated with known actions and strengths, and compared with what was observed.

use super::reading::{Reading, Start};
use phase_event::ObservedEvent;
use phase_forward::{Forward, SolverCache};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Entity, MAX_ENTITIES, PhysicsConfig, State, Strength, Vec2,
    arena::{SUBSTEP_SECONDS, SUBSTEPS},
};

/// Number of strengths.
pub(super) const LEVELS: usize = Strength::ALL.len();
/// Duration of a step (s).
pub(super) const STEP_SECONDS: f32 = SUBSTEP_SECONDS * SUBSTEPS as f32;
/// Iterations in which the state before a late start is found.
const LATE_ITERATIONS: usize = 4;

/// What one agent does in a step: an action, with a strength by its level.
pub(super) type Deed = (Action, usize);

/// A state to step from.
#[derive(Clone, Debug)]
pub(super) struct TrackedState {
    pub(super) state: State,
    pub(super) cache: SolverCache,
    /// Whether a substep of the step has passed already.
    pub(super) late: bool,
}

/// A predicted step, with the row that was observed.
#[derive(Clone, Debug)]
pub(super) struct PredictedStep {
    pub(super) end: TrackedState,
    pub(super) differences: [Difference; MAX_ENTITIES],
    /// Root of the sum of squares of all differences (u).
    pub(super) residual: f32,
}

/// The correction from a predicted body to the observed one.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Difference {
    pub(super) position: Vec2,
    pub(super) velocity: Vec2,
    pub(super) angle: f32,
}

/// The physics of an event, for every pair of strengths.
#[derive(Clone, Debug)]
pub(super) struct Replay {
    pub(super) event: ObservedEvent,
    pub(super) physics: PhysicsConfig,
    /// By both agents' strengths.
    worlds: Vec<Forward>,
    pub(super) radii: [f32; MAX_ENTITIES],
    angle_periods: [Option<f32>; MAX_ENTITIES],
}

impl Replay {
    pub(super) fn new(reading: &Reading) -> Self {
        let event = reading.event.clone();
        let forces = Strength::ALL.map(Strength::max_force);
        let pairs = forces.into_iter().flat_map(|first| forces.map(|second| [first, second]));
        let worlds = pairs.map(|pair| Forward::new(&event.physics(pair))).collect();
        let physics = event.physics([0.0; AGENT_COUNT]);
        let mut radii = [0.0; MAX_ENTITIES];
        for entity in event.entities() {
            radii[entity.index()] = match entity {
                Entity::Agent(agent) => physics.agents[agent].radius,
                Entity::Object(object) => physics.object_radii[object],
            };
        }
        Self { event, physics, worlds, radii, angle_periods: reading.angle_periods }
    }

    /// The beginning of a reading of the event.
    pub(super) fn start(&self, reading: &Reading) -> TrackedState {
        let state = State::new(reading.event.rows()[0]);
        let mut tracked = self.at(state);
        match reading.start {
            Start::OnTime => {}
            Start::Settling => self.worlds[0].settle_warm(&mut tracked.state, &mut tracked.cache),
            Start::Late => tracked.late = true,
        }
        tracked
    }

    /// A state with the contacts that follow from it alone; strengths play no part in them.
    pub(super) fn at(&self, state: State) -> TrackedState {
        TrackedState { state, cache: self.worlds[0].fresh_cache(&state), late: false }
    }

    /// A step, compared with what was observed.
    pub(super) fn step(
        &self,
        tracked: &TrackedState,
        row: &[Body; MAX_ENTITIES],
        deeds: [Deed; AGENT_COUNT],
    ) -> PredictedStep {
        if tracked.late {
            return self.late_step(&tracked.state, row, deeds);
        }
        let mut end = tracked.clone();
        let substeps = self.run(&mut end, deeds);
        self.compare(end, &substeps, row)
    }

    fn run(&self, tracked: &mut TrackedState, deeds: [Deed; AGENT_COUNT]) -> [State; SUBSTEPS] {
        let world = &self.worlds[deeds[0].1 * LEVELS + deeds[1].1];
        world.step_warm(&mut tracked.state, &mut tracked.cache, deeds.map(|(action, _)| action))
    }

    fn compare(
        &self,
        end: TrackedState,
        substeps: &[State; SUBSTEPS],
        row: &[Body; MAX_ENTITIES],
    ) -> PredictedStep {
        let mut differences = [Difference::default(); MAX_ENTITIES];
        let mut squares = 0.0;
        for entity in self.event.entities().map(Entity::index) {
            let difference = self.difference(&mean(substeps, entity), row, entity);
            squares += difference.square(self.radii[entity]);
            differences[entity] = difference;
        }
        PredictedStep { end, differences, residual: squares.sqrt() }
    }

    /// From a predicted body to the observed one.
    pub(super) fn difference(
        &self,
        predicted: &Body,
        observed: &[Body; MAX_ENTITIES],
        entity: usize,
    ) -> Difference {
        let observed = &observed[entity];
        let turned = observed.angle - predicted.angle;
        Difference {
            position: observed.position - predicted.position,
            velocity: observed.velocity - predicted.velocity,
            angle: self.angle_periods[entity].map_or(0.0, |period| libm::remainderf(turned, period)),
        }
    }

    /// The first step of a late start, of which the state after the first substep is known: the state before it is the
    /// one from which these deeds lead there. All were at rest, and one idle substep had passed.
    fn late_step(
        &self,
        after_substep: &State,
        row: &[Body; MAX_ENTITIES],
        deeds: [Deed; AGENT_COUNT],
    ) -> PredictedStep {
        let mut start = *after_substep;
        for body in &mut start.bodies {
            *body = Body::at_rest(body.position, body.angle);
        }
        let mut best: Option<PredictedStep> = None;
        for _ in 0..LATE_ITERATIONS {
            let mut tracked = self.at(start);
            self.worlds[0].settle_warm(&mut tracked.state, &mut tracked.cache);
            let substeps = self.run(&mut tracked, deeds);
            let mut predicted = self.compare(tracked, &substeps, row);
            let mut squares = 0.0;
            for entity in self.event.entities().map(Entity::index) {
                let difference = self.difference(&substeps[0].bodies[entity], &after_substep.bodies, entity);
                squares += difference.square(self.radii[entity]);
                let body = &mut start.bodies[entity];
                *body = Body::at_rest(body.position + difference.position, body.angle + difference.angle);
            }
            predicted.residual = (predicted.residual * predicted.residual + squares).sqrt();
            if best.as_ref().is_none_or(|best| predicted.residual < best.residual) {
                best = Some(predicted);
            }
        }
        let after = self.after_first_substep(after_substep, row, deeds);
        match best {
            Some(best) if best.residual < after.residual + super::search::EXACT => best,
            _ => after,
        }
    }

    /// The same where the state before cannot be found, because overlapping bodies were pushed apart.
    fn after_first_substep(
        &self,
        after_substep: &State,
        row: &[Body; MAX_ENTITIES],
        deeds: [Deed; AGENT_COUNT],
    ) -> PredictedStep {
        let mut rest = *after_substep;
        for body in &mut rest.bodies {
            *body = Body::at_rest(body.position, body.angle);
        }
        let first = self.run(&mut self.at(rest), deeds)[0];
        let mut start = *after_substep;
        for (body, first) in start.bodies.iter_mut().zip(&first.bodies) {
            body.angular_velocity = first.angular_velocity;
        }
        let mut substeps = self.run(&mut self.at(start), deeds);
        substeps.rotate_right(1);
        substeps[0] = *after_substep;
        let mut end = substeps[SUBSTEPS - 1];
        for body in &mut end.bodies[..AGENT_COUNT] {
            body.angular_velocity = 0.0;
        }
        self.compare(self.at(end), &substeps, row)
    }

    /// Whether the agents may act on each other in the coming step, directly or through objects.
    pub(super) fn coupled(&self, state: &State) -> bool {
        let mut linked = [true, false, false, false];
        for _ in 0..MAX_ENTITIES {
            for a in self.event.entities() {
                for b in self.event.entities() {
                    linked[b.index()] |= linked[a.index()] && self.near(state, a, b);
                }
            }
        }
        linked[1]
    }

    /// Whether two bodies may meet in the coming step.
    fn near(&self, state: &State, a: Entity, b: Entity) -> bool {
        /// Distance that bodies may additionally cover in a step (u).
        const LEEWAY: f32 = 1.2;
        /// Greatest distance of an agent's outline from its origin, in radii.
        const OUTLINE: f32 = 1.81;
        let reach = |entity: Entity| {
            let body = &state.bodies[entity.index()];
            let outline = if matches!(entity, Entity::Agent(_)) { OUTLINE } else { 1.0 };
            outline * self.radii[entity.index()] + STEP_SECONDS * body.velocity.length()
        };
        state.position(a).distance(state.position(b)) < reach(a) + reach(b) + LEEWAY || state.touching(a, b)
    }

    /// The deeds of an agent that differ in what they do, for some of its strengths (bit per level).
    pub(super) fn deeds(&self, state: &State, agent: AgentId, strengths: u8) -> Vec<Deed> {
        let levels = || (0..LEVELS).filter(move |level| strengths & 1 << level != 0);
        let any = strengths.trailing_zeros() as usize % LEVELS;
        let mut deeds = Vec::new();
        for action in Action::ALL {
            let idle = match action {
                Action::Attach => state.attachable(&self.physics, agent).is_none(),
                Action::Detach => state.grips[agent].is_none(),
                _ => false,
            };
            if action.push().is_some() {
                deeds.extend(levels().map(|level| (action, level)));
            } else if !idle {
                deeds.push((action, any));
            }
        }
        deeds
    }
}

impl Difference {
    /// Squared magnitude (u²): velocities are weighted by the distance covered in a step, angles by the
    /// motion of the rim.
    pub(super) fn square(&self, radius: f32) -> f32 {
        let turned = self.angle * radius;
        self.position.length_squared() + (self.velocity * STEP_SECONDS).length_squared() + turned * turned
    }

    pub(super) fn added_to(&self, body: &Body) -> Body {
        Body {
            position: body.position + self.position,
            velocity: body.velocity + self.velocity,
            angle: body.angle + self.angle,
            angular_velocity: body.angular_velocity,
        }
    }
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
