//! Scores of beliefs: where each agent believes each entity to be.

use crate::{Estimate, goals::Calibration};
use phase_event::{BeliefOrder, Beliefs, PLACES, Whereabouts, others};
use phase_model::AgentId;
use phase_statistics::mean;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Steps from one question to the next: a second of video.
pub const STRIDE: usize = 4;

/// Least share of the particles that have to agree on a place for its belief to be asked about.
pub const AGREEMENT: f64 = 0.6;

/// The steps of an event after which beliefs are asked about.
#[must_use]
pub fn asked_steps(steps: usize) -> Vec<usize> {
    (STRIDE..=steps).step_by(STRIDE).collect()
}

/// A question about one belief, with its answer.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct BeliefQuestion {
    /// After which step.
    pub step: usize,
    /// Whose belief.
    pub agent: AgentId,
    /// Number of the entity: 0 and 1 are the agents, 2 and 3 the objects.
    pub entity: usize,
    /// Whether the agent does not see it; of beliefs about beliefs, whether it is not certain that the other
    /// does.
    pub unseen: bool,
    /// Whether it is not seen and in another room than when the agent, or the other, could last see it, or at
    /// the start.
    pub moved: bool,
    /// The belief.
    pub truth: Whereabouts,
    /// The belief that the method ascribes to the agent.
    pub answer: Whereabouts,
}

impl BeliefQuestion {
    /// Whether the likeliest place is the right one; of several the first.
    #[must_use]
    pub fn is_right(&self) -> bool {
        likeliest(&self.answer) == likeliest(&self.truth)
    }

    /// The squared distance of the probabilities, 0 to 2.
    #[must_use]
    pub fn brier(&self) -> f64 {
        self.answer.iter().zip(&self.truth).map(|(answer, truth)| (answer - truth) * (answer - truth)).sum()
    }
}

/// An event with the answers of a method.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct BeliefEvent {
    /// Its name.
    pub id: String,
    /// The beliefs that are asked about.
    pub order: BeliefOrder,
    /// Every question.
    pub questions: Vec<BeliefQuestion>,
    /// CPU time of the answers (s), if measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f64>,
    /// Details of the method.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub details: Value,
}

impl BeliefEvent {
    /// The questions about some beliefs, as far as the particles agree on a place, with their answers.
    /// `truth` and `answers` have one entry for each of the steps; `moved` says whether an entity that an
    /// agent does not see was moved meanwhile.
    ///
    /// # Errors
    /// A sentence, if the answers have another form, or are no probabilities.
    pub fn questions(
        order: BeliefOrder,
        steps: &[usize],
        objects: usize,
        truth: &[Beliefs],
        answers: &[Beliefs],
        moved: impl Fn(usize, AgentId, usize) -> bool,
    ) -> Result<Vec<BeliefQuestion>, String> {
        if answers.len() != steps.len() {
            return Err(format!("beliefs after {} steps are needed, not {}", steps.len(), answers.len()));
        }
        let mut questions = Vec::new();
        for ((&step, truth), answer) in steps.iter().zip(truth).zip(answers) {
            for agent in AgentId::ALL {
                let count = others(order.viewer(agent), objects).count();
                if answer[agent].len() != count {
                    return Err(format!("agent {agent} has beliefs about {count} entities"));
                }
                for (k, entity) in others(order.viewer(agent), objects).enumerate() {
                    let (truth, answer) = (truth[agent][k], answer[agent][k]);
                    let sum: f64 = answer.iter().sum();
                    if (sum - 1.0).abs() > 1e-6 || answer.iter().any(|p| !(0.0..=1.0 + 1e-9).contains(p)) {
                        return Err("probabilities are 0 to 1 and sum to 1".into());
                    }
                    if truth[likeliest(&truth)] < AGREEMENT {
                        continue;
                    }
                    let unseen = truth[phase_event::SEEN] < 1.0;
                    let entity = entity.index();
                    let moved = unseen && moved(step, agent, entity);
                    questions.push(BeliefQuestion { step, agent, entity, unseen, moved, truth, answer });
                }
            }
        }
        Ok(questions)
    }
}

fn likeliest(places: &Whereabouts) -> usize {
    (0..PLACES).fold(0, |best, place| if places[place] > places[best] { place } else { best })
}

/// Scores over some questions, those of each event of equal weight.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct BeliefScores {
    /// Events with such questions.
    pub n: usize,
    /// Questions.
    pub questions: usize,
    /// Share of right answers.
    pub accuracy: Estimate,
    /// Squared distance of the probabilities, 0 to 2.
    pub brier: Estimate,
    /// Reliability of the probability of the answer, and the expected calibration error.
    pub calibration: Calibration,
}

/// Scores of a method.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct BeliefSummary {
    /// Events.
    pub n: usize,
    /// The beliefs that were asked about.
    pub order: BeliefOrder,
    /// About all entities.
    pub all: Option<BeliefScores>,
    /// About those that the agent does not see.
    pub unseen: Option<BeliefScores>,
    /// About those that were moved since the agent could last see them.
    pub moved: Option<BeliefScores>,
    /// Mean CPU time of the answers to an event (s), if measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_seconds_per_event: Option<f64>,
}

impl BeliefSummary {
    /// The scores over some events; `None` without any. The seed is that of intervals.
    #[must_use]
    pub fn of(events: &[BeliefEvent], seed: u64) -> Option<Self> {
        let scores = |asked: fn(&BeliefQuestion) -> bool| scores(events, seed, asked);
        let times: Vec<f64> = events.iter().filter_map(|event| event.cpu_seconds).collect();
        events.first().map(|first| Self {
            n: events.len(),
            order: first.order,
            all: scores(|_| true),
            unseen: scores(|it| it.unseen),
            moved: scores(|it| it.moved),
            cpu_seconds_per_event: mean(&times),
        })
    }
}

fn scores(events: &[BeliefEvent], seed: u64, asked: fn(&BeliefQuestion) -> bool) -> Option<BeliefScores> {
    let scored = |it: &BeliefQuestion| ScoredAnswer {
        right: it.is_right(),
        brier: it.brier(),
        confidence: it.answer[likeliest(&it.answer)],
    };
    let of = |event: &BeliefEvent| event.questions.iter().filter(|it| asked(it)).map(scored).collect();
    scores_of(events.iter().map(of), seed)
}

/// An answer to a question about a belief, compared with the truth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct ScoredAnswer {
    /// Whether the likeliest is the right one.
    pub(crate) right: bool,
    /// Squared distance of the probabilities.
    pub(crate) brier: f64,
    /// Probability of the likeliest.
    pub(crate) confidence: f64,
}

/// The scores over the answers to each of some events; `None` without any.
pub(crate) fn scores_of(events: impl Iterator<Item = Vec<ScoredAnswer>>, seed: u64) -> Option<BeliefScores> {
    let mut answers = Vec::new();
    let (mut right, mut brier) = (Vec::new(), Vec::new());
    for event in events {
        let of_event = |of: fn(&ScoredAnswer) -> f64| mean(&event.iter().map(of).collect::<Vec<f64>>());
        right.extend(of_event(|it| f64::from(u8::from(it.right))));
        brier.extend(of_event(|it| it.brier));
        answers.extend(event.iter().map(|it| (it.confidence, it.right)));
    }
    Some(BeliefScores {
        n: right.len(),
        questions: answers.len(),
        accuracy: Estimate::of(&right, seed)?,
        brier: Estimate::of(&brier, seed)?,
        calibration: Calibration::of(&answers),
    })
}
