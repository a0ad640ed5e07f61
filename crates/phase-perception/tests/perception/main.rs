//! What is seen and felt, by module.

mod cells;
mod common;
mod eye;
mod footprint;
mod observation;
mod oracle;
mod symmetry;
