//! Task 1, joint inference of goals and relations: what counts as correct, and the accuracy of a method.

mod answer;
mod calibration;
mod matching;
mod mistakes;
mod sets;
mod summary;

pub use answer::{Answer, GoalProbability, InvalidAnswer, Label, PartialAnswer, RecognisedEvent};
pub use calibration::{BINS, Bin, Calibration};
pub use matching::canonical;
pub use mistakes::{ErrorBreakdown, GOAL_KINDS};
pub use sets::SetScores;
pub use summary::{RELATIONS, RecognitionScores, RecognitionSummary};
