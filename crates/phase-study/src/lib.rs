//! Rating studies: people watch videos of social events and answer questions about them.
//!
//! - [`config`] is a study (`phase-study/1`): texts, videos, how many raters; [`design`] makes the paper's
//!   experiments from videos.
//! - [`forms`] are the three sets of questions, [`question`] what a question and an answer are.
//! - [`study`] leads raters from consent to the last answer; [`assignment`] decides who sees what, [`store`]
//!   keeps the answers, [`record`] tells which raters count.
//! - [`export`] makes a Psych-DS dataset and `phase-ratings/1` of the answers, [`analysis`] agreement,
//!   accuracies, human-likeness and the interactions that at least half of the raters see.
//!
//! Key design decision: what a rater sees next follows from what is stored of it, and every step is one
//! transaction in one SQLite file that is only added to. So a server has no state of its own: it can be
//! killed at any moment, and a returning rater continues where they left off. Clock and randomness are
//! arguments, HTTP is elsewhere. The trade-off is that every answer waits for the disk, and that where
//! videos are assigned all raters are read.
//!
//! Feature `store` (on by default) has [`store`] and [`study`], and builds SQLite from its source.
//!
//! A study of two videos, each wanted by one rater, who answers both:
//!
//! ```
//! use phase_study::analysis::Analysis;
//! use phase_study::study::{Stage, Study, Token};
//! use phase_study::{config::StudyConfig, forms::Forms, store::Store};
//! use serde_json::json;
//! use std::collections::BTreeMap;
//!
//! let config = json!({
//!     "format": "phase-study/1", "name": "first", "title": "A first study", "form": "relation",
//!     "consent": ["Do you agree to take part?"], "instructions": ["Watch each video, then answer."],
//!     "stimuli": [{"id": "a", "video": "a.mp4", "relation": "friendly"}, {"id": "b", "video": "b.mp4"}],
//!     "raters_per_video": 1, "videos_per_rater": 2, "completion": {"code": "C0DE"},
//! });
//! let forms = Forms::included()?;
//! let config = StudyConfig::read(config.to_string().as_bytes(), &forms)?;
//! let folder = tempfile::tempdir()?;
//! let store = Store::open(&folder.path().join("first.sqlite"), &config.name, config.form.name())?;
//! let mut study = Study::new(config, forms.clone(), store)?;
//!
//! // A server would take random bytes of the operating system, and the time.
//! let token = study.join(&BTreeMap::new(), 0, Token::new([7; 16]))?.token;
//! study.consent(&token, true, 1000)?;
//! study.instructed(&token, 2000)?;
//! for trial in 1..=2 {
//!     let answer = json!({"trial": trial, "answer": {"relation": "friendly"}, "response_time": 900,
//!         "plays": 1});
//!     study.answer(&token, &answer, 3000)?;
//! }
//! assert_eq!(study.stage(&token)?, Stage::Done { code: Some("C0DE".into()), url: None });
//!
//! let raters = study.raters()?;
//! let analysis = Analysis::of(study.config(), &forms, &raters);
//! assert_eq!(analysis.accuracy[0].majority.share, 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod analysis;
pub mod assignment;
pub mod config;
pub mod design;
pub mod export;
#[cfg(feature = "store")]
mod fit;
pub mod forms;
#[cfg(feature = "store")]
mod places;
pub mod question;
pub mod record;
#[cfg(feature = "store")]
pub mod store;
#[cfg(feature = "store")]
pub mod study;
