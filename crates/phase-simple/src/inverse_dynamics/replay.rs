//! One step of an event, simulated with known actions and strengths, and compared with what was observed.

use super::{
    difference::Difference,
    noise::expected_residual,
    reading::{Reading, Start},
};
use phase_forward::{Exertion, Forward, SolverCache};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Entity, MAX_ENTITIES, PhysicsConfig, State, Strength, arena::SUBSTEPS,
};

/// Number of strengths.
pub(super) const LEVELS: usize = Strength::ALL.len();
/// All strengths, one bit for each level.
pub(super) const ALL_LEVELS: u8 = (1 << LEVELS) - 1;
/// Iterations in which the state before a late start is found.
const LATE_ITERATIONS: usize = 4;
/// Residual by which it has to be worse (u) for the state after the first substep to be taken instead.
const LATE_MARGIN: f32 = 0.003;

/// A candidate for what one agent does in a step: an action, and the level of its strength.
pub(super) type CandidateAction = (Action, usize);

/// A state to step from.
#[derive(Clone, Debug)]
pub(super) struct TrackedState {
    pub(super) state: State,
    pub(super) cache: SolverCache,
    /// Whether this is the state after the first substep of the step.
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

/// The physics of one reading of an event, for any strengths.
#[derive(Clone, Debug)]
pub(super) struct Replay {
    pub(super) reading: Reading,
    pub(super) physics: PhysicsConfig,
    pub(super) radii: [f32; MAX_ENTITIES],
    /// The residual that errors of rows alone leave (u); 0 if they are exact.
    pub(super) noise: f32,
    forward: Forward,
}

impl Replay {
    pub(super) fn new(reading: Reading) -> Self {
        let event = &reading.event;
        let physics = event.physics([0.0; AGENT_COUNT]);
        let mut radii = [0.0; MAX_ENTITIES];
        for entity in event.entities() {
            radii[entity.index()] = match entity {
                Entity::Agent(agent) => physics.agents[agent].radius,
                Entity::Object(object) => physics.object_radii[object],
            };
        }
        let noise = expected_residual(event.noise(), &radii);
        Self { forward: Forward::new(&physics), reading, physics, radii, noise }
    }

    /// The row that was observed after so many steps.
    pub(super) fn row(&self, t: usize) -> &[Body; MAX_ENTITIES] {
        &self.reading.event.rows()[t]
    }

    /// The indices of the bodies present.
    pub(super) fn bodies(&self) -> impl Iterator<Item = usize> + use<> {
        self.reading.event.entities().map(Entity::index)
    }

    /// The state in which the first step begins.
    pub(super) fn start(&self) -> TrackedState {
        let mut tracked = self.at(State::new(*self.row(0)));
        match self.reading.start {
            Start::OnTime => {}
            Start::Settling => self.settle(&mut tracked),
            Start::Late => tracked.late = true,
        }
        tracked
    }

    /// A state with the contacts that follow from it alone.
    pub(super) fn at(&self, state: State) -> TrackedState {
        TrackedState { state, cache: self.forward.fresh_cache(&state), late: false }
    }

    fn settle(&self, tracked: &mut TrackedState) {
        self.forward.settle_warm(&mut tracked.state, &mut tracked.cache);
    }

    /// A step, compared with what was observed.
    pub(super) fn step(
        &self,
        tracked: &TrackedState,
        row: &[Body; MAX_ENTITIES],
        candidates: [CandidateAction; AGENT_COUNT],
    ) -> PredictedStep {
        if tracked.late {
            return self.late_step(&tracked.state, row, candidates);
        }
        let mut end = tracked.clone();
        let substeps = self.run(&mut end, candidates);
        self.compare(end, &substeps, row)
    }

    fn run(
        &self,
        tracked: &mut TrackedState,
        candidates: [CandidateAction; AGENT_COUNT],
    ) -> [State; SUBSTEPS] {
        self.forward.step_warm_with(&mut tracked.state, &mut tracked.cache, &exertion(candidates))
    }

    fn compare(
        &self,
        end: TrackedState,
        substeps: &[State; SUBSTEPS],
        row: &[Body; MAX_ENTITIES],
    ) -> PredictedStep {
        let differences = self.differences(&Difference::means(substeps), row);
        PredictedStep { end, differences, residual: self.norm(&differences) }
    }

    /// From predicted bodies to the observed ones; none for bodies that are not there.
    fn differences(
        &self,
        predicted: &[Body; MAX_ENTITIES],
        observed: &[Body; MAX_ENTITIES],
    ) -> [Difference; MAX_ENTITIES] {
        let mut differences = [Difference::default(); MAX_ENTITIES];
        for body in self.bodies() {
            let period = self.reading.angle_periods[body];
            differences[body] = Difference::between(&predicted[body], &observed[body], period);
        }
        differences
    }

    fn norm(&self, differences: &[Difference; MAX_ENTITIES]) -> f32 {
        self.bodies()
            .map(|body| differences[body].square(self.radii[body], self.noise == 0.0))
            .sum::<f32>()
            .sqrt()
    }

    /// The first step of a late start, of which the state after its first substep is known: the state before
    /// is the one from which these candidate actions lead there. All were at rest, and one idle substep had
    /// passed. The difference from the known state is part of the residual.
    fn late_step(
        &self,
        after_substep: &State,
        row: &[Body; MAX_ENTITIES],
        candidates: [CandidateAction; AGENT_COUNT],
    ) -> PredictedStep {
        let mut start = resting(after_substep);
        let mut best = self.step_after_substep(after_substep, row, candidates);
        best.residual += LATE_MARGIN;
        for _ in 0..LATE_ITERATIONS {
            let mut tracked = self.at(start);
            self.settle(&mut tracked);
            let substeps = self.run(&mut tracked, candidates);
            let mut predicted = self.compare(tracked, &substeps, row);
            let differences = self.differences(&substeps[0].bodies, &after_substep.bodies);
            let known = self.norm(&differences);
            predicted.residual = (predicted.residual * predicted.residual + known * known).sqrt();
            for (body, difference) in start.bodies.iter_mut().zip(&differences) {
                *body = Body::at_rest(body.position + difference.position, body.angle + difference.angle);
            }
            if predicted.residual < best.residual {
                best = predicted;
            }
        }
        best
    }

    /// The step from the known state after its first substep on, without contact memory: for overlapping
    /// bodies that were pushed apart so that the state before cannot be found.
    fn step_after_substep(
        &self,
        after_substep: &State,
        row: &[Body; MAX_ENTITIES],
        candidates: [CandidateAction; AGENT_COUNT],
    ) -> PredictedStep {
        // Row 0 does not tell how fast the agents turn, but they have turned for one substep from rest.
        let first = self.run(&mut self.at(resting(after_substep)), candidates)[0];
        let mut start = *after_substep;
        for (body, first) in start.bodies.iter_mut().zip(&first.bodies) {
            body.angular_velocity = first.angular_velocity;
        }
        let mut substeps = self.run(&mut self.at(start), candidates);
        // The first of the step has passed, and the last belongs to the next.
        substeps.rotate_right(1);
        substeps[0] = *after_substep;
        let mut end = substeps[SUBSTEPS - 1];
        end.bodies[..AGENT_COUNT].iter_mut().for_each(|body| body.angular_velocity = 0.0);
        self.compare(self.at(end), &substeps, row)
    }

    /// The candidate actions of an agent in a state that differ in what they do, for some of its strengths
    /// (one bit for each level).
    pub(super) fn candidates(&self, state: &State, agent: AgentId, strengths: u8) -> Vec<CandidateAction> {
        let levels = || (0..LEVELS).filter(move |level| strengths & 1 << level != 0);
        let weakest = levels().next().unwrap_or(0);
        let mut candidates = Vec::new();
        for action in Action::ALL {
            let idle = match action {
                Action::Attach => state.attachable(&self.physics, agent).is_none(),
                Action::Detach => state.grips[agent].is_none(),
                _ => false,
            };
            // Only pushing needs strength.
            if action.push().is_some() {
                candidates.extend(levels().map(|level| (action, level)));
            } else if !idle {
                candidates.push((action, weakest));
            }
        }
        candidates
    }
}

/// The candidate actions in the kernel's words.
fn exertion(candidates: [CandidateAction; AGENT_COUNT]) -> Exertion {
    Exertion {
        actions: candidates.map(|(action, _)| action),
        max_forces: candidates.map(|(_, level)| Strength::ALL[level].max_force()),
    }
}

fn resting(state: &State) -> State {
    State::new(state.bodies.map(|body| Body::at_rest(body.position, body.angle)))
}
