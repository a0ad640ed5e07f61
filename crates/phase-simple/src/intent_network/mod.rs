//! A learnt guess at intents: Q(Y | S), a network that sees the motion alone.
//!
//! For each goal of each agent a small recurrent network follows the event row by row and gives three logits:
//! that the agent pursues the goal for its own sake, that the other helps it, and that the other hinders it.
//! Q(Y | S) is proportional to the exponential of the sum of two of them
//! ([`joint_logs`](crate::intent::joint_logs)), as the likelihoods of both agents' intents are multiplied in
//! inverse planning. All goals share the same weights and see the event relative to themselves
//! ([`GoalFeatures`]), so a few hundred events suffice for training.
//!
//! Key design decision: the network is evaluated here in plain arithmetic, row by row, so that inference
//! needs no neural-network library, is the same on every machine, and can follow an event while it is
//! watched. Training is in `phase-baselines`. The trade-off is that the two have to agree, which a test
//! checks.

mod features;
mod file;
mod network;

pub use features::{FEATURES, GoalFeatures, goal_index};
pub use file::{INTENT_NETWORK_FORMAT, IntentNetworkError};
pub use network::{IntentNetwork, IntentReader, OUTPUTS};
