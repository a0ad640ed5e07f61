//! `fit-selection`: measures in recordings what selection limits, and how two part who get nowhere.
//!
//! A limit of selection is fitted if it keeps nine of ten recordings. The numbers of contests
//! ([`PhaseParameters::patience`] and [`respite`](PhaseParameters::respite)) are medians of durations, by the
//! estimate of Kaplan and Meier, since events end before some durations do.

use crate::{check_minds, error::LabError};
use clap::Args;
use phase_cli::{context::Context, json_file::JsonFile};
use phase_evidence::{
    clarity::{self, Duration},
    selection::{Limit, Quantity},
};
use phase_minds::PhaseParameters;
use phase_model::EventKind;
use phase_runs::source;
use phase_statistics::percentile;
use serde::Serialize;
use std::path::PathBuf;

/// Options of `fit-selection`.
#[derive(Args, Debug)]
pub struct FitSelection {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(long, value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// The report as JSON.
    #[command(flatten)]
    pub json: JsonFile,
}

/// The report of the command.
#[derive(Serialize, Debug)]
struct Report {
    limits: Vec<LimitRow>,
    contests: Vec<ContestRow>,
}

/// A quantity that selection limits, in all events that have it.
#[derive(Serialize, Debug)]
struct LimitRow {
    quantity: &'static str,
    events: usize,
    least: f32,
    median: f32,
    greatest: f32,
    /// The limit that keeps nine of ten of these events.
    fitted: f32,
    in_effect: f32,
    /// Share of the events within the limit in effect.
    kept: f32,
}

/// A duration in contests.
#[derive(Serialize, Debug)]
struct ContestRow {
    parameter: &'static str,
    durations: usize,
    /// Those that last to the end of their event.
    cut: usize,
    /// The least and the greatest median (steps); `None` if too many are cut for one.
    fitted: [Option<usize>; 2],
    in_effect: u16,
}

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files.
pub fn run(arguments: &FitSelection, context: &Context) -> Result<(), LabError> {
    arguments.json.check([&arguments.events])?;
    let recordings = check_minds::recordings(&arguments.events, &[], None, context)?;
    let mut values = vec![Vec::new(); Quantity::ALL.len()];
    let mut standstills = Vec::new();
    for recording in &recordings {
        let (scene, track) = (&recording.scene, source::track(recording));
        for (quantity, values) in Quantity::ALL.into_iter().zip(&mut values) {
            values.extend(quantity.of(scene, &track));
        }
        if scene.kind == EventKind::Competing {
            standstills.extend(clarity::standstills(scene, &track));
        }
    }
    let minds = PhaseParameters::default();
    let stand: Vec<Duration> = standstills.iter().map(|it| it.duration).collect();
    let kept_off: Vec<Duration> = standstills.iter().filter_map(|it| it.kept_off).collect();
    let report = Report {
        limits: Quantity::ALL.into_iter().zip(&values).filter_map(|(it, of)| LimitRow::of(it, of)).collect(),
        contests: vec![
            ContestRow::of("patience_steps", &stand, minds.patience),
            ContestRow::of("respite_steps", &kept_off, minds.respite),
        ],
    };
    Ok(arguments.json.print(&report, report.table())?)
}

impl LimitRow {
    /// A row of values, of which there has to be one at least.
    fn of(quantity: Quantity, values: &[f32]) -> Option<Self> {
        let limit = quantity.limit();
        let (in_effect, hundredths) = match limit {
            Limit::AtLeast(least) => (least, 10),
            Limit::AtMost(most) => (most, 90),
        };
        let kept = values.iter().filter(|&&value| limit.keeps(value)).count();
        Some(Self {
            quantity: quantity.name(),
            events: values.len(),
            least: percentile(values, 0)?,
            median: percentile(values, 50)?,
            greatest: percentile(values, 100)?,
            fitted: percentile(values, hundredths)?,
            in_effect,
            kept: kept as f32 / values.len() as f32,
        })
    }
}

impl ContestRow {
    fn of(parameter: &'static str, durations: &[Duration], in_effect: u16) -> Self {
        Self {
            parameter,
            durations: durations.len(),
            cut: durations.iter().filter(|it| it.is_cut).count(),
            fitted: medians(durations),
            in_effect,
        }
    }
}

/// The least and the greatest median of durations, of which some are cut: where the estimate of Kaplan and
/// Meier for the share that lasts longer falls to a half, and where it falls below it.
fn medians(durations: &[Duration]) -> [Option<usize>; 2] {
    let mut sorted = durations.to_vec();
    // Of equals, those that are cut last longer.
    sorted.sort_by_key(|it| (it.steps, it.is_cut));
    // In whole numbers, since the share may be a half exactly: numerator and denominator of the estimate.
    let (mut lasting, mut all) = (1_u128, 1_u128);
    let mut medians = [None; 2];
    for (k, duration) in sorted.iter().enumerate().filter(|(_, it)| !it.is_cut) {
        let at_risk = (sorted.len() - k) as u128;
        (lasting, all) = reduced(lasting * (at_risk - 1), all * at_risk);
        if 2 * lasting <= all {
            medians[0] = medians[0].or(Some(duration.steps));
        }
        if 2 * lasting < all {
            medians[1] = medians[1].or(Some(duration.steps));
        }
    }
    medians
}

/// A fraction in its lowest terms.
fn reduced(numerator: u128, denominator: u128) -> (u128, u128) {
    let (mut a, mut b) = (denominator, numerator);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    (numerator / a, denominator / a)
}

impl Report {
    fn table(&self) -> String {
        let mut text = format!("{:<20}", "limit");
        for head in ["events", "least", "median", "greatest", "fitted", "in effect", "kept"] {
            text += &format!("{head:>10}");
        }
        for row in &self.limits {
            text += &format!("\n{:<20}{:>10}", row.quantity, row.events);
            for value in [row.least, row.median, row.greatest, row.fitted, row.in_effect] {
                text += &format!("{value:>10.2}");
            }
            text += &format!("{:>8.0} %", 100.0 * row.kept);
        }
        text += &format!("\n\n{:<20}", "contest");
        for head in ["durations", "cut", "fitted", "in effect"] {
            text += &format!("{head:>10}");
        }
        for row in &self.contests {
            let median = |it: Option<usize>| it.map_or_else(|| "-".to_owned(), |steps| steps.to_string());
            let fitted = match row.fitted {
                [least, greatest] if least == greatest => median(least),
                [least, greatest] => format!("{} to {}", median(least), median(greatest)),
            };
            text += &format!(
                "\n{:<20}{:>10}{:>10}{fitted:>10}{:>10}",
                row.parameter, row.durations, row.cut, row.in_effect
            );
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, medians};

    #[test]
    fn medians_are_those_of_kaplan_and_meier() {
        let of = |all: &[(usize, bool)]| {
            medians(&all.iter().map(|&(steps, is_cut)| Duration { steps, is_cut }).collect::<Vec<_>>())
        };
        // Without cuts they are the two central values.
        let whole = [5, 1, 9, 3].map(|steps| (steps, false));
        assert_eq!(of(&whole), [Some(3), Some(5)]);
        assert_eq!(of(&whole[..3]), [Some(5), Some(5)]);
        // Of seven, 6/7 last longer than 6 weeks, 9/14 than 13, 9/28 than 21.
        let weeks = [(6, false), (8, true), (13, false), (19, true), (21, false), (30, false)];
        let weeks: Vec<_> = [(10, true)].into_iter().chain(weeks).collect();
        assert_eq!(of(&weeks), [Some(21), Some(21)]);
        assert_eq!(of(&[(4, true), (5, true)]), [None, None]);
    }
}
