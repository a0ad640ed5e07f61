//! Estimates and logarithms, tested module by module.

mod logarithms;
mod statistics;
