//! Inverse dynamics: the actions of both agents step by step, and their strengths.
//!
//! Forces are not seen, but what they do is, and there are only fourteen actions and four strengths.
//! [`InverseDynamics`] follows an event through the forward model and asks at every step which actions of
//! both lead to what was observed. That tells actions, grips, the states between steps, and strengths.
//!
//! Key design decision: the state that a step is predicted to end in is carried on as it is, with its contact
//! memory, as long as it is exact; it is corrected by what was observed only where it is not. Contacts
//! amplify small errors, so a state that is corrected by means over a step loses track as soon as bodies
//! touch. Several explanations are followed at once (a beam), since grips and strengths show later than they
//! begin.

mod beam;
mod coupling;
mod difference;
mod interpolation;
mod noise;
mod path;
mod reading;
mod replay;
mod search;
mod strength;
#[cfg(test)]
mod tests;

use beam::Beam;
use phase_event::{ObservedError, ObservedEvent};
use phase_model::{AGENT_COUNT, Action, AgentId, State, Strength};
use reading::Start;
use replay::{Replay, TrackedState};
use strength::LevelCosts;

/// Residual up to which a step counts as explained (u).
pub const EXPLAINED_RESIDUAL: f32 = 0.05;

/// Median residual (u) above which measured motion obeys another physics. Of 50 recordings that were drawn
/// at half size, compressed by x264 with CRF 35 and tracked, the worst has 0.47; random walks and straight
/// lines between random places have 0.6 and more.
const FOREIGN_RESIDUAL: f32 = 0.55;

/// An event explained by what its agents did.
#[derive(Clone, Debug)]
pub struct InverseDynamics {
    /// The state at the end of every step, state 0 being row 0: one for each row.
    pub states: Vec<State>,
    /// The actions of both in every step, as far as they can be told: an agent at rest may as well have
    /// grabbed at nothing.
    pub actions: Vec<[Action; AGENT_COUNT]>,
    /// ln P(motion | f) of each agent's strengths but for a constant, weakest first.
    pub log_strengths: [[f64; Strength::ALL.len()]; AGENT_COUNT],
    /// Residual of every step (u), over positions, velocities and angles of all bodies.
    pub residuals: Vec<f32>,
    /// Whether row 0 is the state after the first substep of the first step, as in some recordings.
    pub late_start: bool,
    /// The physics that explain it.
    replay: Replay,
    /// The states in which steps begin, as the replay has them.
    tracked: Vec<TrackedState>,
    /// The numbers of the paths that it is made of.
    numbers: Vec<usize>,
    /// The levels of strength that were found, and what each step costs with others.
    levels: [usize; AGENT_COUNT],
    level_costs: Vec<LevelCosts>,
}

/// Explains an event while it is watched.
#[derive(Clone, Debug)]
pub struct MotionTracker {
    beam: Beam,
    motion: InverseDynamics,
}

impl MotionTracker {
    /// Explains what was observed so far.
    #[must_use]
    pub fn new(observed: &ObservedEvent) -> Self {
        let beam = Beam::new(observed);
        let motion = InverseDynamics::of(&beam, None);
        Self { beam, motion }
    }

    /// Watches the next row of `observed`, its last one. How many states are explained as before: what
    /// follows may show what happened earlier.
    ///
    /// # Errors
    /// [`ObservedError`] for numbers that are not finite.
    pub fn push(&mut self, observed: &ObservedEvent) -> Result<usize, ObservedError> {
        let Some(row) = observed.rows().last() else { return Err(ObservedError::Empty) };
        if !self.beam.push(row)? {
            *self = Self::new(observed);
            return Ok(1);
        }
        // The last step was followed without the row after it.
        let last = self.motion.numbers.len().max(2) - 1;
        let motion = InverseDynamics::of(&self.beam, Some((&self.motion, last)));
        let unchanged = unchanged(&self.motion.numbers[..last], &motion.numbers);
        self.motion = motion;
        Ok(unchanged)
    }

    /// The best explanation of what was observed so far.
    #[must_use]
    pub const fn motion(&self) -> &InverseDynamics {
        &self.motion
    }

    /// The best explanation of the event, without the tracker.
    #[must_use]
    pub fn into_motion(self) -> InverseDynamics {
        self.motion
    }
}

/// Length of the common beginning of two paths, at least 1.
fn unchanged(before: &[usize], now: &[usize]) -> usize {
    before.iter().zip(now).take_while(|(before, now)| before == now).count().max(1)
}

impl InverseDynamics {
    /// Explains an event.
    #[must_use]
    pub fn new(observed: &ObservedEvent) -> Self {
        MotionTracker::new(observed).into_motion()
    }

    /// The best path of a beam. `known` is an explanation of fewer rows, of which so many numbers of paths
    /// are valid.
    fn of(beam: &Beam, known: Option<(&Self, usize)>) -> Self {
        let numbers = beam.best();
        let path = || numbers.iter().map(|&number| beam.path(number));
        let steps = || path().skip(1);
        let last = beam.path(numbers[numbers.len() - 1]);
        let replay = beam.replay(last);
        let reading = &replay.reading;
        // The start may lie before row 0, or after it.
        let mut states = vec![State::new(*beam.first_row())];
        states.extend(steps().map(|step| reading.observed_state(&step.tracked.state)));
        let actions: Vec<_> = steps().map(|step| step.actions).collect();
        let tracked: Vec<_> = path().map(|step| step.tracked.clone()).collect();
        // The weakest of those that explain the event equally well.
        let levels = last.strengths.map(|strengths| strengths.trailing_zeros() as usize);
        let mut level_costs = match known {
            Some((known, valid)) if known.levels == levels => {
                let unchanged = unchanged(&known.numbers[..valid], &numbers);
                known.level_costs[..unchanged - 1].to_vec()
            }
            _ => Vec::new(),
        };
        for step in level_costs.len()..actions.len() {
            let row = replay.row(step + 1);
            level_costs.push(strength::level_costs(replay, &tracked[step], row, actions[step], levels));
        }
        let mut log_strengths = [[0.0; Strength::ALL.len()]; AGENT_COUNT];
        for costs in &level_costs {
            for (logs, costs) in log_strengths.iter_mut().zip(costs) {
                logs.iter_mut().zip(costs).for_each(|(log, cost)| *log -= cost);
            }
        }
        Self {
            states,
            log_strengths,
            actions: actions.iter().map(|both| both.map(|action| reading.observed_action(action))).collect(),
            residuals: steps().map(|step| step.residual).collect(),
            late_start: reading.start == Start::Late,
            replay: replay.clone(),
            tracked,
            numbers,
            levels,
            level_costs,
        }
    }

    /// The most likely strengths; the weakest of equally likely ones.
    #[must_use]
    pub fn strengths(&self) -> [Strength; AGENT_COUNT] {
        self.log_strengths.map(|logs| {
            let mut likeliest = 0;
            for (level, log) in logs.iter().enumerate() {
                if *log > logs[likeliest] {
                    likeliest = level;
                }
            }
            Strength::ALL[likeliest]
        })
    }

    /// Whether each step is explained, to within [`EXPLAINED_RESIDUAL`] and what errors of rows leave.
    pub fn explained(&self) -> impl Iterator<Item = bool> + '_ {
        self.residuals.iter().map(|&residual| residual <= EXPLAINED_RESIDUAL + 2.0 * self.replay.noise)
    }

    /// The error that rows and physics together leave in the steps up to one (u): the median residual, but
    /// not less than errors of rows alone leave; 0 for exact rows. It is large for motion that does not obey
    /// this physics.
    #[must_use]
    pub fn error_up_to(&self, step: usize) -> f32 {
        if self.replay.noise == 0.0 {
            return 0.0;
        }
        let mut residuals: Vec<f32> = self.residuals.iter().take(step + 1).copied().collect();
        residuals.sort_by(f32::total_cmp);
        residuals.get(residuals.len() / 2).copied().unwrap_or(0.0).max(self.replay.noise)
    }

    /// Whether measured motion obeys another physics: its error is larger than errors of tracks explain.
    #[must_use]
    pub fn is_foreign(&self) -> bool {
        self.error_up_to(self.residuals.len()) > FOREIGN_RESIDUAL
    }

    /// The residual of every step (u) if an agent does each of its actions instead, by [`Action::index`], the
    /// other doing what was inferred.
    #[must_use]
    pub fn alternatives(&self) -> Vec<[[f32; Action::ALL.len()]; AGENT_COUNT]> {
        (0..self.actions.len()).map(|step| self.alternatives_in(step)).collect()
    }

    /// The residual of one step (u) if an agent does each of its actions instead, as in
    /// [`InverseDynamics::alternatives`].
    ///
    /// # Panics
    /// If the event has no such step.
    #[must_use]
    pub fn alternatives_in(&self, step: usize) -> [[f32; Action::ALL.len()]; AGENT_COUNT] {
        let reading = &self.replay.reading;
        let levels = self.strengths().map(|strength| usize::from(strength.level()));
        let candidate = |agent: AgentId, action| (reading.observed_action(action), levels[agent]);
        let tracked = &self.tracked[step];
        let actions = &self.actions[step];
        AgentId::ALL.map(|agent| {
            Action::ALL.map(|action| {
                let mut candidates = AgentId::ALL.map(|agent| candidate(agent, actions[agent]));
                candidates[agent] = candidate(agent, action);
                self.replay.step(tracked, self.replay.row(step + 1), candidates).residual
            })
        })
    }
}
