//! Questions about social events, for evaluations of models that watch videos.
//!
//! [`questions()`] makes multiple-choice questions about events and about pairs of events that differ in one
//! social variable. What is asked is a [`Query`]; the answer follows from the scene, from the motion, from an
//! agent's particles or from another simulation ([`Facts`]), and every [`Question`] says from which.
//! [`frames_needed`] finds the least number of frames from which a question can be answered, and [`score()`]
//! scores answers. [`Control`] lists what else can be shown in place of the video.
//!
//! Key design decision: an answer is a value, such as the number of a room. [`Query::seen`] and
//! [`Query::choice`] say which value follows from given motion or from a method's judgement: they define
//! right answers, answer for the methods of the benchmark, and certify frames. The trade-off is that every
//! option has to be a value of the same kind, so that there are no options of several parts.
//!
//! A model says "Answer: (B)", and is right:
//!
//! ```
//! use phase_questions::{Control, parse_answer};
//!
//! let options = ["the top left room", "the bottom right room"];
//! assert_eq!(parse_answer("Answer: (B)", &options), Some(1));
//! assert_eq!(parse_answer("It is in the bottom right room.", &options), Some(1));
//! assert_eq!(parse_answer("I cannot tell.", &options), None);
//! assert_eq!(Control::named("no-video"), Some(Control::NoVideo));
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod ask;
mod beliefs;
mod benchmark;
mod facts;
mod frames;
mod free;
mod pairs;
mod query;
mod question;
mod score;
mod words;

pub use ask::{asks_without, foreseen, idle_of, is_about_beliefs};
pub use benchmark::{frames_needed, questions};
pub use facts::{Alternative, Facts, Inside, SimulatedFutures, Watched, believed_rooms};
pub use frames::{BUDGETS, reordered, sampled, shown_steps, stills};
pub use free::{Accepted, accepted, parse_free};
pub use query::Query;
pub use question::{Choice, Control, FrameBudget, NONE, Question, parse_answer};
pub use score::{Accuracy, Answer, Row, Score, score};
pub use words::{INTRODUCTION, PHRASINGS};
