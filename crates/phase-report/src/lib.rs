//! Reports on PHASE datasets and evaluations for people: pages, cards and tables.
//!
//! - [`evaluation`] reports how well a method, or a benchmark of many, perceives events, beside the
//!   [`published`] results.
//! - [`gallery`] is a dataset's page with every video, [`card`] its dataset card, [`mod@statistics`] the
//!   paper's figures compared with its own, and [`acceptance`] and [`summary`] are tables of how it was
//!   generated and how simulations compare with recordings.
//!
//! Key design decision: a report is a function from data to text. Measures are computed by `phase-eval`,
//! files are written by the command line, and nothing here depends on how an event was simulated. So the same
//! numbers serve programs (as JSON) and people (as pages), and a page can be tested as text. The trade-off is
//! that whole pages are held in memory.
//!
//! # Example
//!
//! ```
//! use phase_dataset::acceptance::Tally;
//! use phase_sampler::Variant;
//!
//! let mut tally = Tally::default();
//! tally.add([Variant::Chase], &[]);
//! let table = phase_report::acceptance::table(&tally.rows());
//! assert!(table.ends_with("| chasing | chase | 1 | 1 | 100 % | – |\n"));
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod acceptance;
pub mod card;
pub mod evaluation;
mod features;
pub mod gallery;
pub mod published;
pub mod statistics;
pub mod summary;
