//! Common parts of the networks for Task 1: labels, loss, predictions.

use crate::{
    goals::{CLASSES, class_of, classes, is_absent},
    nodes::{Batch, Nodes},
    training::{Loss, Metrics, TrainingSettings},
};
use candle_core::{D, DType, Device, Result, Tensor};
use candle_nn::ops::log_softmax;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Goal, Judgement, Relation, RelationProbabilities, random::Pcg64Mcg};
use thiserror::Error;

/// The relations in the order of the networks' outputs.
pub const RELATIONS: [Relation; 3] = [Relation::Friendly, Relation::Adversarial, Relation::Neutral];
/// Settings of the training of these networks: batch size and learning rate are the paper's.
pub const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 8,
    learning_rate: 1e-3,
    max_gradient_norm: 10.0,
    round: 320,
    patience: 25,
    rounds: 200,
};
/// Metrics beside the loss: shares of correct goals and of correct relations.
pub(crate) const METRICS: [&str; 2] = ["goal", "relation"];
/// Added to logits of impossible classes: their probability is 0.
const MASKED_LOGIT: f32 = -1e9;

/// A training example: an event with its labels.
#[derive(Clone, PartialEq, Debug)]
pub struct LabelledEvent {
    pub(crate) nodes: Nodes,
    goals: [u32; AGENT_COUNT],
    /// Its place in [`RELATIONS`].
    pub(crate) relation: u32,
}

/// A goal that is none of the [`classes`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[error("the goal of agent {agent} has no class")]
pub struct LabelError {
    /// The agent whose goal it is.
    pub agent: AgentId,
}

impl LabelledEvent {
    /// An event and its labels.
    ///
    /// # Errors
    /// If a goal has no class, or is about an object that is not there.
    pub fn new(
        event: &ObservedEvent,
        goals: [Goal; AGENT_COUNT],
        relation: Relation,
    ) -> core::result::Result<Self, LabelError> {
        let objects = event.object_sizes().len();
        let mut labels = [0; AGENT_COUNT];
        for (agent, (label, goal)) in AgentId::ALL.into_iter().zip(labels.iter_mut().zip(goals)) {
            let class = class_of(agent, goal).filter(|&class| !is_absent(class, objects));
            *label = class.ok_or(LabelError { agent })? as u32;
        }
        let relation = RELATIONS.iter().position(|known| *known == relation).unwrap_or(0) as u32;
        Ok(Self { nodes: Nodes::of(event), goals: labels, relation })
    }
}

/// The logits of a network for some events.
#[derive(Clone, Debug)]
pub struct Logits {
    /// events × 2 × [`CLASSES`].
    pub goals: Tensor,
    /// events × 3, in the order of [`RELATIONS`].
    pub relations: Tensor,
}

impl Logits {
    /// The logarithms of the probabilities, those of goals about absent objects so low that they are 0.
    ///
    /// # Errors
    /// If shapes do not match the events.
    pub fn log_probabilities(&self, batch: &Batch) -> Result<Self> {
        let possible = batch.objects().iter().flat_map(|&objects| {
            (0..CLASSES).map(move |class| if is_absent(class, objects) { MASKED_LOGIT } else { 0.0 })
        });
        let shape = (batch.events(), 1, CLASSES);
        let possible = Tensor::from_vec(possible.collect::<Vec<f32>>(), shape, &Device::Cpu)?;
        Ok(Self {
            goals: log_softmax(&self.goals.broadcast_add(&possible)?, D::Minus1)?,
            relations: log_softmax(&self.relations, D::Minus1)?,
        })
    }
}

/// A network that recognises goals and relations.
pub trait Recognition {
    /// The logits for some events. Networks that use a part of their input sample it in training mode;
    /// without a generator they use all of it.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    fn logits(&self, batch: &Batch, random: Option<&mut Pcg64Mcg>) -> Result<Logits>;

    /// The prediction for one event, goals most likely first.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    fn judge(&self, event: &ObservedEvent) -> Result<Judgement> {
        let nodes = Nodes::of(event);
        let batch = Batch::new(&[&nodes])?;
        let Logits { goals, relations } = self.logits(&batch, None)?.log_probabilities(&batch)?;
        let objects = event.object_sizes().len();
        let mut judgement = Judgement::default();
        for (agent, ranked) in AgentId::ALL.into_iter().zip(&mut judgement.goals) {
            let logs: Vec<f32> = goals.get(0)?.get(agent.index())?.to_vec1()?;
            let shares = probabilities(&logs);
            let all = classes(agent).into_iter().zip(shares).enumerate();
            *ranked = all.filter(|(class, _)| !is_absent(*class, objects)).map(|(_, share)| share).collect();
            ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        }
        judgement.relation = relation_probabilities(&relations)?;
        Ok(judgement)
    }
}

/// The probabilities of the relations in the first row of their logarithms (rows × 3).
pub(crate) fn relation_probabilities(logs: &Tensor) -> Result<RelationProbabilities> {
    Ok(match probabilities(&logs.get(0)?.to_vec1()?)[..] {
        [friendly, adversarial, neutral] => RelationProbabilities { friendly, adversarial, neutral },
        _ => RelationProbabilities::default(),
    })
}

/// Cross-entropy of goals, a mean over the agents, plus that of relations.
pub(crate) fn loss(
    network: &impl Recognition,
    events: &[&LabelledEvent],
    random: Option<&mut Pcg64Mcg>,
) -> Result<Loss> {
    let nodes: Vec<&Nodes> = events.iter().map(|event| &event.nodes).collect();
    let batch = Batch::new(&nodes)?;
    let said = network.logits(&batch, random)?.log_probabilities(&batch)?;
    let goals: Vec<u32> = events.iter().flat_map(|event| event.goals).collect();
    let relations: Vec<u32> = events.iter().map(|event| event.relation).collect();
    let (goal_loss, goal_score) = cross_entropy(&said.goals.reshape(((), CLASSES))?, goals)?;
    let (relation_loss, relation_score) = cross_entropy(&said.relations, relations)?;
    Ok(Loss { loss: (goal_loss + relation_loss)?, scores: vec![goal_score, relation_score] })
}

/// The sum of the error rates of goals and of relations. The loss soon rises again because of overconfident
/// errors, while accuracy still improves.
pub(crate) fn selection_loss(evaluate: &Metrics) -> f64 {
    evaluate.scores.iter().map(|right| 1.0 - right).sum()
}

/// Mean cross-entropy of the true classes, and top-1 accuracy.
fn cross_entropy(logs: &Tensor, right: Vec<u32>) -> Result<(Tensor, f64)> {
    let (likelihoods, accuracy) = log_likelihoods(logs, right)?;
    Ok((likelihoods.mean_all()?.neg()?, accuracy))
}

/// The logarithms of the probabilities of the true classes (rows × 1), and top-1 accuracy.
pub(crate) fn log_likelihoods(logs: &Tensor, right: Vec<u32>) -> Result<(Tensor, f64)> {
    let count = right.len();
    let right = Tensor::from_vec(right, (count, 1), &Device::Cpu)?;
    let hits = logs.argmax_keepdim(1)?.eq(&right)?.to_dtype(DType::F32)?.mean_all()?;
    Ok((logs.gather(&right, 1)?, f64::from(hits.to_scalar::<f32>()?)))
}

/// Probabilities that sum to 1, from their logarithms.
fn probabilities(logs: &[f32]) -> Vec<f64> {
    let shares: Vec<f64> = logs.iter().map(|&log| libm::exp(f64::from(log))).collect();
    let sum: f64 = shares.iter().sum();
    shares.into_iter().map(|share| share / sum).collect()
}
