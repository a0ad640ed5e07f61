//! PHASE events at rest: files, formats, checksums, and folders that several runs may meet in.
//!
//! - [`phase_events`] reads files of the exchange format `phase-events/1`, whose events `phase-event` describes.
//! - [`manifest`] describes a generated dataset to programs; pages and tables for people are made elsewhere.
//! - [`parquet`] and [`croissant`] are for everyone else's tools; [`mod@verify`] checks that all of it agrees.
//! - [`preset`] says what a dataset is composed of, [`splits`] how it is divided, [`slot_record`], [`acceptance`] and
//!   [`shard`] what was tried for each of its events.
//! - [`summary`] compares simulations with recordings.
//! - [`atomic`], [`folder`] and [`cache`] let a run be interrupted at any moment and nothing be half-written.
//!
//! Key design decision: files are read by hand from a tree of JSON values instead of by derived readers, so
//! that errors name the event, the field and the rule. The cost is a reader four times as long, and a file
//! has to fit in memory twice.
//!
//! Together with the command line this crate is where the outside world is touched; it does so only at paths
//! it is given.
//!
//! A file is written atomically and entered with its checksum; when somebody alters it, that is found:
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
pub mod croissant;
pub mod describe;
pub mod error;
pub mod folder;
pub mod json;
pub mod labels;
pub mod manifest;
pub mod parquet;
pub mod phase_events;
pub mod preset;
pub mod shard;
pub mod slot_record;
pub mod split_list;
pub mod splits;
pub mod summary;
pub mod verify;

pub use error::{FileError, Problem, WriteError};
