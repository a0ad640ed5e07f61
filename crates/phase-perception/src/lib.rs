//! What a PHASE agent sees and feels.
//!
//! [`observe`] gives an agent's observation of a state: the cells in its conical field of view, hidden by walls
//! and by other bodies, the entities it sees in them, those it feels, and those it knows of because they
//! touch an observed one (paper, "Belief Representation and Update" and its footnote). [`observed_set`] gives
//! just the entities, fast enough for a tree search.
//!
//! The key design decision is that seeing is reckoned per 1 × 1 u cell and by the cell's centre, as the
//! published simulator does, so that "where could it still be?" has an exact answer for a particle. The price
//! is that a body shows as soon as one of its cells' centres does.
//!
//! A body does not hide its own cells: otherwise no one would ever be seen head-on. It does hide what is
//! behind it, also when the observer itself holds it.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod cells;
pub mod eye;
pub mod footprint;
pub mod observation;

pub use cells::{Cell, CellSet};
pub use eye::{field_of_view, sees};
pub use observation::{Observation, observe, observed_set};
