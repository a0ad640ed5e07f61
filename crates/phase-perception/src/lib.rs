//! What a PHASE agent sees and feels: a conical field of view with occlusion, and touch.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod cells;

pub use cells::{Cell, CellSet};
