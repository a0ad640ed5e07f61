//! Our own minds, tested module by module.

mod mind;
mod objective;
mod policy;
mod theory;
