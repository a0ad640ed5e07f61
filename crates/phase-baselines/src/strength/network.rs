//! The network during training, and its conversion to weights.

use super::Sample;
use crate::layer::Layer;
use candle_core::{Device, Module, Result, Tensor, Var};
use phase_model::random::Pcg64Mcg;
use phase_simple::strength::{FEATURES, Weights};
use phase_statistics::{mean, population_variance};
use phase_tensors::Dense;

/// Standardises values to mean 0 and standard deviation 1, and back.
#[derive(Clone, Debug)]
pub(super) struct Standardisation {
    features: [MeanAndDeviation; FEATURES],
    force: MeanAndDeviation,
}

/// Mean and standard deviation, in the precision in which they are stored.
#[derive(Clone, Copy, Debug)]
struct MeanAndDeviation {
    mean: f32,
    deviation: f32,
}

/// Two hidden layers, each followed by max(0, ·).
#[derive(Debug)]
pub(super) struct Network {
    layers: [Layer; 3],
    hidden: usize,
}

impl Network {
    /// An untrained network.
    pub(super) fn new(hidden: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        let sizes = [(FEATURES, hidden), (hidden, hidden), (hidden, 1)];
        let [first, second, third] = sizes.map(|(inputs, outputs)| Layer::new(inputs, outputs, random));
        Ok(Self { layers: [first?, second?, third?], hidden })
    }

    pub(super) fn variables(&self) -> Vec<Var> {
        self.layers.iter().flat_map(Layer::variables).collect()
    }

    /// Mean squared error on some samples, in standard deviations of the force.
    pub(super) fn loss(&self, samples: &[Sample], standard: &Standardisation) -> Result<Tensor> {
        let inputs: Vec<f32> = samples.iter().flat_map(|sample| standard.inputs(sample)).collect();
        let forces: Vec<f32> =
            samples.iter().map(|sample| standard.force.standardised(force(sample))).collect();
        let inputs = Tensor::from_vec(inputs, (samples.len(), FEATURES), &Device::Cpu)?;
        let forces = Tensor::from_vec(forces, (samples.len(), 1), &Device::Cpu)?;
        let [first, second, third] = &self.layers;
        let hidden = second.forward(&first.forward(&inputs)?.relu()?)?.relu()?;
        candle_nn::loss::mse(&third.forward(&hidden)?, &forces)
    }

    /// The current network, with outputs in N.
    pub(super) fn weights(&self, standard: &Standardisation) -> Result<Weights> {
        let [first, second, third] = &self.layers;
        let dense = |layer: &Layer, inputs, outputs| -> Result<Dense> {
            let (weight, bias) = layer.values()?;
            Ok(Dense { inputs, outputs, weight, bias })
        };
        let mut output = dense(third, self.hidden, 1)?;
        let MeanAndDeviation { mean, deviation } = standard.force;
        output.weight.iter_mut().for_each(|weight| *weight *= deviation);
        output.bias.iter_mut().for_each(|bias| *bias = *bias * deviation + mean);
        Ok(Weights {
            mean: standard.features.iter().map(|moments| moments.mean).collect(),
            scale: standard.features.iter().map(|moments| moments.deviation).collect(),
            hidden: [dense(first, FEATURES, self.hidden)?, dense(second, self.hidden, self.hidden)?],
            output,
            // Placeholder until the error is measured.
            rmse: deviation,
        })
    }
}

impl Standardisation {
    /// The scaling of the training samples.
    pub(super) fn of<'a>(samples: impl Iterator<Item = &'a Sample> + Clone) -> Self {
        let of = |number: &dyn Fn(&Sample) -> f64| {
            MeanAndDeviation::of(&samples.clone().map(number).collect::<Vec<f64>>())
        };
        let features = core::array::from_fn(|k| of(&|sample| sample.features[k]));
        Self { features, force: of(&force) }
    }

    /// The standard deviation of the forces (N).
    pub(super) fn force_deviation(&self) -> f64 {
        f64::from(self.force.deviation)
    }

    fn inputs(&self, sample: &Sample) -> [f32; FEATURES] {
        core::array::from_fn(|k| self.features[k].standardised(sample.features[k]))
    }
}

impl MeanAndDeviation {
    fn of(values: &[f64]) -> Self {
        let mean = mean(values).unwrap_or_default();
        let variance = population_variance(values).unwrap_or_default();
        // A constant feature carries no information and must not be amplified.
        let deviation = if variance > 1e-12 { variance.sqrt() as f32 } else { 1.0 };
        Self { mean: mean as f32, deviation }
    }

    fn standardised(self, number: f64) -> f32 {
        ((number - f64::from(self.mean)) / f64::from(self.deviation)) as f32
    }
}

fn force(sample: &Sample) -> f64 {
    f64::from(sample.strength.max_force())
}
