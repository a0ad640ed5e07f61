//! Targets and engines of fuzzing, tested module by module.

mod engines;
mod targets;
