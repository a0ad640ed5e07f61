//! Evidence of a helper or hinderer that finds out what the other wants, from its thoughts.

use crate::Track;
use phase_event::{Event, Thought};
use phase_model::{AgentId, Attitude, Entity, Goal, Level, Subgoal};
use phase_perception::observed_set;
use std::collections::BTreeMap;

/// Least time of watching before the first act that is seen as such (steps; 2 s).
const MIN_WATCHED: usize = 8;
/// Least time for which an agent acts on a mistake that is seen as one (steps; 1 s).
const MIN_MISTAKEN: usize = 4;
/// Least time for which an agent acts on the right intent (steps; 2 s).
const MIN_RIGHT: usize = 8;
/// Least time of watching in which a goal is shown (steps; 1 s).
const MIN_SHOWN: usize = 4;
/// Least way that the other is seen to go in it (u).
const MIN_SHOWN_WAY: f32 = 1.0;

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
    /// Acts while at least half of the particles have one wrong goal.
    pub misled: usize,
    /// From the beginning of the watching in which it learns the right goal to the first step at which at
    /// least half of the particles have that; `None` if it acts before this step, or they never have it.
    pub learning: Option<(usize, usize)>,
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
        let misled = thoughts.iter().filter(|it| acts(it) && believes(it, |it| it != goal)).count();
        let learnt = thoughts.iter().position(|thought| believes(thought, |it| it == goal));
        let learning = learnt.and_then(|learnt| {
            let begin = thoughts[..learnt].iter().rposition(|it| acts(it)).map_or(0, |act| act + 1);
            (begin < learnt).then_some((begin, learnt))
        });
        let of_acts: Vec<bool> = thoughts.into_iter().filter(|it| acts(it)).map(right).collect();
        let count = of_acts.iter().filter(|right| **right).count();
        Some(Self {
            watched,
            mistaken: of_acts.iter().take_while(|right| !**right).count(),
            wrong: of_acts.len() - count,
            right: count,
            misled,
            learning,
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

    /// Whether it acts for a second while it is rather sure of a wrong goal, whatever it does then.
    #[must_use]
    pub const fn is_misled(&self) -> bool {
        self.misled >= MIN_MISTAKEN
    }

    /// Whether the agent watches for a second until it learns the right goal, sees the other go 1 u
    /// meanwhile, and then acts on that goal for two seconds.
    #[must_use]
    pub fn is_shown(&self, track: &Track, agent: AgentId) -> bool {
        let Some((begin, learnt)) = self.learning else { return false };
        let other = Entity::Agent(agent.other());
        let sees = |step: &usize| {
            let state = track.states.get(*step);
            state.is_some_and(|state| observed_set(&track.physics, state, agent).contains(other))
        };
        let seen = (begin + 1..=learnt).filter(sees).map(|step| track.distance_in_step(other, step));
        learnt - begin >= MIN_SHOWN && seen.sum::<f32>() >= MIN_SHOWN_WAY && self.right >= MIN_RIGHT
    }
}

/// Whether at least half of the particles have one goal that satisfies a condition.
fn believes(thought: &Thought, condition: impl Fn(Goal) -> bool) -> bool {
    let mut shares: BTreeMap<Goal, usize> = BTreeMap::new();
    for it in &thought.intents {
        *shares.entry(it.intent.goal).or_default() += it.particles;
    }
    let all: usize = shares.values().sum();
    shares.into_iter().any(|(goal, share)| 2 * share >= all && share > 0 && condition(goal))
}
