//! Explanations of decisions, for the event record and for visualisation.

use phase_model::{Action, Intent, Subgoal};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// A subgoal proposed by some particles, with its value.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct SubgoalValue {
    /// The subgoal.
    pub subgoal: Subgoal,
    /// V(B, h, g) of the paper: share of particles minus λ times their mean cost.
    pub value: f64,
    /// Number of particles that propose it.
    pub particles: usize,
}

/// Search statistics of one root action.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct ActionEvaluation {
    /// The action.
    pub action: Action,
    /// Number of simulations that began with it.
    pub visits: u32,
    /// Mean discounted return of those.
    pub value: f64,
}

/// An intent that an agent believes the other to have.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BelievedIntent {
    /// The intent.
    pub intent: Intent,
    /// Number of particles that have it.
    pub particles: usize,
}

/// One decision of one agent, explained: the subgoal that it pursued, the subgoals that it considered, and
/// the actions that it searched.
///
/// The high level of a mind plans from every particle of its belief, and each plan proposes its first
/// subgoal. The subgoal of the greatest value V is pursued by the low level, a tree search over actions.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Thought {
    /// The subgoal pursued.
    pub subgoal: Subgoal,
    /// All subgoals proposed, the most valuable first.
    pub subgoals: Vec<SubgoalValue>,
    /// The symbolic plan of the first particle that agrees with the subgoal: the agent's own subgoals, in
    /// order.
    pub plan: Vec<Subgoal>,
    /// Every action searched, in the order of the action set; empty where no search was needed.
    pub actions: Vec<ActionEvaluation>,
    /// The intents that the agent believes the other to have, the likeliest first; empty for an agent that
    /// knows the other's goal.
    #[serde(skip)]
    pub intents: Vec<BelievedIntent>,
    /// The probability that the other suspects this agent to hinder it, as the agent sees it, 0 to 1; only
    /// of hinderers of level 2.
    pub suspicion: Option<f64>,
}

impl Thought {
    /// The thought of an idle agent.
    pub const IDLE: Self = Self {
        subgoal: Subgoal::Stay,
        subgoals: Vec::new(),
        plan: Vec::new(),
        actions: Vec::new(),
        intents: Vec::new(),
        suspicion: None,
    };

    /// The thought as JSON with subgoals as people write them, such as `On(agent 0, landmark 1)`: `subgoal`,
    /// `subgoals` with `value` and `particles`, `plan`, `actions` with `visits` and `value`, and, of an agent
    /// that does not know the other's goal, `intents` with `alpha`, `goal`, `words` and `probability`, and,
    /// of one that asks itself whether the other suspects hindrance, `suspicion`.
    #[must_use]
    pub fn described(&self) -> Value {
        let Self { subgoal, subgoals, plan, actions, intents, suspicion } = self;
        let proposed = subgoals.iter().map(
            |it| json!({ "subgoal": it.subgoal.to_string(), "value": it.value, "particles": it.particles }),
        );
        let mut described = json!({
            "subgoal": subgoal.to_string(),
            "subgoals": proposed.collect::<Vec<_>>(),
            "plan": plan.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "actions": actions,
        });
        if !intents.is_empty() {
            let all: usize = intents.iter().map(|it| it.particles).sum();
            let believed = intents.iter().map(|BelievedIntent { intent, particles }| {
                let probability = *particles as f64 / all as f64;
                json!({
                    "alpha": intent.attitude.alpha(), "goal": intent.goal, "words": intent.to_string(),
                    "probability": probability,
                })
            });
            described["intents"] = believed.collect();
        }
        if let Some(suspicion) = suspicion {
            described["suspicion"] = json!(suspicion);
        }
        described
    }

    /// The value of the subgoal pursued; `None` if no particle proposed it.
    #[must_use]
    pub fn pursued(&self) -> Option<&SubgoalValue> {
        self.subgoals.iter().find(|proposed| proposed.subgoal == self.subgoal)
    }

    /// The share of particles that propose the subgoal pursued, 0 to 1.
    #[must_use]
    pub fn share(&self) -> f32 {
        let particles: usize = self.subgoals.iter().map(|proposed| proposed.particles).sum();
        self.pursued().map_or(0.0, |proposed| proposed.particles as f32 / particles.max(1) as f32)
    }
}
