//! Reports on PHASE datasets and evaluations for people: plots, pages, cards and tables.
//!
//! - [`plot`] draws bar charts and curves as SVG; [`document`] builds a text with tables and plots, as Markdown and
//!   as a page that opens offline.
//! - [`evaluation`] reports how well a method, or a benchmark of many, perceives events, beside the [`published`]
//!   results.
//! - [`gallery`] is a dataset's page with every video, [`card`] its dataset card, [`mod@statistics`] the
//!   paper's figures compared with its own, and [`acceptance`] and [`summary`] are tables of how it was
//!   generated and how simulations compare with recordings.
//!
//! Key design decision: a report is a function from data to text. Measures are computed by `phase-eval`,
//! files are written by the command line, and nothing here depends on how an event was simulated. So the same
//! numbers serve programs (as JSON) and people (as pages), and a page can be tested as text. The trade-off is
//! that pages and plots are assembled manually, without a template engine or a plotting library, and whole
//! pages are held in memory.
//!
//! # Example
//!
//! ```
//! use phase_report::{
//!     document::{Block, Document},
//!     plot::bars,
//! };
//!
//! let rows = [("helping".to_owned(), 120.0), ("chasing".to_owned(), 80.0)];
//! let title = "Events by kind";
//! let plot = Block::Plot { file: "kinds.svg", title: title.into(), svg: bars(title, "", &rows) };
//! let document = Document { title: "A dataset".into(), blocks: vec![plot] };
//! assert_eq!(document.to_markdown(), "# A dataset\n\n![Events by kind](kinds.svg)\n");
//! assert!(document.to_html().contains("<svg"));
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod acceptance;
pub mod card;
pub mod document;
pub mod evaluation;
mod features;
pub mod gallery;
pub mod markup;
pub mod plot;
pub mod published;
pub mod statistics;
pub mod summary;
