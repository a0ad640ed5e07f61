//! PHASE in a browser: what the playground's pages call, as WebAssembly.
//!
//! A [`PageSimulation`] simulates a scene step by step, with minds or people's actions; a [`PageObserver`]
//! infers goals and relation while an event runs; a [`PageTracker`] reads videos; a [`Picture`] draws as the
//! videos are drawn; [`scenes`] checks, describes and samples scenes, and reads files of events. Everything
//! is exchanged as JSON in the formats of `docs/reference/formats/overview.md`, or as 32-bit floats where
//! there is one for each body and step ([`packed`]).
//!
//! Key design decision: the browser runs the same code as the command line, physics, minds, inference and
//! drawing, and the pages only ask and show. An event that is made in a browser has the bytes that
//! `phase simulate` gives it. The trade-off is a download of some megabytes.
//!
//! ```
//! use phase_playground::{PageSimulation, scenes};
//!
//! let scene = scenes::sample("helping", None, 1)?;
//! let mut simulation = PageSimulation::new(&scene, 1, r#"{"max_steps": 3, "minds": {"simulations": 20}}"#)?;
//! while !simulation.is_over() {
//!     simulation.step([None, None])?;
//! }
//! assert!(simulation.document("helping")?.starts_with("{\"format\":\"phase-events/1\""));
//! # Ok::<(), String>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

#[cfg(target_arch = "wasm32")]
pub mod bindings;
pub mod observer;
pub mod packed;
pub mod picture;
pub mod scenes;
pub mod simulation;
pub mod video;

pub use observer::PageObserver;
pub use picture::Picture;
pub use simulation::PageSimulation;
pub use video::PageTracker;

/// The generator named in files.
const GENERATOR: &str = concat!("phase ", env!("CARGO_PKG_VERSION"));

/// An error as a sentence, which is all that a page can do with it.
fn sentence(error: impl core::fmt::Display) -> String {
    error.to_string()
}
