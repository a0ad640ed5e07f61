//! The published mind, against the description of the published simulator.

#![allow(clippy::unwrap_used, clippy::expect_used)]

mod belief;
mod common;
mod decide;
mod policy;
mod rooms;
mod rules;
mod senses;
mod social;
