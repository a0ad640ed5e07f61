//! The PHASE dynamics as a plain-data kernel that a planner can copy and step millions of times.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod body;
mod contact;
mod contain;
mod continuous;
mod forward;
mod glide;
mod impact;
mod key;
mod manifold;
mod memory;
mod reach;
mod substep;
mod tuning;
mod turn;
mod wall;
mod weld;
mod world;

pub use forward::Forward;
pub use memory::Memory;
