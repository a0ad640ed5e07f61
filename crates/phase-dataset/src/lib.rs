//! Datasets of PHASE events on disk: files, presets, splits, manifests, Parquet, and checks of them all.
//!
//! - [`phase_events`] reads files of the exchange format `phase-events/1`, whose events `phase-event`
//!   describes.
//! - [`manifest`] describes a generated dataset to programs, [`overview`] is the same without its events;
//!   pages and tables for people are made elsewhere.
//! - [`parquet`] and [`croissant`] are for external tools; [`mod@verify`] checks that all files agree.
//! - [`event_set`] describes minimal pairs. [`preset`] defines the composition of a dataset, [`splits`] how
//!   it is divided, [`slot_record`], [`acceptance`] and [`shard`] what was tried for each of its events.
//! - [`summary`] compares simulations with recordings.
//! - [`event_cache`] keeps finished events for a run that goes on.
//!
//! Key design decision: files are read manually from a tree of JSON values instead of by derived readers, so
//! that errors name the event, the field and the rule. The cost is a reader four times as long, and a file
//! has to fit in memory twice.
//!
//! Only paths that it is given are accessed; `phase-files` writes and measures the files.
//!
//! A preset is the composition of a dataset; each of its slots becomes an event:
//!
//! ```
//! use phase_dataset::{composition::Composition, preset::Preset};
//! use phase_model::EventKind;
//!
//! let preset = Preset::parse("demo", phase_data::DEMO)?;
//! assert_eq!((preset.events(), preset.id(7).as_str()), (12, "demo-0007"));
//! let composition = Composition::of(&preset);
//! let kinds = (0..preset.events()).map(|index| composition.slot(index).variant.kind());
//! assert_eq!(kinds.filter(|&kind| kind == EventKind::Chasing).count(), 2);
//! # Ok::<(), phase_files::FileError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod acceptance;
pub mod composition;
pub mod croissant;
pub mod error;
pub mod event_cache;
pub mod event_set;
pub mod form;
mod ids;
pub mod labels;
pub mod manifest;
pub mod manifest_writer;
pub mod overview;
pub mod parquet;
pub mod phase_events;
pub mod preset;
pub mod shard;
pub mod slot_record;
pub mod split_list;
pub mod splits;
pub mod summary;
pub mod verify;
pub mod video_table;

pub use error::{DatasetProblem, ExportError};
