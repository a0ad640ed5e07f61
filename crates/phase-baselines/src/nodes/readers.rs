//! Readers of the nodes of a batch that several networks share.

use super::{Batch, FEATURES, FIXED, NODES};
use crate::{
    attention::MASK_BIAS, goals::CLASSES, layer::Layer, lstm::Lstm, parameters::Parameter,
    perceptron::Perceptron,
};
use candle_core::{D, Module, Result, Tensor};
use phase_model::{AGENT_COUNT, random::Pcg64Mcg};

/// The embedding of landmarks and walls, which do not move and have no LSTM.
#[derive(Clone, Debug)]
pub struct FixedEmbedding {
    layer: Layer,
}

impl FixedEmbedding {
    /// With the given number of hidden units.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self { layer: Layer::new(FEATURES, hidden, random)? })
    }

    /// events × [`FIXED`] × hidden, between −1 and 1 as the outputs of LSTMs.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn forward(&self, batch: &Batch) -> Result<Tensor> {
        let fixed = self.layer.forward(&batch.fixed)?.tanh()?.index_select(&batch.fixed_places, 0)?;
        fixed.reshape((batch.events(), FIXED, ()))
    }

    /// Trainable parameters with their names.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        self.layer.parameters(name)
    }
}

/// The head of the networks for Task 1 that tells an agent's goal from its own node.
#[derive(Clone, Debug)]
pub struct GoalHead {
    perceptron: Perceptron,
}

impl GoalHead {
    /// With the given number of hidden units.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self { perceptron: Perceptron::head(hidden, CLASSES, random)? })
    }

    /// The logits of both agents' goals from graphs × [`NODES`] × hidden: graphs × 2 × [`CLASSES`].
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn forward(&self, nodes: &Tensor) -> Result<Tensor> {
        let agents = nodes.narrow(1, 0, AGENT_COUNT)?;
        let hidden = agents.dim(D::Minus1)?;
        let goals = self.perceptron.forward(&agents.reshape(((), hidden))?)?;
        goals.reshape((nodes.dim(0)?, AGENT_COUNT, CLASSES))
    }

    /// Trainable parameters with their names.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        self.perceptron.parameters(name)
    }
}

impl Batch {
    /// The terms that are added to the scores of an event's nodes before attention, in order.
    pub(crate) fn attention_bias(&self, event: usize) -> impl Iterator<Item = f32> {
        (0..NODES).map(move |node| if self.has(event, node) { 0.0 } else { MASK_BIAS })
    }
}

/// The maximum over the present nodes of each graph: graphs × hidden, from graphs × [`NODES`] × hidden and a
/// mask of graphs × [`NODES`] × 1.
pub(crate) fn max_pool(nodes: &Tensor, mask: &Tensor) -> Result<Tensor> {
    nodes.broadcast_add(mask)?.max(1)
}

/// The output of an LSTM after the last row of each event, from its inputs row by row: events × hidden.
pub(crate) fn last_output(
    memory: &Lstm,
    batch: &Batch,
    rows: impl Iterator<Item = Result<Tensor>>,
) -> Result<Tensor> {
    let mut state = memory.start(batch.events())?;
    for (row, input) in rows.enumerate() {
        state = memory.step(&input?, &state, batch.active(row, 1))?;
    }
    memory.output(&state)
}
