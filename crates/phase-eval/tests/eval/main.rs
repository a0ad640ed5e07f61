//! Scores, tested module by module.

mod beliefs;
mod estimate;
mod goals;
mod intents;
mod people;
mod trajectories;
