//! A network for beliefs: in which room each agent believes each entity to be that it does not see.
//!
//! For each agent, each other entity and each room, one network follows the event row by row, forwards and
//! backwards, and gives a score; the probabilities of the four rooms are the softmax of their scores. So it
//! looks at the motion before and after, as SIMPLE does, and does not know which room is which. Whether an
//! agent sees an entity follows from where they are, and is not learnt.

mod features;

use crate::{
    layer::{Layer, dropout},
    lstm::Lstm,
    parameters::Parameter,
    training::{Loss, Network, PublishedNetwork, TrainingSettings},
};
use candle_core::{D, Device, Module, Result, Tensor};
use candle_nn::ops::log_softmax;
use features::{BELIEFS, FEATURES, OTHERS, ROOMS, RoomFeatures, index_of};
use phase_event::{Beliefs, ObservedEvent, SEEN, Whereabouts, certain};
use phase_model::{AgentId, random::Pcg64Mcg};
use std::sync::Arc;

/// Hidden units.
const UNITS: usize = 32;
/// Share of hidden values that are set to 0 in training, after the embedding and after the LSTMs.
const DROPOUT: f32 = 0.3;
/// Sequences of an event: rooms of beliefs.
const SEQUENCES: usize = BELIEFS * ROOMS;

/// Settings of the network's training.
pub const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 8,
    learning_rate: 2e-3,
    max_gradient_norm: 5.0,
    round: 320,
    patience: 8,
    rounds: 60,
};

/// A training example: an event with the beliefs of its agents.
#[derive(Clone, PartialEq, Debug)]
pub struct LabelledBeliefs {
    features: RoomFeatures,
    rows: usize,
    objects: usize,
    /// The probability of each room, by row, belief and room; zeros where the agent sees the entity, or there
    /// is none.
    truth: Vec<f32>,
}

impl LabelledBeliefs {
    /// An event with the beliefs of its agents in every row; later ones are ignored.
    #[must_use]
    pub fn new(event: &ObservedEvent, beliefs: &[Beliefs]) -> Self {
        let mut labelled = Self::unlabelled(event);
        for (row, beliefs) in beliefs.iter().enumerate().take(labelled.rows) {
            for agent in AgentId::ALL {
                for (other, places) in beliefs[agent].iter().enumerate().take(OTHERS) {
                    let belief = row * BELIEFS + index_of(agent, other);
                    if !labelled.features.seen[belief] && places[SEEN] < 1.0 {
                        let rooms = &mut labelled.truth[belief * ROOMS..][..ROOMS];
                        rooms.iter_mut().zip(places).for_each(|(room, &place)| *room = place as f32);
                    }
                }
            }
        }
        labelled
    }

    fn unlabelled(event: &ObservedEvent) -> Self {
        let rows = event.rows().len();
        Self {
            features: RoomFeatures::of(event),
            rows,
            objects: event.object_sizes().len(),
            truth: vec![0.0; rows * SEQUENCES],
        }
    }

    /// A part of a list with so many numbers a row: that of a row, or of the last one after the end.
    fn of_row<'a>(&self, list: &'a [f32], row: usize, length: usize) -> &'a [f32] {
        &list[row.min(self.rows - 1) * length..][..length]
    }
}

/// The network.
#[derive(Clone, Debug)]
pub struct BeliefNetwork {
    embedding: Layer,
    forwards: Lstm,
    backwards: Lstm,
    hidden: Layer,
    output: Layer,
}

impl BeliefNetwork {
    /// A network with the given number of hidden units in every layer.
    ///
    /// # Errors
    /// If a tensor cannot be allocated.
    pub fn new(units: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            embedding: Layer::new(FEATURES, units, random)?,
            forwards: Lstm::new(units, units, random)?,
            backwards: Lstm::new(units, units, random)?,
            hidden: Layer::new(2 * units, units, random)?,
            output: Layer::new(units, 1, random)?,
        })
    }

    /// The logarithms of the probabilities of rooms after every row, each events · [`BELIEFS`] × [`ROOMS`].
    fn log_probabilities(
        &self,
        events: &[&LabelledBeliefs],
        mut random: Option<&mut Pcg64Mcg>,
    ) -> Result<Vec<Tensor>> {
        let rows = events.iter().map(|event| event.rows).max().unwrap_or(0);
        let sequences = events.len() * SEQUENCES;
        let mut embedded = Vec::with_capacity(rows);
        for row in 0..rows {
            let of = |event: &&LabelledBeliefs| {
                event.of_row(&event.features.values, row, SEQUENCES * FEATURES).to_vec()
            };
            let inputs: Vec<f32> = events.iter().flat_map(of).collect();
            let inputs = Tensor::from_vec(inputs, (sequences, FEATURES), &Device::Cpu)?;
            let inputs = self.embedding.forward(&inputs)?.relu()?;
            embedded.push(dropout(&inputs, DROPOUT, random.as_deref_mut())?);
        }
        let active = |row: usize| -> Arc<[bool]> {
            events.iter().flat_map(|event| [row < event.rows; SEQUENCES]).collect()
        };
        let outputs = |memory: &Lstm, order: &mut dyn Iterator<Item = usize>| -> Result<Vec<Tensor>> {
            let mut state = memory.start(sequences)?;
            order
                .map(|row| {
                    state = memory.step(&embedded[row], &state, Some(active(row)))?;
                    memory.output(&state)
                })
                .collect()
        };
        let before = outputs(&self.forwards, &mut (0..rows))?;
        let after = outputs(&self.backwards, &mut (0..rows).rev())?;
        let both = before.iter().zip(after.iter().rev());
        both.map(|(before, after)| {
            let known = dropout(&Tensor::cat(&[before, after], 1)?, DROPOUT, random.as_deref_mut())?;
            let scores = self.output.forward(&self.hidden.forward(&known)?.relu()?)?;
            log_softmax(&scores.reshape((events.len() * BELIEFS, ROOMS))?, D::Minus1)
        })
        .collect()
    }

    /// The beliefs of the agents of an event after some of its steps.
    ///
    /// # Errors
    /// If a tensor cannot be allocated, or the event has fewer steps.
    pub fn beliefs(&self, event: &ObservedEvent, steps: &[usize]) -> Result<Vec<Beliefs>> {
        let event = LabelledBeliefs::unlabelled(event);
        let logs = self.log_probabilities(&[&event], None)?;
        let after = |&step: &usize| {
            let Some(logs) = logs.get(step) else { candle_core::bail!("there is no step {step}") };
            let logs: Vec<Vec<f32>> = logs.to_vec2()?;
            let place = |belief: usize| -> Whereabouts {
                if event.features.seen[step * BELIEFS + belief] {
                    return certain(SEEN);
                }
                let shares: Vec<f64> = logs[belief].iter().map(|&log| libm::exp(f64::from(log))).collect();
                let sum: f64 = shares.iter().sum();
                core::array::from_fn(|place| shares.get(place).map_or(0.0, |share| share / sum))
            };
            Ok(AgentId::ALL.map(|agent| (0..=event.objects).map(|k| place(index_of(agent, k))).collect()))
        };
        steps.iter().map(after).collect()
    }
}

impl Network for BeliefNetwork {
    type Sample = LabelledBeliefs;
    const NAME: &'static str = "belief-network";
    const METRICS: &'static [&'static str] = &["room"];

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.embedding.parameters("embedding");
        parameters.extend(self.forwards.parameters("forwards"));
        parameters.extend(self.backwards.parameters("backwards"));
        parameters.extend(self.hidden.parameters("hidden"));
        parameters.extend(self.output.parameters("output"));
        parameters
    }

    /// The cross-entropy of the beliefs about entities that are not seen, and the share of them whose
    /// likeliest room is right.
    fn loss(&self, events: &[&LabelledBeliefs], random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        let logs = self.log_probabilities(events, random)?;
        let mut loss = Tensor::zeros((), candle_core::DType::F32, &Device::Cpu)?;
        let (mut count, mut right) = (0, 0);
        for (row, logs) in logs.iter().enumerate() {
            let of = |event: &&LabelledBeliefs| match row < event.rows {
                true => event.of_row(&event.truth, row, SEQUENCES).to_vec(),
                false => vec![0.0; SEQUENCES],
            };
            let truths: Vec<f32> = events.iter().flat_map(of).collect();
            let said: Vec<Vec<f32>> = logs.detach().to_vec2()?;
            for (truth, said) in truths.chunks_exact(ROOMS).zip(&said) {
                if truth.iter().any(|&share| share > 0.0) {
                    count += 1;
                    right += usize::from(first_maximum(truth) == first_maximum(said));
                }
            }
            let truths = Tensor::from_vec(truths, logs.shape(), &Device::Cpu)?;
            loss = (loss - (logs * truths)?.sum_all()?)?;
        }
        let share = 1.0 / f64::from(u32::try_from(count).unwrap_or(u32::MAX).max(1));
        Ok(Loss { loss: (loss * share)?, scores: vec![right as f64 * share] })
    }
}

fn first_maximum(values: &[f32]) -> usize {
    (0..values.len()).fold(0, |best, k| if values[k] > values[best] { k } else { best })
}

impl PublishedNetwork for BeliefNetwork {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::BELIEF_NETWORK.weights;
    const BUNDLED_RECORD: &'static str = phase_data::BELIEF_NETWORK.record;

    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(UNITS, random)
    }
}
