//! Events that have something in common.

use serde::{Deserialize, Serialize};

/// Scores of the events that have something in common.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct GroupScores<S> {
    /// The name of what they have in common.
    pub name: String,
    /// Their scores.
    #[serde(flatten)]
    pub scores: S,
}
