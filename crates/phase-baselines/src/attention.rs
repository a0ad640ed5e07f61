//! Attention: every node attends to all present nodes.

use candle_core::{D, Result, Tensor};
use candle_nn::ops::softmax;

/// Added to the scores of absent nodes: their weight is 0.
pub(crate) const MASK_BIAS: f32 = -1e9;

/// Sums of `values` (graphs × nodes × features) with the softmax of `scores` (graphs × from × nodes) as
/// weights, where `mask` (graphs × 1 × nodes) is 0 for present nodes and [`MASK_BIAS`] for others.
pub(crate) fn attend(scores: &Tensor, mask: &Tensor, values: &Tensor) -> Result<Tensor> {
    softmax(&scores.broadcast_add(mask)?, D::Minus1)?.matmul(values)
}
