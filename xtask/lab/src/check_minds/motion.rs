//! Motion of agents, simulated or recorded, and whether their goals were reached.

use phase_evidence::{GoalOutcome, MotionStatistics, Track, outcome};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Scene, Sign, arena::STEP_SECONDS};

/// An agent that is slower does not move (u/s): it is displaced by less than 0.05 u in a step. Turning on the
/// spot is not motion here, as it is none in [`MotionStatistics`].
const STILL_SPEED: f32 = 0.05 / STEP_SECONDS as f32;

/// The motion of both agents in one event, and what became of their goals.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Motion {
    /// Speeds, path and contact of each.
    pub(super) agents: [MotionStatistics; AGENT_COUNT],
    /// Whether the own positive goal of each was reached; `None` for an agent without one.
    pub(super) reached: [Option<Reached>; AGENT_COUNT],
    /// Maximum number of steps in a row in which neither agent moved while a positive goal was open.
    pub(super) longest_still: usize,
}

/// Whether a goal was reached.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Reached {
    /// As [`GoalOutcome`] has it: at the end of the event, or for a touch at any time.
    pub(super) outcome: bool,
    /// At any time.
    pub(super) at_any_time: bool,
}

impl Motion {
    /// The motion of a track of a scene.
    pub(super) fn of(scene: &Scene, track: &Track) -> Self {
        let agents = AgentId::ALL.map(|agent| MotionStatistics::of(track, agent, track.steps()));
        let reached = AgentId::ALL.map(|agent| {
            let spec = &scene.agents[agent];
            let own = spec.attitude == Attitude::Neutral && spec.goal.sign() == Sign::Positive;
            own.then(|| Reached {
                outcome: GoalOutcome::of(track, spec.goal).reached,
                at_any_time: holds(track, spec.goal).contains(&true),
            })
        });
        let still = |step: usize| AgentId::ALL.into_iter().all(|agent| !moves(&agents[agent], step));
        let open = open_steps(scene, track);
        let mut longest_still = 0;
        let mut current = 0;
        for (step, open) in open.iter().enumerate() {
            current = if *open && still(step) { current + 1 } else { 0 };
            longest_still = longest_still.max(current);
        }
        Self { agents, reached, longest_still }
    }

    /// Number of steps.
    pub(super) const fn steps(&self) -> usize {
        self.agents[0].speeds.len()
    }

    /// Length of the paths of both agents together (u).
    pub(super) fn path(&self) -> f32 {
        self.agents.iter().map(|agent| agent.path).sum()
    }

    /// Share of the steps in which nobody moves; `None` without steps.
    pub(super) fn still_share(&self) -> Option<f64> {
        let still = |step: &usize| self.agents.iter().all(|agent| !moves(agent, *step));
        let steps = self.steps();
        (steps > 0).then(|| (0..steps).filter(still).count() as f64 / steps as f64)
    }

    /// Mean share of the steps in which an agent touches the other or an object; `None` without steps.
    pub(super) fn contact_share(&self) -> Option<f64> {
        let shares: Option<Vec<f64>> =
            self.agents.iter().map(|agent| agent.contact_share().map(f64::from)).collect();
        phase_statistics::mean(&shares?)
    }
}

fn moves(motion: &MotionStatistics, step: usize) -> bool {
    motion.speeds.get(step).is_some_and(|&speed| speed >= STILL_SPEED)
}

/// Whether the condition of a goal holds in each state of a track.
fn holds(track: &Track, goal: Goal) -> Vec<bool> {
    track.states.iter().map(|state| outcome::condition(&track.physics, state, goal)).collect()
}

/// For each step whether a positive goal of one of the agents is open after it. Touching closes a goal for
/// good.
fn open_steps(scene: &Scene, track: &Track) -> Vec<bool> {
    let mut open = vec![false; track.steps()];
    for goal in scene.goals().into_iter().filter(|goal| goal.sign() == Sign::Positive) {
        let holds = holds(track, goal);
        let mut touched = false;
        for (step, holds) in holds.into_iter().enumerate() {
            touched |= holds && matches!(goal, Goal::Touch { .. });
            if let Some(open) = step.checked_sub(1).and_then(|step| open.get_mut(step)) {
                *open |= !holds && !touched;
            }
        }
    }
    open
}
