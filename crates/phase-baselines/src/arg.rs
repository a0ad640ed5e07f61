//! ARG, after Wu et al. (2019): an actor relation graph over all nodes of a few frames.

use crate::{
    attention::attend,
    goals::CLASSES,
    layer::Layer,
    nodes::{Batch, GoalHead, NODES, NodeEmbedding, max_pool},
    parameters::Parameter,
    perceptron::Perceptron,
    recognition::{self, LabelledEvent, Logits, RELATIONS, Recognition},
    training::{Loss, Metrics, Network, PublishedNetwork},
};
use candle_core::{D, Device, Module, Result, Tensor};
use phase_model::{AGENT_COUNT, random::Pcg64Mcg};
use rand::seq::SliceRandom;

/// Frames in a graph.
pub const FRAMES: usize = 10;
/// Rows between consecutive windows of frames when the whole event is used.
pub const STRIDE: usize = 5;

/// Node embeddings of ten frames, related to each other by dot-product attention with a residual connection.
/// Goals come from the agent nodes, the relation from a max-pool over all nodes, both for every frame; logits
/// are averaged over frames and over windows.
#[derive(Clone, Debug)]
pub struct Arg {
    nodes: NodeEmbedding,
    graphs: Vec<Graph>,
    goals: GoalHead,
    relation: Perceptron,
}

/// One relation graph: query, key and value projections.
#[derive(Clone, Debug)]
struct Graph {
    from: Layer,
    to: Layer,
    taken: Layer,
}

/// The frames of one graph: rows of one event.
struct Window {
    event: usize,
    rows: [usize; FRAMES],
}

impl Arg {
    /// A network with the given number of hidden units and of relation graphs over the same nodes.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(hidden: usize, graphs: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        let nodes = NodeEmbedding::new(hidden, random)?;
        let mut layer = || Layer::new(hidden, hidden, random);
        let graphs = (0..graphs).map(|_| Ok(Graph { from: layer()?, to: layer()?, taken: layer()? }));
        Ok(Self {
            nodes,
            graphs: graphs.collect::<Result<_>>()?,
            goals: GoalHead::new(hidden, random)?,
            relation: Perceptron::head(hidden, RELATIONS.len(), random)?,
        })
    }

    /// The logits for each event from [`FRAMES`] of its rows, in any order: frames are distinguished only by
    /// the node embeddings of the LSTM.
    ///
    /// # Errors
    /// If there are not that many events in the batch, or an event has no such row.
    pub fn logits_at(&self, batch: &Batch, rows: &[[usize; FRAMES]]) -> Result<Logits> {
        let windows = rows.iter().enumerate().map(|(event, rows)| Window { event, rows: *rows });
        self.look(batch, &self.nodes.forward(batch)?, &windows.collect::<Vec<_>>())
    }

    /// The logits for windows: windows × 2 × [`CLASSES`] and windows × 3.
    fn look(&self, batch: &Batch, embeddings: &[Tensor], windows: &[Window]) -> Result<Logits> {
        let events = batch.events();
        let count = windows.len();
        let rows =
            windows.iter().flat_map(|window| window.rows.iter().map(|row| row * events + window.event));
        let rows = Tensor::from_iter(rows.map(|row| row as u32), &Device::Cpu)?;
        let all = Tensor::cat(embeddings, 0)?;
        let hidden = all.dim(D::Minus1)?;
        let nodes = all.index_select(&rows, 0)?.reshape((count, FRAMES * NODES, hidden))?;
        let present =
            windows.iter().flat_map(|window| (0..FRAMES).flat_map(|_| batch.attention_bias(window.event)));
        let mask = Tensor::from_iter(present, &Device::Cpu)?.reshape((count, 1, FRAMES * NODES))?;
        let mut related = nodes.clone();
        for Graph { from, to, taken } in &self.graphs {
            let scores = from.forward(&nodes)?.matmul(&to.forward(&nodes)?.t()?)?;
            let scores = (scores / (hidden as f64).sqrt())?;
            related = (related + attend(&scores, &mask, &taken.forward(&nodes)?)?.relu()?)?;
        }
        let frames = related.reshape((count * FRAMES, NODES, hidden))?;
        let goals = self.goals.forward(&frames)?.reshape((count, FRAMES, AGENT_COUNT * CLASSES))?;
        let mask = mask.reshape((count * FRAMES, NODES, 1))?;
        let relations =
            self.relation.forward(&max_pool(&frames, &mask)?)?.reshape((count, FRAMES, RELATIONS.len()))?;
        Ok(Logits {
            goals: goals.mean(1)?.reshape((count, AGENT_COUNT, CLASSES))?,
            relations: relations.mean(1)?,
        })
    }
}

impl Recognition for Arg {
    fn logits(&self, batch: &Batch, random: Option<&mut Pcg64Mcg>) -> Result<Logits> {
        let lengths = batch.lengths();
        if let Some(random) = random {
            let rows: Vec<_> = lengths.iter().map(|&length| sample_rows(length, random)).collect();
            return self.logits_at(batch, &rows);
        }
        let embeddings = self.nodes.forward(batch)?;
        let sliding_windows: Vec<Vec<[usize; FRAMES]>> =
            lengths.iter().map(|&length| sliding_windows(length).collect()).collect();
        let each = sliding_windows.iter().enumerate();
        let windows: Vec<Window> =
            each.flat_map(|(event, all)| all.iter().map(move |&rows| Window { event, rows })).collect();
        // Each event's mean over its windows, as a matrix.
        let means = sliding_windows.iter().enumerate().flat_map(|(event, all)| {
            let share = 1.0 / all.len() as f32;
            windows.iter().map(move |window| if window.event == event { share } else { 0.0 })
        });
        let means = Tensor::from_iter(means, &Device::Cpu)?.reshape((batch.events(), windows.len()))?;
        let Logits { goals, relations } = self.look(batch, &embeddings, &windows)?;
        let goals = means.matmul(&goals.reshape((windows.len(), AGENT_COUNT * CLASSES))?)?;
        Ok(Logits {
            goals: goals.reshape((batch.events(), AGENT_COUNT, CLASSES))?,
            relations: means.matmul(&relations)?,
        })
    }
}

impl Network for Arg {
    type Sample = LabelledEvent;
    const NAME: &'static str = "arg";
    const METRICS: &'static [&'static str] = &recognition::METRICS;

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.nodes.parameters("nodes");
        for (k, graph) in self.graphs.iter().enumerate() {
            parameters.extend(graph.from.parameters(&format!("graph.{k}.from")));
            parameters.extend(graph.to.parameters(&format!("graph.{k}.to")));
            parameters.extend(graph.taken.parameters(&format!("graph.{k}.taken")));
        }
        parameters.extend(self.goals.parameters("goals"));
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

impl PublishedNetwork for Arg {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::ARG.weights;
    const BUNDLED_RECORD: &'static str = phase_data::ARG.record;

    /// The paper does not give the number of graphs; four are used here.
    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(64, 4, random)
    }
}

/// Ten rows of an event at random; of one that is shorter, all, some of them more than once.
fn sample_rows(length: usize, random: &mut Pcg64Mcg) -> [usize; FRAMES] {
    let mut rows: Vec<usize> = (0..length).collect();
    if length >= FRAMES {
        rows.shuffle(random);
    }
    core::array::from_fn(|k| rows[k % length])
}

/// Windows of ten rows through an event, the last of them at its end.
fn sliding_windows(length: usize) -> impl Iterator<Item = [usize; FRAMES]> {
    let last = length.saturating_sub(FRAMES);
    let starts = (0..last).step_by(STRIDE).chain([last]);
    starts.map(move |start| core::array::from_fn(|k| start + k % (length - start)))
}
