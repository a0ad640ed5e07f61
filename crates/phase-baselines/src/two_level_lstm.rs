//! 2-Level LSTM, after Ibrahim et al. (2016) as adapted in the paper: first each node alone, then all
//! together.

use crate::{
    goals::CLASSES,
    layer::Layer,
    lstm::Lstm,
    nodes::{Batch, NodeEmbedding},
    parameters::Parameter,
    perceptron::Perceptron,
    recognition::{self, LabelledEvent, Logits, RELATIONS, Recognition},
    training::{Loss, Metrics, Network, PublishedNetwork},
};
use candle_core::{D, Module, Result};
use phase_model::{AGENT_COUNT, random::Pcg64Mcg};

/// Node embeddings; from an agent's, its goal; from the max-pool over all nodes at every step, through
/// another LSTM, the relation. Both are read after the last row.
#[derive(Clone, Debug)]
pub struct TwoLevelLstm {
    nodes: NodeEmbedding,
    goals: Perceptron,
    context: Lstm,
    relation: Layer,
}

impl TwoLevelLstm {
    /// A network with the given number of hidden units in every layer.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            nodes: NodeEmbedding::new(hidden, random)?,
            goals: Perceptron::head(hidden, CLASSES, random)?,
            context: Lstm::new(hidden, hidden, random)?,
            relation: Layer::new(hidden, RELATIONS.len(), random)?,
        })
    }
}

impl Recognition for TwoLevelLstm {
    fn logits(&self, batch: &Batch, _chance: Option<&mut Pcg64Mcg>) -> Result<Logits> {
        let embeddings = self.nodes.forward(batch)?;
        let padding_mask = batch.padding_mask.unsqueeze(2)?;
        let mut context = self.context.start(batch.events())?;
        for (row, embedding) in embeddings.iter().enumerate() {
            let pooled = embedding.broadcast_add(&padding_mask)?.max(1)?;
            context = self.context.step(&pooled, &context, batch.active(row, 1))?;
        }
        let relations = self.relation.forward(&self.context.output(&context)?)?;
        let Some(last) = embeddings.last() else { candle_core::bail!("there is no event to look at") };
        let agents = last.narrow(1, 0, AGENT_COUNT)?;
        let hidden = agents.dim(D::Minus1)?;
        let goals = self.goals.forward(&agents.reshape(((), hidden))?)?;
        Ok(Logits { goals: goals.reshape((batch.events(), AGENT_COUNT, CLASSES))?, relations })
    }
}

impl Network for TwoLevelLstm {
    type Sample = LabelledEvent;
    const NAME: &'static str = "two-level-lstm";
    const METRICS: &'static [&'static str] = &recognition::METRICS;

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.nodes.parameters("nodes");
        parameters.extend(self.goals.parameters("goals"));
        parameters.extend(self.context.parameters("context"));
        parameters.extend(self.relation.parameters("relation"));
        parameters
    }

    fn loss(&self, events: &[&LabelledEvent], random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        recognition::loss(self, events, random)
    }

    fn selection_loss(evaluate: &Metrics) -> f64 {
        recognition::selection_loss(evaluate)
    }
}

impl PublishedNetwork for TwoLevelLstm {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::TWO_LEVEL_LSTM.weights;
    const BUNDLED_RECORD: &'static str = phase_data::TWO_LEVEL_LSTM.record;

    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(64, random)
    }
}
