//! The numbers of scenes that were tried for a dataset, as a table.

use phase_dataset::acceptance::Acceptance;

/// The counts as a table in Markdown.
#[must_use]
pub fn table(rows: &[Acceptance]) -> String {
    let mut text = String::from(
        "| kind | variant | events | scenes tried | accepted | refused for |\n|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let mut reasons: Vec<(usize, &str)> =
            row.refused.iter().map(|(reason, &count)| (count, reason.name())).collect();
        reasons.sort_by_key(|&(count, name)| (core::cmp::Reverse(count), name));
        let reasons: Vec<String> = reasons.iter().map(|(count, name)| format!("{name} {count}")).collect();
        text += &format!(
            "| {} | {} | {} | {} | {:.0} % | {} |\n",
            row.variant.kind().name(),
            row.variant.name(),
            row.events,
            row.attempts,
            100.0 * row.events as f64 / row.attempts.max(1) as f64,
            if reasons.is_empty() { "–".into() } else { reasons.join(", ") }
        );
    }
    text
}
