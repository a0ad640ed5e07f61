//! A priority queue of nodes by cost, in buckets of equal width.

use crate::accuracy::LAST_BUCKET;

/// Nodes by cost (u). A bucket is no wider than the shortest edge, so that the order within it does not
/// matter.
#[derive(Debug)]
pub(crate) struct Buckets {
    width: f32,
    buckets: Vec<Vec<u32>>,
    first: usize,
}

impl Buckets {
    /// An empty queue with buckets of some width (u).
    pub(crate) const fn new(width: f32) -> Self {
        Self { width, buckets: Vec::new(), first: 0 }
    }

    /// Adds a node. A node whose cost falls is added again; whoever takes it out twice finds it settled.
    pub(crate) fn push(&mut self, node: u32, cost: f32) {
        let bucket = ((cost / self.width) as usize).min(LAST_BUCKET).max(self.first);
        if bucket >= self.buckets.len() {
            self.buckets.resize_with(bucket + 1, Vec::new);
        }
        self.buckets[bucket].push(node);
    }

    /// Takes a node of the first bucket that has any.
    pub(crate) fn pop(&mut self) -> Option<u32> {
        while let Some(bucket) = self.buckets.get_mut(self.first) {
            if let Some(node) = bucket.pop() {
                return Some(node);
            }
            self.first += 1;
        }
        None
    }
}
