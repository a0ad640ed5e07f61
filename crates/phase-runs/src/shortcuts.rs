//! The shortcut audit of a dataset or of other events: what a standard classifier tells without looking at
//! motion.

use crate::{
    error::RunError,
    listener::{Listener, Silent},
    parallel::{self, make_all},
    source::EventInput,
    words,
};
use phase_audit::{Audit, AuditItem, MAX_EVENTS, Target, audit};
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};

/// Greatest excess of a benchmark's motion-free features over the most frequent class in telling a label (0
/// to 1).
const MAX_EXCESS: f64 = 0.06;

/// Audits the events of a file or folder; `None` if they are too few.
///
/// # Errors
/// If an event cannot be used; [`RunError::Threads`].
pub fn audited(
    path: &Path,
    threads: Option<usize>,
    listener: &dyn Listener,
) -> Result<Option<Audit>, RunError> {
    // Warnings about events have been printed by whoever read them first.
    let source = EventInput::open(path, &[], &Silent)?;
    let count = source.len().min(MAX_EVENTS);
    let progress = listener.progress_over(&format!("auditing {}", words::events(count)), count);
    let items = make_all(parallel::threads(threads), count, |index| {
        let item = AuditItem::of(source.load(index)?.as_ref());
        progress.steps(1);
        Ok(Some(item))
    })?;
    drop(progress);
    Ok(audit(&items.unwrap_or_default(), source.len()))
}

/// The section about shortcuts of a report.
#[must_use]
pub fn section(audit: Option<&Audit>, events: usize) -> String {
    match audit {
        Some(audit) => {
            let some = if audit.events < audit.of {
                format!(" (the first {})", audit.events)
            } else {
                String::new()
            };
            format!("\n{}{some}.\n\n{}", capital(&phase_audit::summary(audit)), phase_audit::table(audit))
        }
        None => {
            let are = if events == 1 { "is" } else { "are" };
            format!("\nNo shortcut audit: {} {are} too few.\n", words::events(events))
        }
    }
}

/// Whether the motion-free features reveal more than a benchmark can afford, in a sentence of `verify`.
#[must_use]
pub fn verdict(audit: &Audit) -> String {
    let labels = [Target::Relation, Target::Kind, Target::Knowledge];
    let excess = labels.map(|target| audit.excess(target)).into_iter().fold(0.0, f64::max);
    let warning = if excess > MAX_EXCESS {
        format!(
            "; that is more than {MAX_EXCESS} above the most frequent class: length, bodies or layout reveal the labels"
        )
    } else {
        String::new()
    };
    format!("\n{}{warning}", phase_audit::summary(audit))
}

/// The audit for programs: accuracies by features and target.
#[must_use]
pub fn value(audit: &Audit) -> Value {
    let named = |shares: &[f64]| {
        let told = audit.targets().map(|target| (target.name(), shares[target as usize]));
        told.collect::<BTreeMap<_, _>>()
    };
    let rows: BTreeMap<&str, _> =
        audit.rows.iter().map(|row| (row.feature.name(), named(&row.accuracies))).collect();
    json!({ "events": audit.events, "majority": named(&audit.majorities), "told_from": rows })
}

fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
