//! Evidence of a helper or hinderer that finds out what the other wants, from its thoughts.

use phase_event::{Event, Thought};
use phase_model::{AgentId, Attitude, Level, Subgoal};

/// Least time of watching before the first act that is seen as such (steps; 2 s).
const MIN_WATCHED: usize = 8;
/// Least time for which an agent acts on a mistake that is seen as one (steps; 1 s).
const MIN_MISTAKEN: usize = 4;
/// Least time for which an agent acts on the right intent (steps; 2 s).
const MIN_RIGHT: usize = 8;

/// The steps of an event in which a helper or hinderer that has to find out the other's goal watches and
/// acts.
///
/// It acts in a step if it pursues a subgoal of a plan. Its act is right if the intent that most of its
/// particles suppose has the goal that the other pursues.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Discovery {
    /// Steps before the first act; all if there is none.
    pub watched: usize,
    /// Acts on a wrong intent before the first on the right one; all if none is right.
    pub mistaken: usize,
    /// Acts on a wrong intent.
    pub wrong: usize,
    /// Acts on the right intent.
    pub right: usize,
}

impl Discovery {
    /// The discovery in a simulated event; `None` if no agent helps or hinders, or if that agent knows the
    /// other's goal or, at level 0, does not reason about it.
    #[must_use]
    pub fn of(event: &Event) -> Option<Self> {
        let agents = &event.scene.agents;
        let social = AgentId::ALL.into_iter().find(|&it| agents[it].attitude != Attitude::Neutral)?;
        if agents[social].awareness.knows.level()? == Level::Zero {
            return None;
        }
        let goal = agents[social.other()].goal;
        // A plan is missing where the agent only looks for the other.
        let acts = |thought: &Thought| thought.subgoal != Subgoal::Stay && !thought.plan.is_empty();
        let right = |thought: &Thought| thought.intents.first().is_some_and(|it| it.intent.goal == goal);
        let thoughts: Vec<&Thought> = event.steps.iter().map(|step| &step.thoughts[social]).collect();
        let watched = thoughts.iter().position(|it| acts(it)).unwrap_or(thoughts.len());
        let of_acts: Vec<bool> = thoughts.into_iter().filter(|it| acts(it)).map(right).collect();
        let count = of_acts.iter().filter(|right| **right).count();
        Some(Self {
            watched,
            mistaken: of_acts.iter().take_while(|right| !**right).count(),
            wrong: of_acts.len() - count,
            right: count,
        })
    }

    /// Whether the agent acts on the right intent for two seconds, and for longer than on wrong ones.
    #[must_use]
    pub const fn succeeds(&self) -> bool {
        self.right >= MIN_RIGHT && self.right > self.wrong
    }

    /// Whether it watches for two seconds before it acts, and then acts on the right intent.
    #[must_use]
    pub const fn watches_first(&self) -> bool {
        self.watched >= MIN_WATCHED && self.right >= MIN_RIGHT
    }

    /// Whether it acts on a wrong intent for a second before it acts on the right one.
    #[must_use]
    pub const fn corrects_itself(&self) -> bool {
        self.mistaken >= MIN_MISTAKEN && self.right >= MIN_RIGHT
    }
}
