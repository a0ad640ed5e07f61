//! Sight and touch, by module.

mod cells;
mod common;
mod footprint;
mod observation;
mod oracle;
mod symmetry;
mod viewpoint;
