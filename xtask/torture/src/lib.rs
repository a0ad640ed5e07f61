//! Whether the commands of `phase` keep their promises about files: commands of `cargo xtask`.
//!
//! - `torture` stops commands while they write, and checks that nothing is lost,
//! - `check-verify` edits a dataset many times, and counts what `verify` finds.
//!
//! Key design decision: what is disturbed are processes, as a user's are. This program also has every command
//! of `phase`, so it starts itself unless `--program` names another. The price is a package that links all
//! that `phase` does.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod check_verify;
pub mod cli;
pub mod error;
pub mod torture;
