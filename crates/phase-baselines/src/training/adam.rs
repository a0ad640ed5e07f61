//! Adam (Kingma and Ba, 2015), with moments that can be saved and restored.

use crate::parameters::{Parameter, numbers, set_numbers};
use candle_core::{Result, backprop::GradStore};

const BETA_1: f64 = 0.9;
const BETA_2: f64 = 0.999;
const EPSILON: f32 = 1e-8;

/// The optimiser's memory.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Adam {
    /// Changes made so far.
    pub(super) steps: u32,
    /// Running means of slopes, by parameter.
    pub(super) first: Vec<Vec<f32>>,
    /// Running means of their squares.
    pub(super) second: Vec<Vec<f32>>,
}

impl Adam {
    /// Nothing remembered yet.
    pub(super) fn new(parameters: &[Parameter]) -> Self {
        let zeros: Vec<Vec<f32>> =
            parameters.iter().map(|(_, variable)| vec![0.0; variable.elem_count()]).collect();
        Self { steps: 0, first: zeros.clone(), second: zeros }
    }

    /// Updates the parameters by the gradients of a loss, clipped to the global norm `longest`. A parameter that the
    /// loss does not depend on has gradient 0.
    pub(super) fn step(
        &mut self,
        parameters: &[Parameter],
        slopes: &GradStore,
        rate: f64,
        longest: f64,
    ) -> Result<()> {
        let slope = |(_, variable): &Parameter| match slopes.get(variable) {
            Some(slope) => slope.flatten_all()?.to_vec1::<f32>(),
            None => Ok(vec![0.0; variable.elem_count()]),
        };
        let slopes: Vec<Vec<f32>> = parameters.iter().map(slope).collect::<Result<_>>()?;
        let squares: f64 = slopes.iter().flatten().map(|slope| f64::from(*slope) * f64::from(*slope)).sum();
        let shortened = (longest / squares.sqrt().max(longest)) as f32;
        self.steps += 1;
        let grown = |beta: f64| 1.0 - libm::pow(beta, f64::from(self.steps));
        let (rate, root) = ((rate / grown(BETA_1)) as f32, (1.0 / grown(BETA_2)) as f32);
        let (beta_1, beta_2) = (BETA_1 as f32, BETA_2 as f32);
        let mut all = numbers(parameters)?;
        for (((numbers, slopes), first), second) in
            all.iter_mut().zip(&slopes).zip(&mut self.first).zip(&mut self.second)
        {
            for (((number, slope), first), second) in numbers.iter_mut().zip(slopes).zip(first).zip(second) {
                let slope = slope * shortened;
                *first = beta_1 * *first + (1.0 - beta_1) * slope;
                *second = beta_2 * *second + (1.0 - beta_2) * slope * slope;
                *number -= rate * *first / ((*second * root).sqrt() + EPSILON);
            }
        }
        set_numbers(parameters, &all)
    }
}
