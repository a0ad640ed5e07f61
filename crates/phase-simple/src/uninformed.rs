//! Beliefs of helpers and hinderers that do not know the other's goal.
//!
//! A helper or hinderer that does not know the other's goal acts on the goal that it supposes. Therefore all
//! its intents share one explanation for each attitude and level of reasoning, and its beliefs, with its
//! suppositions, are computed once. Its own intent follows from what the other is seen to pursue.

use crate::{Hypothesis, ImaginedAgents, Intent, InverseDynamics, beliefs::EstimatedBeliefs};
use phase_event::ObservedEvent;
use phase_model::{Action, AgentId, Attitude, Awareness, Level, Scene, physical_goals};

/// The scene of an observed event in which an agent helps or hinders without knowing the other's goal. The
/// goals in it make no difference.
pub(crate) fn scene(
    observed: &ObservedEvent,
    motion: &InverseDynamics,
    agent: AgentId,
    attitude: Attitude,
    level: Level,
) -> Scene {
    let [goal, ..] = physical_goals(agent.other(), observed.object_sizes().len())[..] else {
        unreachable!("an agent can have a goal")
    };
    let intent = Intent { attitude, goal };
    let mut scene = Hypothesis::of_intent(intent, agent, goal, motion.strengths()).scene(observed);
    scene.agents[agent].awareness = Awareness::ignorant(level);
    scene
}

/// The actions of an agent.
pub(crate) fn actions_of(motion: &InverseDynamics, agent: AgentId) -> Vec<Action> {
    motion.actions.iter().map(|actions| actions[agent]).collect()
}

/// The beliefs, at the end of every step, of a helper or hinderer that does not know the other's goal.
#[derive(Clone, Debug)]
pub(crate) struct UninformedBeliefs {
    agent: AgentId,
    /// Of level 0, and of levels 1 and 2, which learn alike.
    by_level: [EstimatedBeliefs; 2],
}

impl UninformedBeliefs {
    pub(crate) fn new(
        observed: &ObservedEvent,
        motion: &InverseDynamics,
        agent: AgentId,
        agents: &ImaginedAgents,
        seed: u64,
    ) -> Self {
        let actions = actions_of(motion, agent);
        let by_level = [Level::Zero, Level::One].map(|level| {
            let scene = scene(observed, motion, agent, Attitude::Help, level);
            EstimatedBeliefs::in_scene(&scene, &motion.states, &actions, agent, &agents.minds, seed)
        });
        Self { agent, by_level }
    }

    /// Follows an event of which more has been observed, and of whose states so many are what they were.
    pub(crate) fn follow(&mut self, motion: &InverseDynamics, unchanged: usize) {
        let actions = actions_of(motion, self.agent);
        let by_level = self.by_level.iter_mut();
        by_level.for_each(|beliefs| beliefs.follow(&motion.states, &actions, unchanged));
    }

    /// The beliefs of an agent that reasons at a level.
    pub(crate) const fn at(&self, level: Level) -> &EstimatedBeliefs {
        match level {
            Level::Zero => &self.by_level[0],
            Level::One | Level::Two => &self.by_level[1],
        }
    }

    /// The intents that an agent of a level takes the other to have at the end, with shares of its particles.
    pub(crate) fn intents(&self, level: Level) -> impl Iterator<Item = (Intent, f64)> {
        let suppositions = self.at(level).last().suppositions();
        let share = 1.0 / suppositions.len().max(1) as f64;
        suppositions.iter().map(move |supposition| (supposition.intent, share))
    }
}
