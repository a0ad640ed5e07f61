//! SocialGNN, after Malik and Isik (2023): at every row a graph of agents and objects whose edges are
//! contacts, then an LSTM over rows. It recognises the relation and says nothing about goals.

use crate::{
    layer::Layer,
    lstm::Lstm,
    nodes::{Batch, LENGTH, MOVING, Nodes, SPEED, WALLS, last_output},
    parameters::Parameter,
    recognition::{self, LabelledEvent, RELATIONS, log_likelihoods, relation_probabilities},
    training::{Loss, Metrics, Network, PublishedNetwork, TrainingSettings},
};
use candle_core::{D, DType, Device, Module, Result, Tensor};
use candle_nn::ops::log_softmax;
use phase_event::ObservedEvent;
use phase_model::{RelationProbabilities, arena, random::Pcg64Mcg};

/// Settings of its training: batches of 20 events, as published; the rest as the other networks of Task 1.
pub const SETTINGS: TrainingSettings = TrainingSettings { batch: 20, ..recognition::SETTINGS };

/// Weights of the relations in the loss, in the order of [`RELATIONS`]: neutral events are half as many.
const CLASS_WEIGHTS: [f32; RELATIONS.len()] = [1.0, 1.0, 2.0];
/// λ: half of it times the sum of all squared weights is added to the loss.
const WEIGHT_DECAY: f64 = 0.05;
/// Features of a node: whether it is an agent, half its length, position (2), direction it faces (2),
/// velocity (2). Colours are left out, since nodes are told apart by their places.
const NODE_FEATURES: usize = 8;
/// The place at which those from half its length on begin among the [`FEATURES`](crate::nodes::FEATURES) of a
/// node.
const FIRST_MEASURE: usize = 8;
/// Their units in those of the other networks. They are lengths in u and velocities in u/s, as published:
/// with the others' units, in which they are below 1, the penalty on weights would keep the network from
/// learning.
const UNITS: [f32; NODE_FEATURES] = [1.0, LENGTH, LENGTH, LENGTH, 1.0, 1.0, SPEED, SPEED];
/// Features of the scene: both ends of every inner wall. Landmarks are left out, since they are always the
/// same.
const SCENE_FEATURES: usize = 4 * WALLS;

/// The published variant with node updates, SocialGNN-V. An edge is a linear function of the nodes at its
/// ends; a node is updated by one of the sum of the edges that it receives, of its own features and of those
/// of the scene; the four updated nodes side by side are the input of an LSTM, from whose last output one
/// layer tells the relation.
#[derive(Clone, Debug)]
pub struct SocialGnn {
    /// The edge's layer in two parts, one for each end: the sum over edges is then a product of matrices.
    sender: Layer,
    receiver: Layer,
    node: Layer,
    memory: Lstm,
    relation: Layer,
}

impl SocialGnn {
    /// A network with the given numbers of units in edges and nodes, and in the LSTM.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(spatial: usize, temporal: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            sender: Layer::new(NODE_FEATURES, spatial, random)?,
            receiver: Layer::new(NODE_FEATURES, spatial, random)?,
            node: Layer::new(spatial + NODE_FEATURES + SCENE_FEATURES, spatial, random)?,
            memory: Lstm::new(MOVING * spatial, temporal, random)?,
            relation: Layer::new(temporal, RELATIONS.len(), random)?,
        })
    }

    /// The logits of the relations, events × 3 in the order of [`RELATIONS`].
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn logits(&self, batch: &Batch) -> Result<Tensor> {
        let graphs = self.graphs(batch)?;
        let rows = (0..graphs.dim(0)?).map(|row| graphs.get(row));
        self.relation.forward(&last_output(&self.memory, batch, rows)?)
    }

    /// The probabilities of the relations in an event.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn judge(&self, event: &ObservedEvent) -> Result<RelationProbabilities> {
        let nodes = Nodes::of(event);
        relation_probabilities(&log_softmax(&self.logits(&Batch::new(&[&nodes])?)?, D::Minus1)?)
    }

    /// The updated nodes of every row: rows × events × 4·units, zero for absent nodes.
    fn graphs(&self, batch: &Batch) -> Result<Tensor> {
        let rows = batch.moving.len();
        let events = batch.events();
        let all = Tensor::cat(&batch.moving, 0)?;
        let inputs = Tensor::cat(
            &[all.narrow(1, 0, 1)?, all.narrow(1, FIRST_MEASURE, NODE_FEATURES - 1)?],
            D::Minus1,
        )?;
        let inputs = inputs.broadcast_mul(&Tensor::new(&UNITS, &Device::Cpu)?)?;
        let graphs = rows * events;
        let by_graph = |values: &Tensor| values.reshape((graphs, MOVING, ()));
        let contacts = contacts(batch)?;
        let sent = contacts.matmul(&by_graph(&self.sender.forward(&inputs)?)?)?;
        let received =
            by_graph(&self.receiver.forward(&inputs)?)?.broadcast_mul(&contacts.sum_keepdim(D::Minus1)?)?;
        let scenes = scenes(batch)?.broadcast_as((rows, events, MOVING, SCENE_FEATURES))?;
        let scenes = scenes.reshape((graphs, MOVING, SCENE_FEATURES))?;
        let edges = (sent + received)?;
        let nodes = self.node.forward(&Tensor::cat(&[edges, by_graph(&inputs)?, scenes], D::Minus1)?)?;
        let nodes = nodes.reshape((rows, events, MOVING, ()))?;
        nodes.broadcast_mul(&presence(batch)?)?.reshape((rows, events, ()))
    }

    /// Half the sum of all squared weights.
    fn squared_weights(&self) -> Result<Tensor> {
        let mut sum = Tensor::zeros((), DType::F32, &Device::Cpu)?;
        for (_, variable) in self.parameters() {
            sum = (sum + variable.sqr()?.sum_all()?)?;
        }
        sum / 2.0
    }
}

/// 1 where two moving nodes are in contact: (rows · events) × receiver × sender.
fn contacts(batch: &Batch) -> Result<Tensor> {
    let rows = batch.moving.len();
    let events = batch.events();
    let mut values = Vec::with_capacity(rows * events * MOVING * MOVING);
    for row in 0..rows {
        for event in 0..events {
            let matrix = batch.contacts(event, row).copied().unwrap_or_default();
            values.extend(matrix.as_flattened().iter().map(|&contact| f32::from(u8::from(contact))));
        }
    }
    Tensor::from_vec(values, (rows * events, MOVING, MOVING), &Device::Cpu)
}

/// The ends of the inner walls (u from the arena's centre): events × 1 × 16, zero for absent walls.
fn scenes(batch: &Batch) -> Result<Tensor> {
    let mut values = Vec::with_capacity(batch.events() * SCENE_FEATURES);
    for event in 0..batch.events() {
        for wall in 0..WALLS {
            let wall = batch.walls(event).get(wall);
            values.extend(wall.map_or([0.0; 4], |wall| {
                let a = wall.a - arena::CENTRE;
                let b = wall.b - arena::CENTRE;
                [a.x, a.y, b.x, b.y]
            }));
        }
    }
    Tensor::from_vec(values, (batch.events(), 1, SCENE_FEATURES), &Device::Cpu)
}

/// 1 for present moving nodes: events × 4 × 1.
fn presence(batch: &Batch) -> Result<Tensor> {
    let values = (0..batch.events())
        .flat_map(|event| (0..MOVING).map(move |node| f32::from(u8::from(batch.has(event, node)))));
    Tensor::from_iter(values, &Device::Cpu)?.reshape((batch.events(), MOVING, 1))
}

impl Network for SocialGnn {
    type Sample = LabelledEvent;
    const NAME: &'static str = "socialgnn";
    const METRICS: &'static [&'static str] = &["relation"];

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = self.sender.parameters("sender");
        parameters.extend(self.receiver.parameters("receiver"));
        parameters.extend(self.node.parameters("node"));
        parameters.extend(self.memory.parameters("memory"));
        parameters.extend(self.relation.parameters("relation"));
        parameters
    }

    fn loss(&self, events: &[&LabelledEvent], _random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        let nodes: Vec<&Nodes> = events.iter().map(|event| &event.nodes).collect();
        let logs = log_softmax(&self.logits(&Batch::new(&nodes)?)?, D::Minus1)?;
        let right: Vec<u32> = events.iter().map(|event| event.relation).collect();
        let weights = right.iter().map(|&k| CLASS_WEIGHTS.get(k as usize).copied().unwrap_or(1.0));
        let weights = Tensor::from_iter(weights, &Device::Cpu)?.reshape((events.len(), 1))?;
        let (likelihoods, accuracy) = log_likelihoods(&logs, right)?;
        let error = (likelihoods * weights)?.mean_all()?.neg()?;
        Ok(Loss { loss: (error + (self.squared_weights()? * WEIGHT_DECAY)?)?, scores: vec![accuracy] })
    }

    fn selection_loss(evaluate: &Metrics) -> f64 {
        recognition::selection_loss(evaluate)
    }
}

impl PublishedNetwork for SocialGnn {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::SOCIAL_GNN.weights;
    const BUNDLED_RECORD: &'static str = phase_data::SOCIAL_GNN.record;

    /// 64 units in edges and nodes and 16 in the LSTM, as published.
    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Self::new(64, 16, random)
    }
}
