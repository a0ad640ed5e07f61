//! Runs of PHASE on many events: datasets are generated and verified, methods evaluated, networks trained.
//!
//! - [`gen_dataset::Generation`] generates a dataset, or one shard of it, [`gen_dataset::merge`] combines
//!   shards.
//! - [`simulate::Simulations`] simulates the scenes of a file, [`render::Rendering`] draws events.
//! - [`verify`] checks that a dataset is whole and that its files are what follows from its preset and seed;
//!   [`export`] packs it for training programs; [`figures`] compares its figures with the paper's.
//! - [`eval::Evaluation`] evaluates a method; [`benchmark::BenchmarkRun`]
//!   evaluates all of them; [`leaderboard::Submission`] scores a method from outside for the leaderboard.
//! - [`track::TrackRun`] reads the motion of bodies in a video or table.
//! - [`questions::QuestionRun`] makes a benchmark of questions for evaluators of other models.
//! - `train::Training` trains a network (feature `networks`).
//! - [`source::EventInput`] opens files and folders with events, [`event_writer`] and [`picture`] make the
//!   files of one event.
//!
//! Key design decision: a run belongs to a folder that knows which run it is. Everything finished is a file
//! there, written whole or not at all, so that the same run goes on after any interruption and gives the same
//! bytes, for any number of threads and shards. Nothing is printed: a [`listener::Listener`] hears notes and
//! progress, and an [`error::RunError`] is one plain sentence. The trade-off is that every run needs a
//! folder, and that a result of another version of the program is refused, not converted.
//!
//! A dataset of one short event is generated and verified, and a method evaluated on it:
//!
//! ```
//! use phase_runs::{
//!     effort::{Effort, MindChoice},
//!     eval::{Answers, Evaluation},
//!     gen_dataset::Generation,
//!     listener::Silent,
//!     verify::{self, Checks},
//! };
//!
//! let scratch = tempfile::tempdir()?;
//! let folder = scratch.path().join("dataset");
//! let effort = Effort {
//!     max_steps: Some(2),
//!     minds: MindChoice { simulations: Some(10), ..MindChoice::default() },
//!     particles: Some(5),
//!     ..Effort::default()
//! };
//! let generation = Generation {
//!     events: Some(1),
//!     videos: false,
//!     out: Some(folder.clone()),
//!     effort,
//!     ..Generation::new("demo")
//! };
//! assert_eq!(generation.run(&Silent)?.events, 1);
//!
//! let manifest = verify::open(&folder)?;
//! let checks = Checks { replay: true, ..Checks::default() };
//! assert!(verify::problems(&folder, &manifest, &checks, None, &Silent)?.is_empty());
//!
//! let out = Some(scratch.path().join("evaluation"));
//! let evaluation = Evaluation { out, ..Evaluation::new(&folder) };
//! let evaluated = evaluation.goals(&Answers::of_method("chance"), &Silent)?.ok_or("only a part")?;
//! assert_eq!(evaluated.results["method"], "chance");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod benchmark;
pub mod captions;
pub mod effort;
pub mod engine;
pub mod error;
pub mod eval;
pub mod event_writer;
pub mod export;
pub mod figures;
mod gallery_writer;
pub mod gen_dataset;
pub mod interrupt;
pub mod laboratory;
pub mod leaderboard;
pub mod listener;
pub mod motion;
pub mod parallel;
pub mod picture;
pub mod questions;
pub mod render;
mod resume;
pub mod seal;
pub mod shortcuts;
pub mod simulate;
pub mod source;
pub mod track;
#[cfg(feature = "networks")]
pub mod train;
pub mod verify;
pub mod words;
