//! Adam (Kingma and Ba, 2015), with moments that can be saved and restored.

use crate::parameters::{Parameter, set_values, values};
use candle_core::{Result, backprop::GradStore};

const BETA_1: f64 = 0.9;
const BETA_2: f64 = 0.999;
const EPSILON: f32 = 1e-8;

/// The optimiser's state.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Adam {
    /// Updates made so far.
    pub(super) steps: u32,
    /// Running means of gradients, by parameter.
    pub(super) first: Vec<Vec<f32>>,
    /// Running means of their squares.
    pub(super) second: Vec<Vec<f32>>,
}

impl Adam {
    /// The initial state.
    pub(super) fn new(parameters: &[Parameter]) -> Self {
        let zeros: Vec<Vec<f32>> =
            parameters.iter().map(|(_, variable)| vec![0.0; variable.elem_count()]).collect();
        Self { steps: 0, first: zeros.clone(), second: zeros }
    }

    /// Updates the parameters by the gradients of a loss, clipped to the global norm `max_norm`. A parameter
    /// that the loss does not depend on has gradient 0.
    pub(super) fn step(
        &mut self,
        parameters: &[Parameter],
        gradients: &GradStore,
        rate: f64,
        max_norm: f64,
    ) -> Result<()> {
        let gradient = |(_, variable): &Parameter| match gradients.get(variable) {
            Some(gradient) => gradient.flatten_all()?.to_vec1::<f32>(),
            None => Ok(vec![0.0; variable.elem_count()]),
        };
        let gradients: Vec<Vec<f32>> = parameters.iter().map(gradient).collect::<Result<_>>()?;
        let squares: f64 =
            gradients.iter().flatten().map(|gradient| f64::from(*gradient) * f64::from(*gradient)).sum();
        let shortened = (max_norm / squares.sqrt().max(max_norm)) as f32;
        self.steps += 1;
        let grown = |beta: f64| 1.0 - libm::pow(beta, f64::from(self.steps));
        let rate = (rate / grown(BETA_1)) as f32;
        let root = (1.0 / grown(BETA_2)) as f32;
        let beta_1 = BETA_1 as f32;
        let beta_2 = BETA_2 as f32;
        let mut all = values(parameters)?;
        for (((values, gradients), first), second) in
            all.iter_mut().zip(&gradients).zip(&mut self.first).zip(&mut self.second)
        {
            for (((number, gradient), first), second) in
                values.iter_mut().zip(gradients).zip(first).zip(second)
            {
                let gradient = gradient * shortened;
                *first = beta_1 * *first + (1.0 - beta_1) * gradient;
                *second = beta_2 * *second + (1.0 - beta_2) * gradient * gradient;
                *number -= rate * *first / ((*second * root).sqrt() + EPSILON);
            }
        }
        set_values(parameters, &all)
    }
}
