//! On, Touch, Attach and Close: from physical to symbolic PHASE states.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod predicate;

pub use predicate::{Literal, Place, Predicate};
