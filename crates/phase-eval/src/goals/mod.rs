//! Task 1, joint inference of goals and relations: what counts as correct, and the accuracy of a method.

mod agreement;
mod answer;
mod calibration;
mod matching;
mod mistakes;
mod report_training;
mod roles;
mod sets;
mod summary;

pub use agreement::{Agreement, Ceiling, UNIFORM_SHARE, similarity_ceiling};
pub use answer::{Answer, GoalProbability, InvalidAnswer, Label, PartialAnswer, RecognisedEvent, SocialRole};
pub use calibration::{BINS, Bin, Calibration};
pub use matching::canonical;
pub use mistakes::{ErrorBreakdown, GOAL_KINDS};
pub use report_training::{Protocol, ProtocolError, REPORT_TRAINING_FORMAT, ReportTraining};
pub use roles::RoleScores;
pub use sets::SetScores;
pub use summary::{RELATIONS, RecognitionScores, RecognitionSummary};
pub(crate) use summary::{goals_among, says};
