//! Long short-term memory.

mod cell;

use crate::{layer::Layer, parameters::Parameter};
use candle_core::{DType, Device, Module, Result, Tensor};
use cell::Cell;
use phase_model::random::Pcg64Mcg;
use std::sync::Arc;

/// An LSTM: one layer from input and previous output to its four gates.
///
/// Its state is one tensor, rows × 2·`size`: hidden state, then cell state.
#[derive(Clone, Debug)]
pub struct Lstm {
    gates: Layer,
    size: usize,
}

impl Lstm {
    /// From `inputs` features to `size` units, with initial weights drawn as in [`Layer::new`].
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(inputs: usize, size: usize, random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self { gates: Layer::new(inputs + size, 4 * size, random)?, size })
    }

    /// The initial state: zeros.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn start(&self, rows: usize) -> Result<Tensor> {
        Tensor::zeros((rows, 2 * self.size), DType::F32, &Device::Cpu)
    }

    /// The state after one more input (rows × inputs). Rows that are not `active` keep their state; without a
    /// list all are.
    ///
    /// # Errors
    /// If shapes do not match.
    pub fn step(&self, input: &Tensor, state: &Tensor, active: Option<Arc<[bool]>>) -> Result<Tensor> {
        let gates = self.gates.forward(&Tensor::cat(&[input, &self.output(state)?], 1)?)?;
        gates.apply_op2(state, Cell { size: self.size, active })
    }

    /// The hidden state, rows × `size`, values between −1 and 1.
    ///
    /// # Errors
    /// If the state does not belong to this LSTM.
    pub fn output(&self, state: &Tensor) -> Result<Tensor> {
        state.narrow(1, 0, self.size)?.contiguous()
    }

    /// Trainable parameters with their names.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Vec<Parameter> {
        self.gates.parameters(name)
    }
}
