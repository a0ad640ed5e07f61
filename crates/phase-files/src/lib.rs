//! Files that are whole or absent, and folders that one run at a time writes into.
//!
//! - [`atomic`] writes files beside their place, syncs and renames them; [`checksum`] measures them, and
//!   [`measured`] does so while they are written.
//! - [`folder`] locks a folder and records which run it belongs to; [`cache`] keeps results of an interrupted
//!   run; [`new_folder`] fills a folder that is not there, and it appears when it is whole.
//! - [`run`] says which run it is, and hashes its description; two runs are compared by it.
//! - [`regular`] reads files, and only those that are regular; [`json`] reads files of JSON.
//! - [`incidental`] names the files that systems and tools leave in folders.
//! - [`fault`] interrupts a program, on demand, at any step of writing.
//! - [`FileError`] and [`WriteError`] name the file and what is wrong with it in one plain sentence.
//!
//! Key design decision: a run may be killed at any moment, and its files are still right. No file under its
//! own name is ever half-written, and the same command goes on where the last one stopped. The price is a
//! sync and a rename for each file, and that a file is never changed in place.
//!
//! The crate accesses the file system only at paths that it is given.
//!
//! # Example
//!
//! A file is written atomically and entered with its checksum; later changes are detected:
//!
//! ```
//! use phase_files::{Problem, atomic, checksum::FileEntry};
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

pub mod atomic;
pub mod cache;
pub mod checksum;
mod error;
pub mod fault;
pub mod folder;
pub mod incidental;
pub mod json;
pub mod measured;
pub mod new_folder;
pub mod private;
pub mod regular;
pub mod run;

pub use error::{FileError, Problem, WriteError, plain_reason, serialize_told, shown, told};
