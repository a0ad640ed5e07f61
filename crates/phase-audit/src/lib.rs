//! Shortcuts in a dataset: how much a standard classifier tells of events without looking at motion.
//!
//! A benchmark must not be solvable without looking. [`audit()`] trains a random forest on features that
//! are known before anything moves ([`Feature`]), feature by feature and all together, and measures by
//! cross-validation how often it names the relation, the kind of event, each agent's goal and its
//! knowledge. Beside it stands the share of the most frequent class, which needs no feature at all.
//!
//! Events that share their bodies are in the same fold: otherwise the forest would recognise bodies, and with
//! them what the others that share them are *not*.
//!
//! Key design decision: features are numbers as a user would first write them down, and the forest has its
//! usual settings. The audit bounds what a careless user finds, not what a determined one could.
//!
//! Sixty events in which nothing moves, but all that are chases last a step longer. The audit finds that
//! their length tells the kind:
//!
//! ```
//! use phase_audit::{AuditItem, Feature, Target, audit};
//! use serde_json::json;
//!
//! let mut items = Vec::new();
//! for k in 0..60 {
//!     let (kind, rows) = if k % 2 == 0 { ("chasing", 2) } else { ("independent", 1) };
//!     let agent = |sign: i8| json!({"size_level": 0, "strength_level": 2, "alpha": 0,
//!         "goal": {"kind": "touch", "agent": 0, "other": 1, "sign": sign}});
//!     let first = [8.0 + 0.1 * f64::from(k), 14.0, 0.0, 0.0, 0.0];
//!     let places = [vec![first; rows], vec![[24.0, 14.0, 0.0, 0.0, 1.5]; rows]];
//!     let file = json!({"format": "phase-events/1", "events": [{"id": k.to_string(), "layout": {"base": 0},
//!         "agents": [agent(1), agent(-1)], "objects": [], "event": kind,
//!         "trajectory": {"columns": ["x", "y", "vx", "vy", "angle"], "objects": [], "agents": places}}]});
//!     items.extend(phase_event::from_json(&file.to_string())?.iter().map(AuditItem::of));
//! }
//! let audit = audit(&items, 60).ok_or("too few events")?;
//! let length = audit.rows.iter().find(|row| row.feature == Feature::Length).ok_or("no such row")?;
//! assert_eq!(audit.majorities[Target::Kind as usize], 0.5);
//! assert_eq!(length.accuracies[Target::Kind as usize], 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod features;
mod folds;
mod forest;
mod report;
mod target;

pub use features::{AuditItem, Feature, FirstFrame};
pub use report::{Audit, AuditRow, MAX_EVENTS, audit, cross_validated, summary, table};
pub use target::Target;
