//! Events in memory and as JSON, tested module by module.

mod observed;
mod read;
mod real;
mod round_trip;
mod serde;
mod support;
mod warnings;
