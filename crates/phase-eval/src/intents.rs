//! Scores of believed intents: what each agent that does not know it takes the other to want.

use crate::{
    beliefs::{AGREEMENT, BeliefScores, ScoredAnswer, scores_of},
    goals::canonical,
};
use phase_model::{AGENT_COUNT, AgentId, Intent};
use phase_statistics::mean;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// For each agent the intents that it takes the other to have, with their probabilities, which sum to 1.
pub type BelievedIntents = [BTreeMap<Intent, f64>; AGENT_COUNT];

/// A question about what an agent takes the other to want, with its answer.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct IntentQuestion {
    /// After which step.
    pub step: usize,
    /// Whose belief.
    pub agent: AgentId,
    /// Likeliest intent in its particles.
    pub truth: Intent,
    /// Share of the particles that have it.
    pub share: f64,
    /// Whether the other has another intent.
    pub mistaken: bool,
    /// The likeliest intent in the answer.
    pub answer: Intent,
    /// Its probability.
    pub confidence: f64,
    /// Squared distance of the probabilities of all intents from the shares of particles, 0 to 2.
    pub brier: f64,
}

impl IntentQuestion {
    fn scored(&self) -> ScoredAnswer {
        ScoredAnswer { right: self.answer == self.truth, brier: self.brier, confidence: self.confidence }
    }
}

/// An event with the answers of a method.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct IntentEvent {
    /// Its name.
    pub id: String,
    /// Every question; none if all agents know each other's goals.
    pub questions: Vec<IntentQuestion>,
    /// CPU time of the answers (s), if measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f64>,
    /// Details of the method.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub details: Value,
}

impl IntentEvent {
    /// The questions after some steps about agents that do not know the other's goal, as far as their
    /// particles agree on an intent. `truth` is empty for an agent that knows it. `intents` are those that
    /// the agents have.
    ///
    /// # Errors
    /// A sentence, if the answers are too few, or no probabilities.
    pub fn questions(
        steps: &[usize],
        truth: &[BelievedIntents],
        answers: &[BelievedIntents],
        intents: [Intent; AGENT_COUNT],
    ) -> Result<Vec<IntentQuestion>, String> {
        if answers.len() != steps.len() {
            return Err(format!("intents after {} steps are needed, not {}", steps.len(), answers.len()));
        }
        let mut questions = Vec::new();
        for ((&step, truth), answer) in steps.iter().zip(truth).zip(answers) {
            for agent in AgentId::ALL {
                let [truth, answer] = [&truth[agent], &answer[agent]].map(merged);
                let Some((right, share)) = likeliest(&truth).filter(|(_, share)| *share >= AGREEMENT) else {
                    continue;
                };
                let sum: f64 = answer.values().sum();
                let is_probability = |p: &f64| (0.0..=1.0 + 1e-9).contains(p);
                let Some((said, confidence)) = likeliest(&answer).filter(|_| (sum - 1.0).abs() <= 1e-6)
                else {
                    return Err("probabilities of intents sum to 1".into());
                };
                if !answer.values().all(is_probability) {
                    return Err("probabilities are 0 to 1".into());
                }
                questions.push(IntentQuestion {
                    step,
                    agent,
                    truth: right,
                    share,
                    mistaken: right != form(intents[agent.other()]),
                    answer: said,
                    confidence,
                    brier: distance(&truth, &answer),
                });
            }
        }
        Ok(questions)
    }
}

/// The form in which intents are compared.
fn form(intent: Intent) -> Intent {
    Intent { goal: canonical(intent.goal), ..intent }
}

/// Probabilities of intents that are the same added up.
fn merged(intents: &BTreeMap<Intent, f64>) -> BTreeMap<Intent, f64> {
    let mut all = BTreeMap::new();
    for (&intent, p) in intents {
        *all.entry(form(intent)).or_default() += p;
    }
    all
}

/// The likeliest intent, of several the first.
fn likeliest(intents: &BTreeMap<Intent, f64>) -> Option<(Intent, f64)> {
    let first = |best: Option<(Intent, f64)>, (&intent, &p): (&Intent, &f64)| match best {
        Some((_, most)) if most >= p => best,
        _ => Some((intent, p)),
    };
    intents.iter().fold(None, first)
}

fn distance(a: &BTreeMap<Intent, f64>, b: &BTreeMap<Intent, f64>) -> f64 {
    let square = |intent: &Intent| {
        let of = |intents: &BTreeMap<Intent, f64>| intents.get(intent).copied().unwrap_or_default();
        (of(a) - of(b)) * (of(a) - of(b))
    };
    let only_in_b = b.keys().filter(|intent| !a.contains_key(intent));
    a.keys().chain(only_in_b).map(square).sum()
}

/// Scores after one step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct IntentStep {
    /// The step.
    pub step: usize,
    /// Scores of the questions after it.
    pub scores: BeliefScores,
}

/// Scores of a method.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct IntentSummary {
    /// Events.
    pub n: usize,
    /// About all beliefs.
    pub all: Option<BeliefScores>,
    /// About those that are not what the other wants.
    pub mistaken: Option<BeliefScores>,
    /// By the step after which was asked.
    pub by_step: Vec<IntentStep>,
    /// Mean CPU time of the answers to an event (s), if measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_seconds_per_event: Option<f64>,
}

impl IntentSummary {
    /// The scores over some events; `None` without any. The seed is that of intervals.
    #[must_use]
    pub fn of(events: &[IntentEvent], seed: u64) -> Option<Self> {
        let scores = |asked: &dyn Fn(&IntentQuestion) -> bool| {
            let of = |event: &IntentEvent| {
                event.questions.iter().filter(|it| asked(it)).map(IntentQuestion::scored).collect()
            };
            scores_of(events.iter().map(of), seed)
        };
        let last = events.iter().flat_map(|event| event.questions.iter().map(|it| it.step)).max();
        let after = |step: usize| {
            scores(&|it: &IntentQuestion| it.step == step).map(|scores| IntentStep { step, scores })
        };
        let times: Vec<f64> = events.iter().filter_map(|event| event.cpu_seconds).collect();
        (!events.is_empty()).then(|| Self {
            n: events.len(),
            all: scores(&|_| true),
            mistaken: scores(&|it: &IntentQuestion| it.mistaken),
            by_step: (0..=last.unwrap_or_default()).filter_map(after).collect(),
            cpu_seconds_per_event: mean(&times),
        })
    }
}
