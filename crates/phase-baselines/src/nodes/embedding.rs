//! Node embeddings: a fully connected layer, then an LSTM.

use super::{Batch, FEATURES, FIXED, MOVING};
use crate::{layer::Layer, lstm::Lstm, parameters::Parameter};
use candle_core::{Module, Result, Tensor};
use phase_model::random::Pcg64Mcg;

/// The node embedding of the 2-Level LSTM and of ARG, one for nodes of all types.
#[derive(Clone, Debug)]
pub struct NodeEmbedding {
    features: Layer,
    memory: Lstm,
}

impl NodeEmbedding {
    /// With the given number of hidden units.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            features: Layer::new(FEATURES, hidden, random)?,
            memory: Lstm::new(hidden, hidden, random)?,
        })
    }

    /// The embeddings of all nodes after each row: events × [`NODES`](super::NODES) × hidden. Past an event's
    /// end moving nodes keep their last ones.
    ///
    /// A landmark or wall is the same throughout an event and in all events that contain it, so each is
    /// processed once.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn forward(&self, batch: &Batch) -> Result<Vec<Tensor>> {
        let events = batch.events();
        let by_event = |values: &Tensor, each: usize| values.reshape((events, each, ()));
        let fixed_features = self.features.forward(&batch.fixed)?.relu()?;
        let mut fixed = self.memory.start(batch.fixed.dim(0)?)?;
        let mut moving = self.memory.start(events * MOVING)?;
        let mut embeddings = Vec::with_capacity(batch.moving.len());
        for (row, features) in batch.moving.iter().enumerate() {
            fixed = self.memory.step(&fixed_features, &fixed, None)?;
            let features = self.features.forward(features)?.relu()?;
            moving = self.memory.step(&features, &moving, batch.active(row, MOVING))?;
            let placed = self.memory.output(&fixed)?.index_select(&batch.fixed_places, 0)?;
            let moved = self.memory.output(&moving)?;
            embeddings.push(Tensor::cat(&[by_event(&moved, MOVING)?, by_event(&placed, FIXED)?], 1)?);
        }
        Ok(embeddings)
    }

    /// Trainable parameters with their names.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        let mut parameters = self.features.parameters(&format!("{name}.features"));
        parameters.extend(self.memory.parameters(&format!("{name}.memory")));
        parameters
    }
}
