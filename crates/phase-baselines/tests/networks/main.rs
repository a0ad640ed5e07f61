//! The paper's neural baselines, with small sizes.

mod beliefs;
mod forecasting;
mod goals;
mod learning;
mod lstm;
mod masks;
mod record;
mod rounds;
mod social_gnn;
mod strength;
mod support;
