//! Training of SIMPLE's intent network, which `phase_simple::IntentNetwork` evaluates.
//!
//! The loss is the cross-entropy of the true hypothesis among all of them, after every row: half of it after
//! the last row, the rest spread evenly over the others, so that the network can be asked at any moment.

mod hypotheses;

use crate::{
    layer::{Layer, dropout},
    lstm::Lstm,
    parameters::Parameter,
    training::{Loss, Network, PublishedNetwork, TrainingSettings},
};
use candle_core::{D, Device, Module, Result, Tensor};
use candle_nn::ops::log_softmax;
use hypotheses::{GOALS, Hypotheses, truth};
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Attitude, Goal, MAX_OBJECTS, random::Pcg64Mcg};
use phase_simple::intent_network::{FEATURES, GoalFeatures, OUTPUTS, goal_index};
use std::sync::Arc;
use thiserror::Error;

/// Hidden units.
const UNITS: usize = 48;
/// Share of hidden values that are set to 0 in training (dropout), after the embedding and after the LSTM.
const DROPOUT: f32 = 0.4;
/// Share of the loss that is taken after the last row.
const LAST: f32 = 0.5;
/// Sequences of an event: the goals of both agents.
const SEQUENCES: usize = AGENT_COUNT * GOALS;

/// Settings of the network's training.
pub const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 8,
    learning_rate: 2e-3,
    max_gradient_norm: 5.0,
    round: 320,
    patience: 12,
    rounds: 60,
};

/// A training example: an event with the hypothesis that is true of it.
#[derive(Clone, PartialEq, Debug)]
pub struct LabelledIntents {
    /// Row by row, for each of the [`SEQUENCES`], [`FEATURES`] numbers.
    features: Vec<f32>,
    rows: usize,
    objects: usize,
    /// Index among [`Hypotheses`].
    truth: u32,
}

/// No hypothesis is true of an event: both agents are social, or a goal is none that an agent can have.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[error("goals and attitudes are none that are considered")]
pub struct UnknownHypothesis;

impl LabelledIntents {
    /// An event and its labels.
    ///
    /// # Errors
    /// [`UnknownHypothesis`].
    pub fn new(
        event: &ObservedEvent,
        goals: [Goal; AGENT_COUNT],
        attitudes: [Attitude; AGENT_COUNT],
    ) -> core::result::Result<Self, UnknownHypothesis> {
        let objects = event.object_sizes().len();
        let truth = truth(goals, attitudes, objects).ok_or(UnknownHypothesis)?;
        let present = GoalFeatures::new(event);
        let mut features = vec![0.0; event.rows().len() * SEQUENCES * FEATURES];
        for (row, values) in event.rows().iter().zip(features.chunks_exact_mut(SEQUENCES * FEATURES)) {
            for ((agent, goal), of_goal) in present.goals().iter().zip(present.of_row(row)) {
                // The place that the goal has in an event with all objects.
                let Some(index) = goal_index(*agent, *goal, MAX_OBJECTS) else { continue };
                let from = (agent.index() * GOALS + index) * FEATURES;
                values[from..from + FEATURES].copy_from_slice(&of_goal);
            }
        }
        Ok(Self { features, rows: event.rows().len(), objects, truth })
    }
}

/// The network in training; see `phase_simple::IntentNetwork`.
#[derive(Clone, Debug)]
pub struct IntentNetwork {
    embedding: Layer,
    memory: Lstm,
    hidden: Layer,
    output: Layer,
    hypotheses: Arc<Hypotheses>,
}

impl IntentNetwork {
    /// A network with the given number of hidden units in every layer.
    ///
    /// # Errors
    /// If a tensor cannot be allocated.
    pub fn new(units: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            embedding: Layer::new(FEATURES, units, random)?,
            memory: Lstm::new(units, units, random)?,
            hidden: Layer::new(units, units, random)?,
            output: Layer::new(units, OUTPUTS, random)?,
            hypotheses: Arc::new(Hypotheses::new()),
        })
    }

    /// ln Q of every hypothesis after every row from the first step on: rows − 1 tensors of events ×
    /// hypotheses. An event that has ended keeps its last values.
    fn log_probabilities(
        &self,
        events: &[&LabelledIntents],
        mut random: Option<&mut Pcg64Mcg>,
    ) -> Result<Vec<Tensor>> {
        let rows = events.iter().map(|event| event.rows).max().unwrap_or(0);
        let sequences = events.len() * SEQUENCES;
        let priors: Vec<f32> =
            events.iter().flat_map(|event| self.hypotheses.log_priors(event.objects)).collect();
        let count = self.hypotheses.all.len();
        let priors = Tensor::from_vec(priors, (events.len(), count), &Device::Cpu)?;
        let [first, second] = [0, 1].map(|k| {
            let terms: Vec<u32> = self.hypotheses.terms.iter().map(|terms| terms[k]).collect();
            Tensor::from_vec(terms, count, &Device::Cpu)
        });
        let first = first?;
        let second = second?;
        let mut state = self.memory.start(sequences)?;
        let mut all = Vec::with_capacity(rows);
        for row in 0..rows {
            let inputs: Vec<f32> = events.iter().flat_map(|event| event.row(row)).copied().collect();
            let inputs = Tensor::from_vec(inputs, (sequences, FEATURES), &Device::Cpu)?;
            let embedded =
                dropout(&self.embedding.forward(&inputs)?.relu()?, DROPOUT, random.as_deref_mut())?;
            let active: Arc<[bool]> = events.iter().flat_map(|event| [row < event.rows; SEQUENCES]).collect();
            state = self.memory.step(&embedded, &state, Some(active))?;
            if row == 0 {
                continue;
            }
            let seen = dropout(&self.memory.output(&state)?, DROPOUT, random.as_deref_mut())?;
            let logits = self.output.forward(&self.hidden.forward(&seen)?.relu()?)?;
            let logits = logits.reshape((events.len(), SEQUENCES * OUTPUTS))?;
            let joint = (logits.index_select(&first, 1)? + logits.index_select(&second, 1)?)?;
            all.push(log_softmax(&(joint + &priors)?, D::Minus1)?);
        }
        Ok(all)
    }
}

impl LabelledIntents {
    /// The features of a row; those of the last one after the end.
    fn row(&self, row: usize) -> &[f32] {
        let length = SEQUENCES * FEATURES;
        let from = row.min(self.rows - 1) * length;
        &self.features[from..from + length]
    }

    /// The weight of the loss after a row, from 1 on.
    fn weight(&self, row: usize) -> f32 {
        let steps = self.rows.saturating_sub(1).max(1);
        match row {
            row if row > steps => 0.0,
            row if row == steps => LAST + (1.0 - LAST) / steps as f32,
            _ => (1.0 - LAST) / steps as f32,
        }
    }
}

impl Network for IntentNetwork {
    type Sample = LabelledIntents;
    const NAME: &'static str = "intent-network";
    const METRICS: &'static [&'static str] = &["goal", "relation"];

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.embedding.parameters("embedding");
        parameters.extend(self.memory.parameters("memory"));
        parameters.extend(self.hidden.parameters("hidden"));
        parameters.extend(self.output.parameters("output"));
        parameters
    }

    fn loss(&self, events: &[&LabelledIntents], random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        let logs = self.log_probabilities(events, random)?;
        let Some(last) = logs.last() else { candle_core::bail!("there is no event with a step to look at") };
        let truths: Vec<u32> = events.iter().map(|event| event.truth).collect();
        let truths = Tensor::from_vec(truths, (events.len(), 1), &Device::Cpu)?;
        let mut loss = Tensor::zeros((), last.dtype(), &Device::Cpu)?;
        for (k, logs) in logs.iter().enumerate() {
            let weights: Vec<f32> = events.iter().map(|event| event.weight(k + 1)).collect();
            let weights = Tensor::from_vec(weights, (events.len(), 1), &Device::Cpu)?;
            loss = (loss - (logs.gather(&truths, 1)? * weights)?.sum_all()?)?;
        }
        let loss = (loss / events.len() as f64)?;
        let probabilities: Vec<Vec<f32>> = last.detach().exp()?.to_vec2()?;
        let scores =
            events.iter().zip(&probabilities).map(|(event, p)| self.hypotheses.score(event.truth, p));
        let (goal, relation) =
            scores.fold((0.0, 0.0), |(goal, relation), score| (goal + score[0], relation + score[1]));
        let count = events.len() as f64;
        Ok(Loss { loss, scores: vec![goal / count, relation / count] })
    }
}

impl PublishedNetwork for IntentNetwork {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::INTENT_NETWORK.weights;
    const BUNDLED_RECORD: &'static str = phase_data::INTENT_NETWORK.record;

    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(UNITS, random)
    }
}

#[cfg(test)]
mod tests {
    use super::{IntentNetwork, LabelledIntents};
    use crate::training::{Network, TrainingRun, to_safetensors};
    use phase_event::ObservedEvent;
    use phase_model::{AgentId, Attitude, Body, Goal, LandmarkId, Layout, ObjectId, Sign, Size, Vec2};
    use phase_simple::Hypothesis;
    use std::sync::Arc;

    fn goal(agent: AgentId) -> Goal {
        Goal::AgentOnLandmark { agent, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive }
    }

    /// An event with some motion.
    fn event(objects: usize, steps: u8) -> ObservedEvent {
        let rows = (0..=steps).map(|step| {
            let t = f32::from(step);
            let places = [[8.0 + 0.5 * t, 6.0], [20.0, 18.0 - 0.3 * t], [12.0, 12.0], [22.0, 8.0 + 0.1 * t]];
            let mut row = places.map(|[x, y]| Body::at_rest(Vec2::new(x, y), 0.1 * t));
            row[0].velocity = Vec2::new(6.0, 0.0);
            row
        });
        let sizes = [Size::Small, Size::Large][..objects].to_vec();
        let layout = Layout::new(8, None).expect("a layout");
        ObservedEvent::new(layout, [Size::Small, Size::Medium], sizes, rows.collect()).expect("an event")
    }

    /// The network in training and the one that SIMPLE evaluates give the same probabilities.
    #[test]
    fn the_evaluated_network_is_the_trained_one() {
        let mut random = TrainingRun::<IntentNetwork>::first_weights(3);
        let network = IntentNetwork::new(7, &mut random).expect("a network");
        let bytes = to_safetensors(&network).expect("a file");
        let evaluated = phase_simple::IntentNetwork::from_safetensors(&bytes).expect("the same network");
        let evaluated = Arc::new(evaluated);
        for objects in 0..=2 {
            let long = event(objects, 9);
            let short = event(objects, 4);
            let labelled = [&long, &short].map(|event| {
                LabelledIntents::new(event, AgentId::ALL.map(goal), [Attitude::Neutral; 2]).expect("labels")
            });
            let logs = network.log_probabilities(&[&labelled[0], &labelled[1]], None).expect("logs");
            let last: Vec<Vec<f32>> =
                logs.last().expect("steps").exp().and_then(|p| p.to_vec2()).expect("values");
            for (event, trained) in [&long, &short].into_iter().zip(last) {
                let posterior = evaluated.posterior(event);
                assert_eq!(
                    posterior.hypotheses.len(),
                    if objects == 2 { 252 } else { posterior.hypotheses.len() }
                );
                for (hypothesis, weight) in &posterior.hypotheses {
                    let same = |other: &&Hypothesis| {
                        other.goals == hypothesis.goals && other.attitudes == hypothesis.attitudes
                    };
                    let index = network.hypotheses.all.iter().position(|other| same(&other)).expect("known");
                    assert!((f64::from(trained[index]) - weight).abs() < 1e-5, "{hypothesis:?}");
                }
            }
        }
    }

    /// The truth is found for every role, and refused where there is none.
    #[test]
    fn true_hypotheses() {
        let event = event(2, 2);
        let hypotheses = super::Hypotheses::new();
        let [first, _] = ObjectId::ALL;
        let fetch =
            Goal::ObjectOnLandmark { object: first, landmark: LandmarkId::TOP_LEFT, sign: Sign::Positive };
        let chase = |sign| Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign };
        for (goals, attitudes) in [
            ([goal(AgentId::ZERO), fetch], [Attitude::Neutral; 2]),
            ([chase(Sign::Positive), chase(Sign::Negative)], [Attitude::Neutral; 2]),
            ([fetch, fetch], [Attitude::Help, Attitude::Neutral]),
            ([fetch, fetch.negated()], [Attitude::Neutral, Attitude::Hinder]),
        ] {
            let labelled = LabelledIntents::new(&event, goals, attitudes).expect("labels");
            let truth = hypotheses.all[labelled.truth as usize];
            assert_eq!((truth.goals, truth.attitudes), (goals, attitudes));
        }
        let both = [Attitude::Help, Attitude::Help];
        assert!(LabelledIntents::new(&event, [fetch, fetch], both).is_err());
        let without = self::event(0, 2);
        assert!(LabelledIntents::new(&without, [fetch, fetch], [Attitude::Neutral; 2]).is_err());
    }

    /// The weights of the loss sum to 1, and to half after the last row and before.
    #[test]
    fn the_loss_is_a_mean() {
        let event = event(2, 9);
        let labelled =
            LabelledIntents::new(&event, AgentId::ALL.map(goal), [Attitude::Neutral; 2]).expect("labels");
        let sum: f32 = (1..20).map(|row| labelled.weight(row)).sum();
        assert!((sum - 1.0).abs() < 1e-6);
        let network =
            IntentNetwork::new(5, &mut TrainingRun::<IntentNetwork>::first_weights(1)).expect("a network");
        let loss = network.loss(&[&labelled], None).expect("a loss");
        let loss = loss.loss.to_scalar::<f32>().expect("a number");
        // An untrained network spreads its probability over 252 hypotheses.
        assert!((3.0..8.0).contains(&loss), "{loss}");
    }
}
