//! The physics, tested module by module.

mod by_hand;
mod coarse;
mod conservation;
mod differential;
mod imagined;
mod invariants;
mod parting;
mod points;
mod probes;
mod recordings;
mod records;
mod release;
mod scenes;
mod walls;
