//! The columns of a dataset as features of the `datasets` library, for the front matter of its card.
//!
//! With them `load_dataset` gives classes instead of strings for kind, relation and split, and lists of fixed
//! lengths where lengths are fixed.

use phase_dataset::{
    parquet::{self, Description},
    splits::Split,
};
use phase_model::{EventKind, Relation};

/// The features in YAML, indented for `dataset_info`.
pub(crate) fn features() -> String {
    let feature = |column: Description| {
        let names = classes(column.name);
        let kind =
            if names.is_empty() { list(&dimensions(column.shape), column.kind, 2) } else { class(&names) };
        format!("  - name: {}\n{kind}", column.name)
    };
    format!(
        "dataset_info:\n  features:\n{}",
        parquet::descriptions().into_iter().map(feature).collect::<String>()
    )
}

/// The names of a column's classes, in order; none for other columns.
fn classes(column: &str) -> Vec<&'static str> {
    match column {
        "kind" => EventKind::ALL.into_iter().map(EventKind::name).collect(),
        "relation" => {
            [Relation::Friendly, Relation::Neutral, Relation::Adversarial].map(Relation::name).to_vec()
        }
        "split" => Split::ALL.into_iter().map(Split::name).collect(),
        _ => Vec::new(),
    }
}

fn class(names: &[&str]) -> String {
    let lines = names.iter().enumerate().map(|(k, name)| format!("          '{k}': {name}\n"));
    format!("    dtype:\n      class_label:\n        names:\n{}", lines.collect::<String>())
}

/// Whether each dimension of a shape such as `[steps, 2]` is fixed, and its length then.
fn dimensions(shape: &str) -> Vec<Option<usize>> {
    let inner = shape.trim_start_matches('[').trim_end_matches(']');
    inner.split(", ").filter(|part| !part.is_empty()).map(|part| part.parse().ok()).collect()
}

/// Nested lists, the outermost first; `depth` is the indentation in steps of two.
fn list(dimensions: &[Option<usize>], kind: &str, depth: usize) -> String {
    let indent = "  ".repeat(depth);
    let Some((length, inner)) = dimensions.split_first() else { return format!("{indent}dtype: {kind}\n") };
    let of =
        if inner.is_empty() { format!(" {kind}\n") } else { format!("\n{}", list(inner, kind, depth + 1)) };
    let length = length.map_or_else(String::new, |length| format!("{indent}length: {length}\n"));
    format!("{indent}list:{of}{length}")
}
