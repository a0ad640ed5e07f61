//! Documents for people: headings, texts, tables and plots, as Markdown and as a page that opens offline.
//!
//! - [`document`] has the blocks of a document and writes them.
//! - [`plot`] draws bar charts and curves as SVG.
//! - [`markup`] escapes names that somebody chose, so that none of them becomes markup.
//!
//! Key design decision: a document is data, and writing it is a function from data to text. One document
//! serves a repository (Markdown, with plots as files beside it) and a reader offline (one page with
//! everything in it), and a test compares text. The trade-off is that plots and pages are assembled manually,
//! without a template engine or a plotting library, and a whole page is held in memory.
//!
//! # Example
//!
//! ```
//! use phase_document::{
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

pub mod document;
pub mod markup;
pub mod plot;
