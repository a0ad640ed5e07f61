//! PHASE events on disk: files, formats, checksums, and folders shared by several runs.
//!
//! - [`phase_events`] reads files of the exchange format `phase-events/1`, whose events `phase-event` describes.
//! - [`manifest`] describes a generated dataset to programs, [`overview`] is the same without its events; pages and tables
//!   for people are made elsewhere.
//! - [`parquet`] and [`croissant`] are for external tools; [`mod@verify`] checks that all files agree.
//! - [`event_set`] describes minimal pairs. [`preset`] defines the composition of a dataset, [`splits`] how it is divided, [`slot_record`],
//!   [`acceptance`] and [`shard`] what was tried for each of its events.
//! - [`summary`] compares simulations with recordings.
//! - [`atomic`], [`folder`] and [`cache`] allow a run to be interrupted at any moment without half-written
//!   files; [`fault`] interrupts it there on demand.
//!
//! Key design decision: files are read manually from a tree of JSON values instead of by derived readers, so
//! that errors name the event, the field and the rule. The cost is a reader four times as long, and a file
//! has to fit in memory twice.
//!
//! Apart from the command line, only this crate accesses the file system, and only at paths that it is given.
//!
//! A file is written atomically and entered with its checksum; later changes are detected:
//!
//! ```
//! use phase_dataset::{Problem, atomic, checksum::FileEntry};
//!
//! let folder = tempfile::tempdir()?;
//! atomic::write(&folder.path().join("event.json"), b"abc")?;
//! let entry = FileEntry::of(folder.path(), "event.json")?;
//! assert_eq!(entry.bytes, 3);
//! assert!(entry.sha256.starts_with("ba7816bf8f01cfea")); // the example of FIPS 180-4
//! entry.verify(folder.path())?;
//!
//! std::fs::write(folder.path().join("event.json"), "abd")?;
//! let problem = entry.verify(folder.path()).err().map(|error| error.problem);
//! assert!(matches!(problem, Some(Problem::Altered("checksum"))));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod acceptance;
pub mod atomic;
pub mod cache;
pub mod checksum;
pub mod composition;
pub mod croissant;
pub mod describe;
pub mod error;
pub mod event_set;
pub mod fault;
pub mod folder;
mod ids;
pub mod json;
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

pub use error::{ExportError, FileError, Problem, WriteError};
