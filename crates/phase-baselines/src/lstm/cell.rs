//! One step of an LSTM after the matrix product, in one pass over the values.
//!
//! Composed of the library's own operations, the same takes some twenty tensors forward and more than twice
//! as many backward, for every step of every event.

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor, bail};
use std::sync::Arc;

/// From gates before their sigmoids (rows × 4·size: input, forget, new, output) and state (rows × 2·size:
/// hidden state, cell state) to the next state.
pub(super) struct Cell {
    pub(super) size: usize,
    /// Rows that have a next state; the others keep theirs.
    pub(super) active: Option<Arc<[bool]>>,
}

/// The update of one element of the cell state.
struct Unit {
    input: f32,
    forget: f32,
    new: f32,
    output: f32,
    memory: f32,
    /// tanh of the cell state.
    shown: f32,
}

impl Cell {
    fn is_active(&self, row: usize) -> bool {
        self.active.as_ref().is_none_or(|active| active.get(row).copied().unwrap_or(false))
    }

    fn unit(&self, gates: &[f32], state: &[f32], k: usize) -> Unit {
        let size = self.size;
        let input = sigmoid(gates[k]);
        // Forget-gate bias of 1, as usual, so that the initial cell state persists over long events.
        let forget = sigmoid(gates[size + k] + 1.0);
        let new = tanh(gates[2 * size + k]);
        let output = sigmoid(gates[3 * size + k]);
        let memory = forget * state[size + k] + input * new;
        Unit { input, forget, new, output, memory, shown: tanh(memory) }
    }
}

impl CustomOp2 for Cell {
    fn name(&self) -> &'static str {
        "lstm-cell"
    }

    fn cpu_fwd(
        &self,
        gates: &CpuStorage,
        gates_layout: &Layout,
        state: &CpuStorage,
        state_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let gates = values(gates, gates_layout)?;
        let state = values(state, state_layout)?;
        let size = self.size;
        let rows = state.len() / (2 * size).max(1);
        if gates.len() != rows * 4 * size {
            bail!("an LSTM of {size} cannot take {} gates for {rows} rows", gates.len());
        }
        let mut next = state.to_vec();
        let each = next.chunks_exact_mut(2 * size).zip(gates.chunks_exact(4 * size));
        for (row, (next, gates)) in each.enumerate().filter(|&(row, _)| self.is_active(row)) {
            let state = &state[row * 2 * size..][..2 * size];
            for k in 0..size {
                let unit = self.unit(gates, state, k);
                next[k] = unit.output * unit.shown;
                next[size + k] = unit.memory;
            }
        }
        Ok((CpuStorage::F32(next), Shape::from((rows, 2 * size))))
    }

    fn bwd(
        &self,
        gates: &Tensor,
        state: &Tensor,
        _next: &Tensor,
        gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let size = self.size;
        let flat = |tensor: &Tensor| tensor.flatten_all()?.to_vec1::<f32>();
        let gate_numbers = flat(gates)?;
        let state_numbers = flat(state)?;
        let gradients = flat(gradient)?;
        let mut gate_slopes = vec![0.0; gate_numbers.len()];
        // An inactive row passes its gradient through unchanged.
        let mut state_gradients = gradients.clone();
        let rows = gate_slopes.chunks_exact_mut(4 * size).zip(state_gradients.chunks_exact_mut(2 * size));
        for (row, (gate_slopes, state_gradients)) in rows.enumerate().filter(|&(row, _)| self.is_active(row))
        {
            let gates = &gate_numbers[row * 4 * size..][..4 * size];
            let state = &state_numbers[row * 2 * size..][..2 * size];
            let gradients = &gradients[row * 2 * size..][..2 * size];
            for k in 0..size {
                let Unit { input, forget, new, output, shown, .. } = self.unit(gates, state, k);
                let memory_slope = gradients[size + k] + gradients[k] * output * (1.0 - shown * shown);
                gate_slopes[k] = memory_slope * new * input * (1.0 - input);
                gate_slopes[size + k] = memory_slope * state[size + k] * forget * (1.0 - forget);
                gate_slopes[2 * size + k] = memory_slope * input * (1.0 - new * new);
                gate_slopes[3 * size + k] = gradients[k] * shown * output * (1.0 - output);
                state_gradients[k] = 0.0;
                state_gradients[size + k] = memory_slope * forget;
            }
        }
        let shaped = |values: Vec<f32>, like: &Tensor| Tensor::from_vec(values, like.shape(), like.device());
        Ok((Some(shaped(gate_slopes, gates)?), Some(shaped(state_gradients, state)?)))
    }
}

/// The values of a contiguous tensor.
fn values<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let all = storage.as_slice::<f32>()?;
    let Some((from, to)) = layout.contiguous_offsets() else {
        bail!("an LSTM needs numbers that lie one after the other");
    };
    Ok(&all[from..to])
}

fn sigmoid(number: f32) -> f32 {
    1.0 / (1.0 + libm::expf(-number))
}

fn tanh(number: f32) -> f32 {
    2.0 * sigmoid(2.0 * number) - 1.0
}
