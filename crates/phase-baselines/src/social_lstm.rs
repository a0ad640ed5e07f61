//! Social-LSTM, after Alahi et al. (2016): an LSTM for each moving node, which pools the hidden states of its
//! neighbours.

use crate::{
    forecasting::{self, ForecastOrigin, Forecasting, HORIZON, places},
    layer::Layer,
    lstm::Lstm,
    nodes::{Batch, FEATURES, FixedEmbedding, MOVING, NODES, Nodes},
    parameters::Parameter,
    training::{Loss, Network, PublishedNetwork},
};
use candle_core::{Device, Module, Result, Tensor};
use phase_model::{Vec2, random::Pcg64Mcg};

/// Cells along each side of the grid around an agent or object.
pub const CELLS: usize = 4;
/// Side of a cell (u).
pub const CELL: f32 = 4.0;

/// Every moving node has an LSTM; its input is the node's features and a social-pooling grid that sums, for
/// each cell, the neighbours' hidden states of the previous step. Landmarks and walls, which have no LSTM,
/// enter the grid with an embedding. After every step a linear layer predicts the next ten positions from the
/// hidden state.
#[derive(Clone, Debug)]
pub struct SocialLstm {
    features: Layer,
    fixed: FixedEmbedding,
    neighbours: Layer,
    memory: Lstm,
    displacement: Layer,
    hidden: usize,
}

impl SocialLstm {
    /// A network with the given number of hidden units in every layer.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            features: Layer::new(FEATURES, hidden, random)?,
            fixed: FixedEmbedding::new(hidden, random)?,
            neighbours: Layer::new(CELLS * CELLS * hidden, hidden, random)?,
            memory: Lstm::new(2 * hidden, hidden, random)?,
            displacement: Layer::new(hidden, 2 * HORIZON, random)?,
            hidden,
        })
    }
}

impl Forecasting for SocialLstm {
    fn displacements(&self, batch: &Batch, origins: &[ForecastOrigin]) -> Result<Tensor> {
        let events = batch.events();
        let hidden = self.hidden;
        let fixed = self.fixed.forward(batch)?;
        let mut state = self.memory.start(events * MOVING)?;
        let mut outputs = Vec::with_capacity(batch.moving.len());
        for (row, features) in batch.moving.iter().enumerate() {
            let moving = self.memory.output(&state)?.reshape((events, MOVING, hidden))?;
            let pooled = grids(batch, row)?.matmul(&Tensor::cat(&[moving, fixed.clone()], 1)?)?;
            let pooled = pooled.reshape((events * MOVING, CELLS * CELLS * hidden))?;
            let neighbours = self.neighbours.forward(&pooled)?.relu()?;
            let features = self.features.forward(features)?.relu()?;
            let input = Tensor::cat(&[features, neighbours], 1)?;
            state = self.memory.step(&input, &state, batch.active(row, MOVING))?;
            outputs.push(self.memory.output(&state)?);
        }
        let chosen = Tensor::cat(&outputs, 0)?.index_select(&places(batch, origins)?, 0)?;
        self.displacement.forward(&chosen)?.reshape((origins.len() * MOVING, HORIZON, 2))
    }
}

impl Network for SocialLstm {
    type Sample = Nodes;
    const NAME: &'static str = "social-lstm";
    const METRICS: &'static [&'static str] = &forecasting::METRICS;

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.features.parameters("features");
        parameters.extend(self.fixed.parameters("fixed"));
        parameters.extend(self.neighbours.parameters("neighbours"));
        parameters.extend(self.displacement.parameters("displacement"));
        parameters.extend(self.memory.parameters("memory"));
        parameters
    }

    fn loss(&self, events: &[&Nodes], random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        forecasting::loss(self, events, random)
    }
}

impl PublishedNetwork for SocialLstm {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::SOCIAL_LSTM.weights;
    const BUNDLED_RECORD: &'static str = phase_data::SOCIAL_LSTM.record;

    /// The paper does not give the number of hidden units; it is that of the other networks.
    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(64, random)
    }
}

/// The occupation of the cells around each moving node, 0 or 1: events × ([`MOVING`] · cells) × [`NODES`].
fn grids(batch: &Batch, row: usize) -> Result<Tensor> {
    let shape = (batch.events(), MOVING * CELLS * CELLS, NODES);
    let mut grids = vec![0.0_f32; shape.0 * shape.1 * shape.2];
    for event in 0..batch.events() {
        for node in 0..MOVING {
            let Some(centre) = batch.position(event, node, row) else { continue };
            for other in (0..NODES).filter(|&other| other != node) {
                let position = batch.position(event, other, row);
                if let Some(cell) = position.and_then(|position| cell_of(position - centre)) {
                    let place = (event * MOVING + node) * CELLS * CELLS + cell;
                    grids[place * NODES + other] = 1.0;
                }
            }
        }
    }
    Tensor::from_vec(grids, shape, &Device::Cpu)
}

/// The cell that a neighbour is in, `None` outside the grid.
fn cell_of(offset: Vec2) -> Option<usize> {
    let cell = offset / CELL + (CELLS / 2) as f32;
    let inside = |number: f32| number >= 0.0 && number < CELLS as f32;
    (inside(cell.x) && inside(cell.y)).then(|| cell.y as usize * CELLS + cell.x as usize)
}
