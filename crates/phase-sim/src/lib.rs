//! Two PHASE agents and a world make a social event.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod event;

pub use event::{Event, Step};
