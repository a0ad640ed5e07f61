//! Subsets of kinds that are alike in low-level motion.

use pathfinding::{kuhn_munkres::kuhn_munkres_min, matrix::Matrix};
use phase_statistics::{mean, standard_deviation};
use serde::Serialize;
use thiserror::Error;

/// Why kinds cannot be matched.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum MatchError {
    /// There is nothing to match with.
    #[error("matching needs events of two kinds at least; all are {0}")]
    OneKind(String),
    /// A value is not a number.
    #[error("{id}: its {measure} is not finite")]
    NotFinite {
        /// The event.
        id: String,
        /// The measure.
        measure: String,
    },
}

/// An event with what it is matched on.
#[derive(Clone, PartialEq, Debug)]
pub struct Candidate {
    /// Its id.
    pub id: String,
    /// Its kind.
    pub kind: String,
    /// Its measures, as many as there are names.
    pub measures: Vec<f64>,
}

/// Mean and standard deviation of a measure in a kind, and how many events they are of.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Balance {
    /// The measure.
    pub measure: String,
    /// The kind.
    pub kind: String,
    /// Events before and after matching.
    pub events: [usize; 2],
    /// Mean before and after; null without events.
    pub mean: [Option<f64>; 2],
    /// Standard deviation before and after; null with fewer than two events.
    pub sd: [Option<f64>; 2],
}

/// The greatest difference of a measure between two kinds.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Difference {
    /// The measure.
    pub measure: String,
    /// Greatest difference of two kinds' means before and after, in standard deviations of all events before.
    pub standardised: [Option<f64>; 2],
}

/// Groups of one event of each kind.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Matched {
    /// The kinds, in the order of the groups' members.
    pub kinds: Vec<String>,
    /// The groups, each an event id of every kind, most alike first.
    pub groups: Vec<Vec<String>>,
    /// Every measure in every kind.
    pub balance: Vec<Balance>,
    /// Differences before and after.
    pub differences: Vec<Difference>,
}

/// Matches events: every group has one event of each kind, and no two of its events differ in a measure by
/// more than `caliper` standard deviations (of all events).
///
/// One kind is the reference. For every other kind the assignment of its events to those of the reference
/// with the least sum of squared standardised distances is found exactly (Kuhn–Munkres); groups that exceed
/// the caliper are dropped, as in matching several treatment groups to a common one (Lopez and Gutman 2017).
/// Every kind is tried as the reference, and the one with most groups is taken, of equal ones that with the
/// least sum. A measure that is the same for all events is ignored.
///
/// # Errors
/// [`MatchError`].
pub fn matched(names: &[String], events: &[Candidate], caliper: f64) -> Result<Matched, MatchError> {
    for event in events {
        if let Some(k) = event.measures.iter().position(|value| !value.is_finite()) {
            return Err(MatchError::NotFinite { id: event.id.clone(), measure: names[k].clone() });
        }
    }
    let mut kinds: Vec<String> = Vec::new();
    for event in events {
        if !kinds.contains(&event.kind) {
            kinds.push(event.kind.clone());
        }
    }
    if kinds.len() < 2 {
        return Err(MatchError::OneKind(kinds.pop().unwrap_or_else(|| "absent".into())));
    }
    let scales: Vec<f64> = (0..names.len())
        .map(|k| {
            standard_deviation(&column(events.iter(), k)).filter(|sd| *sd > 0.0).unwrap_or(f64::INFINITY)
        })
        .collect();
    let best = (0..kinds.len())
        .map(|reference| groups(&kinds, reference, events, &scales, caliper))
        .reduce(|best, next| {
            let better = (next.len(), -total(&next)) > (best.len(), -total(&best));
            if better { next } else { best }
        })
        .unwrap_or_default();
    let kept: Vec<&Candidate> =
        best.iter().flat_map(|(members, _)| members.iter().map(|&k| &events[k])).collect();
    let mut balance = Vec::new();
    let mut differences = Vec::new();
    for (k, measure) in names.iter().enumerate() {
        let mut means = [Vec::new(), Vec::new()];
        for kind in &kinds {
            let of = |all: &[&Candidate]| -> Vec<f64> {
                column(all.iter().copied().filter(|event| event.kind == *kind), k)
            };
            let values = [of(&events.iter().collect::<Vec<_>>()), of(&kept)];
            let both = [mean(&values[0]), mean(&values[1])];
            for (means, mean) in means.iter_mut().zip(both) {
                means.extend(mean);
            }
            balance.push(Balance {
                measure: measure.clone(),
                kind: kind.clone(),
                events: [values[0].len(), values[1].len()],
                mean: both,
                sd: [standard_deviation(&values[0]), standard_deviation(&values[1])],
            });
        }
        let spread = |means: &Vec<f64>| {
            let low = means.iter().copied().reduce(f64::min)?;
            let high = means.iter().copied().reduce(f64::max)?;
            Some(if scales[k].is_finite() { (high - low) / scales[k] } else { 0.0 })
        };
        differences.push(Difference {
            measure: measure.clone(),
            standardised: [spread(&means[0]), spread(&means[1])],
        });
    }
    let groups = best.into_iter().map(|(members, _)| members.iter().map(|&k| events[k].id.clone()).collect());
    Ok(Matched { groups: groups.collect(), kinds, balance, differences })
}

fn column<'a>(events: impl Iterator<Item = &'a Candidate>, k: usize) -> Vec<f64> {
    events.map(|event| event.measures[k]).collect()
}

fn total(groups: &[(Vec<usize>, f64)]) -> f64 {
    groups.iter().map(|(_, cost)| cost).sum()
}

/// Indices of the members of each group, in the order of kinds, with the group's sum of squared distances.
fn groups(
    kinds: &[String],
    reference: usize,
    events: &[Candidate],
    scales: &[f64],
    caliper: f64,
) -> Vec<(Vec<usize>, f64)> {
    let of =
        |kind: &String| -> Vec<usize> { (0..events.len()).filter(|&k| events[k].kind == *kind).collect() };
    let apart = |a: usize, b: usize| {
        let pairs = events[a].measures.iter().zip(&events[b].measures).zip(scales);
        pairs.map(|((a, b), scale)| (a - b) / scale).collect::<Vec<f64>>()
    };
    let squared = |a: usize, b: usize| apart(a, b).iter().map(|d| d * d).sum::<f64>();
    let references = of(&kinds[reference]);
    let mut members: Vec<Vec<Option<usize>>> = references.iter().map(|_| vec![None; kinds.len()]).collect();
    for (kind, name) in kinds.iter().enumerate() {
        let own = of(name);
        let pairs: Vec<(usize, usize)> = if kind == reference {
            (0..own.len()).map(|k| (k, k)).collect()
        } else {
            assign(references.len(), own.len(), |a, b| squared(references[a], own[b]))
        };
        for (a, b) in pairs {
            members[a][kind] = Some(own[b]);
        }
    }
    let whole = members.into_iter().filter_map(|members| members.into_iter().collect::<Option<Vec<usize>>>());
    let pairs = |members: &[usize]| -> Vec<(usize, usize)> {
        (0..members.len())
            .flat_map(|k| members[k + 1..].iter().map(move |&b| (k, b)))
            .map(|(k, b)| (members[k], b))
            .collect()
    };
    let close = |members: &Vec<usize>| {
        pairs(members).iter().all(|&(a, b)| apart(a, b).iter().all(|difference| difference.abs() <= caliper))
    };
    let mut groups: Vec<(Vec<usize>, f64)> = whole
        .filter(close)
        .map(|members| {
            let cost = pairs(&members).iter().map(|&(a, b)| squared(a, b)).sum();
            (members, cost)
        })
        .collect();
    groups.sort_by(|a, b| a.1.total_cmp(&b.1));
    groups
}

/// Parts of a standard deviation, squared, in which the assignment counts.
const RESOLUTION: f64 = 1e6;
/// Squared distances beyond this are equally bad, so that sums of them stay whole numbers.
const FARTHEST: f64 = 1e6;

/// The pairs (row, column) of the cheapest assignment in which every row or every column has a partner.
fn assign(rows: usize, columns: usize, cost: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize)> {
    if rows == 0 || columns == 0 {
        return Vec::new();
    }
    let whole = |cost: f64| (cost.min(FARTHEST) * RESOLUTION) as i64;
    // The algorithm wants no more rows than columns.
    if rows <= columns {
        let matrix = Matrix::from_fn(rows, columns, |(row, column)| whole(cost(row, column)));
        kuhn_munkres_min(&matrix).1.into_iter().enumerate().collect()
    } else {
        let matrix = Matrix::from_fn(columns, rows, |(column, row)| whole(cost(row, column)));
        kuhn_munkres_min(&matrix).1.into_iter().enumerate().map(|(column, row)| (row, column)).collect()
    }
}
