//! What is learnt from data: training of neural networks on social events.
//!
//! - [`strength`] trains SIMPLE's guess at agents' strengths, which `phase_simple::StrengthRegressor` evaluates,
//! - [`layer`] is what networks are put together from.
//!
//! The key design decision is that all chance (first weights, order of samples, what is drawn from an event) comes from
//! one seed through `phase_model::random`, none from the library for neural networks, and that matrices are small
//! enough to be multiplied on one thread. So the same seed and samples give the same weights, bit for bit. The price is
//! speed, and that the promise ends where processors have different instructions for multiplying matrices.
//!
//! Nothing here reads a file, looks at a clock or prints; the program `train` beside it does. No other crate of the
//! library uses this one: the library for neural networks takes long to build.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod layer;
pub mod strength;
