//! What a standard classifier tells of events without looking at motion.
//!
//! A benchmark must not be solvable without looking. [`audit()`] trains a random forest on features that are known
//! before anything moves ([`Feature`]), feature by feature and all together, and measures by cross-validation how often
//! it names the relation, the kind of event and each agent's goal. Beside it stands the share of the most frequent class,
//! which needs no feature at all.
//!
//! Events that share their bodies are in the same fold: otherwise the forest would recognise bodies, and with them what
//! the others that share them are *not*.
//!
//! Key design decision: features are numbers as a user would first write them down, and the forest has its usual settings. The
//! audit bounds what a careless user finds, not what a determined one could.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod features;
mod folds;
mod forest;
mod report;

pub use features::{AuditItem, Feature};
pub use report::{Audit, AuditRow, MAX_EVENTS, Target, audit, summary, table};
