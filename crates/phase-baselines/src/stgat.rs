//! STGAT, after Huang et al. (2019): motion LSTM, graph attention at every step, graph LSTM and decoder.

use crate::{
    attention::attend,
    forecasting::{self, ForecastOrigin, Forecasting, HORIZON, places},
    layer::Layer,
    lstm::Lstm,
    nodes::{Batch, FEATURES, FixedEmbedding, MOVING, NODES, Nodes},
    parameters::Parameter,
    training::{Loss, Network, PublishedNetwork},
};
use candle_core::{Device, Module, Result, Tensor};
use phase_model::{arena::STEP_SECONDS, random::Pcg64Mcg};
use rand::seq::SliceRandom;

/// Moments of each event from which futures are unrolled in one training pass; all of them would take ten
/// times as long.
pub const TRAINING_ORIGINS: usize = 8;
/// Rows between two moments at which it is evaluated.
pub const STRIDE: usize = 5;
/// Negative slope of the leaky ReLU of scores before the softmax, as in graph attention networks.
const NEGATIVE_SLOPE: f64 = 0.2;
/// Velocity features are a tenth of those in u/s.
const SPEED: f64 = 10.0;

/// A motion LSTM for every moving node; at every step graph attention over all nodes (landmarks and walls
/// with an embedding); a graph LSTM over its output; and a decoder LSTM that starts from the states of both
/// and predicts ten steps, each from the one before. Without the noise of the original: a single future is
/// predicted.
#[derive(Clone, Debug)]
pub struct Stgat {
    features: Layer,
    motion: Lstm,
    fixed: FixedEmbedding,
    heads: Vec<Head>,
    graph: Lstm,
    step: Layer,
    decoder: Lstm,
    displacement: Layer,
    hidden: usize,
}

/// One attention head.
#[derive(Clone, Debug)]
struct Head {
    /// Projection from a node's features to its value.
    taken: Layer,
    /// From that to its scores as source and as target of attention.
    scores: Layer,
}

impl Stgat {
    /// A network with the given number of hidden units in every layer, a multiple of the number of attention
    /// heads.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, heads: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        let features = Layer::new(FEATURES, hidden, random)?;
        let motion = Lstm::new(hidden, hidden, random)?;
        let fixed = FixedEmbedding::new(hidden, random)?;
        let width = hidden / heads.max(1);
        let heads = (0..heads).map(|_| {
            Ok(Head { taken: Layer::new(hidden, width, random)?, scores: Layer::new(width, 2, random)? })
        });
        Ok(Self {
            features,
            motion,
            fixed,
            heads: heads.collect::<Result<_>>()?,
            graph: Lstm::new(hidden, hidden, random)?,
            step: Layer::new(2, hidden, random)?,
            decoder: Lstm::new(hidden, 2 * hidden, random)?,
            displacement: Layer::new(2 * hidden, 2, random)?,
            hidden,
        })
    }

    /// The moving nodes after attending to all nodes: (events · [`MOVING`]) × hidden.
    fn look(&self, nodes: &Tensor, mask: &Tensor) -> Result<Tensor> {
        let mut seen = Vec::with_capacity(self.heads.len());
        for Head { taken, scores } in &self.heads {
            let taken = taken.forward(nodes)?;
            let scores = scores.forward(&taken)?;
            let looking = scores.narrow(2, 0, 1)?.narrow(1, 0, MOVING)?;
            let looked_at = scores.narrow(2, 1, 1)?.transpose(1, 2)?;
            let scores = looking.broadcast_add(&looked_at)?;
            // max(x, LEAK · x)
            let scores = (scores.relu()? * (1.0 - NEGATIVE_SLOPE))?.add(&(scores * NEGATIVE_SLOPE)?)?;
            seen.push(attend(&scores, mask, &taken)?.elu(1.0)?);
        }
        let seen = Tensor::cat(&seen, 2)?;
        seen.reshape((seen.dim(0)? * MOVING, seen.dim(2)?))
    }

    /// Hidden states of motion and graph LSTM after each row: (events · [`MOVING`]) × 2·hidden.
    fn encoded(&self, batch: &Batch) -> Result<Vec<Tensor>> {
        let events = batch.events();
        let hidden = self.hidden;
        let fixed = self.fixed.forward(batch)?;
        let present = (0..events).flat_map(|event| batch.attention_bias(event));
        let mask = Tensor::from_iter(present, &Device::Cpu)?.reshape((events, 1, NODES))?;
        let mut motion = self.motion.start(events * MOVING)?;
        let mut graph = self.graph.start(events * MOVING)?;
        let mut encoded = Vec::with_capacity(batch.moving.len());
        for (row, features) in batch.moving.iter().enumerate() {
            let features = self.features.forward(features)?.relu()?;
            motion = self.motion.step(&features, &motion, batch.active(row, MOVING))?;
            let moved = self.motion.output(&motion)?;
            let nodes = Tensor::cat(&[moved.reshape((events, MOVING, hidden))?, fixed.clone()], 1)?;
            graph = self.graph.step(&self.look(&nodes, &mask)?, &graph, batch.active(row, MOVING))?;
            encoded.push(Tensor::cat(&[moved, self.graph.output(&graph)?], 1)?);
        }
        Ok(encoded)
    }
}

impl Forecasting for Stgat {
    fn displacements(&self, batch: &Batch, origins: &[ForecastOrigin]) -> Result<Tensor> {
        let places = places(batch, origins)?;
        let known = Tensor::cat(&self.encoded(batch)?, 0)?.index_select(&places, 0)?;
        let velocity = Tensor::cat(&batch.moving, 0)?.index_select(&places, 0)?.narrow(1, FEATURES - 2, 2)?;
        // Displacement in the last step (u).
        let mut covered = (velocity * (SPEED * STEP_SECONDS))?;
        let mut state = Tensor::cat(&[&known, &known.zeros_like()?], 1)?;
        let mut position = covered.zeros_like()?;
        let mut positions = Vec::with_capacity(HORIZON);
        for _ in 0..HORIZON {
            state = self.decoder.step(&self.step.forward(&covered)?.relu()?, &state, None)?;
            covered = self.displacement.forward(&self.decoder.output(&state)?)?;
            position = (position + &covered)?;
            positions.push(position.clone());
        }
        Tensor::stack(&positions, 1)
    }

    fn origins(&self, batch: &Batch, random: Option<&mut Pcg64Mcg>) -> Vec<ForecastOrigin> {
        let each = batch.lengths().iter().enumerate();
        let Some(random) = random else {
            let rows = |length: usize| (0..length.saturating_sub(1)).step_by(STRIDE);
            return each
                .flat_map(|(event, &length)| rows(length).map(move |row| ForecastOrigin { event, row }))
                .collect();
        };
        let mut origins = Vec::new();
        for (event, &length) in each {
            let mut rows: Vec<usize> = (0..length.saturating_sub(1)).collect();
            rows.shuffle(random);
            origins.extend(rows.into_iter().take(TRAINING_ORIGINS).map(|row| ForecastOrigin { event, row }));
        }
        origins
    }
}

impl Network for Stgat {
    type Sample = Nodes;
    const NAME: &'static str = "stgat";
    const METRICS: &'static [&'static str] = &forecasting::METRICS;

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.features.parameters("features");
        parameters.extend(self.motion.parameters("motion"));
        parameters.extend(self.fixed.parameters("fixed"));
        for (k, head) in self.heads.iter().enumerate() {
            parameters.extend(head.taken.parameters(&format!("head.{k}.taken")));
            parameters.extend(head.scores.parameters(&format!("head.{k}.scores")));
        }
        parameters.extend(self.graph.parameters("graph"));
        parameters.extend(self.step.parameters("step"));
        parameters.extend(self.decoder.parameters("decoder"));
        parameters.extend(self.displacement.parameters("displacement"));
        parameters
    }

    fn loss(&self, events: &[&Nodes], random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        forecasting::loss(self, events, random)
    }
}

impl PublishedNetwork for Stgat {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::STGAT.weights;
    const BUNDLED_RECORD: &'static str = phase_data::STGAT.record;

    /// The paper does not give the numbers of hidden units and heads; hidden units are as many as in the
    /// other networks.
    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(64, 4, random)
    }
}
