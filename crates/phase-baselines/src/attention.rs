//! Attention: from every node a weighted look at all that are there.

use candle_core::{D, Result, Tensor};
use candle_nn::ops::softmax;

/// Added to the scores of nodes that are not there: their weight is 0.
pub(crate) const MASK_BIAS: f32 = -1e9;

/// Sums of `values` (graphs × nodes × numbers) with the softmax of `scores` (graphs × from × nodes) as weights, where
/// `mask` (graphs × 1 × nodes) is 0 for nodes that are there and [`MASK_BIAS`] for others.
pub(crate) fn attend(scores: &Tensor, mask: &Tensor, values: &Tensor) -> Result<Tensor> {
    softmax(&scores.broadcast_add(mask)?, D::Minus1)?.matmul(values)
}
