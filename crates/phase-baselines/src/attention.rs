//! Attention: from every node a weighted look at all that are there.

use candle_core::{D, Result, Tensor};
use candle_nn::ops::softmax;

/// Added to the scores of nodes that are not there: their weight is 0.
pub(crate) const UNSEEN: f32 = -1e9;

/// Sums of `values` (graphs × nodes × numbers) with the softmax of `scores` (graphs × from × nodes) as weights, where
/// `unseen` (graphs × 1 × nodes) is 0 for nodes that are there and [`UNSEEN`] for others.
pub(crate) fn attend(scores: &Tensor, unseen: &Tensor, values: &Tensor) -> Result<Tensor> {
    softmax(&scores.broadcast_add(unseen)?, D::Minus1)?.matmul(values)
}
