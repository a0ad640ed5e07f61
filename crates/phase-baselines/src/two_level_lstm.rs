//! 2-Level LSTM, after Ibrahim et al. (2016) as adapted in the paper: first each node alone, then all
//! together.

use crate::{
    layer::Layer,
    lstm::Lstm,
    nodes::{Batch, GoalHead, NodeEmbedding, last_output, max_pool},
    parameters::Parameter,
    recognition::{self, LabelledEvent, Logits, RELATIONS, Recognition},
    training::{Loss, Metrics, Network, PublishedNetwork},
};
use candle_core::{Module, Result};
use phase_model::random::Pcg64Mcg;

/// Node embeddings; from an agent's, its goal; from the max-pool over all nodes at every step, through
/// another LSTM, the relation. Both are read after the last row.
#[derive(Clone, Debug)]
pub struct TwoLevelLstm {
    nodes: NodeEmbedding,
    goals: GoalHead,
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
            goals: GoalHead::new(hidden, random)?,
            context: Lstm::new(hidden, hidden, random)?,
            relation: Layer::new(hidden, RELATIONS.len(), random)?,
        })
    }
}

impl Recognition for TwoLevelLstm {
    fn logits(&self, batch: &Batch, _chance: Option<&mut Pcg64Mcg>) -> Result<Logits> {
        let embeddings = self.nodes.forward(batch)?;
        let padding_mask = batch.padding_mask.unsqueeze(2)?;
        let pooled = embeddings.iter().map(|embedding| max_pool(embedding, &padding_mask));
        let relations = self.relation.forward(&last_output(&self.context, batch, pooled)?)?;
        let Some(last) = embeddings.last() else { candle_core::bail!("there is no event to look at") };
        Ok(Logits { goals: self.goals.forward(last)?, relations })
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
