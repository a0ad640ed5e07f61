//! The simulation of events, tested module by module.

mod branch;
mod copies;
mod distances;
mod episode;
mod extremes;
mod simulation;
mod vector;
