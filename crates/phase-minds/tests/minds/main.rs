//! Minds of both kinds, tested module by module.

mod agents;
mod parameters;
