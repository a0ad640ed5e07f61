//! Long short-term memory.

mod cell;

use crate::{layer::Layer, parameters::Parameter};
use candle_core::{DType, Device, Module, Result, Tensor};
use cell::Cell;
use phase_model::random::Pcg64Mcg;
use std::sync::Arc;

/// An LSTM: one layer from input and last output to its four gates.
///
/// Its state is one tensor, rows × 2·`size`: what it puts out, then its memory.
#[derive(Clone, Debug)]
pub struct Lstm {
    gates: Layer,
    size: usize,
}

impl Lstm {
    /// From `inputs` numbers to `size`, with first weights as [`Layer::new`] draws them.
    ///
    /// # Errors If a tensor cannot be allocated.
    pub fn new(inputs: usize, size: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self { gates: Layer::new(inputs + size, 4 * size, random)?, size })
    }

    /// The state before the first step: zeros.
    ///
    /// # Errors If a tensor cannot be allocated.
    pub fn start(&self, rows: usize) -> Result<Tensor> {
        Tensor::zeros((rows, 2 * self.size), DType::F32, &Device::Cpu)
    }

    /// The state after one more input (rows × inputs). Rows that are not `active` keep their state; without a list
    /// all are.
    ///
    /// # Errors
    /// If shapes do not fit.
    pub fn step(&self, input: &Tensor, state: &Tensor, active: Option<Arc<[bool]>>) -> Result<Tensor> {
        let gates = self.gates.forward(&Tensor::cat(&[input, &self.output(state)?], 1)?)?;
        gates.apply_op2(state, Cell { size: self.size, active })
    }

    /// What a state puts out, rows × `size`, numbers between −1 and 1.
    ///
    /// # Errors
    /// If the state is not of this LSTM.
    pub fn output(&self, state: &Tensor) -> Result<Tensor> {
        state.narrow(1, 0, self.size)?.contiguous()
    }

    /// Trainable parameters with their names.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        self.gates.parameters(name)
    }
}
