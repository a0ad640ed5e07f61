//! Results, ready to be written as JSON. Positions are in u, angles in rad; non-finite values are null.

use crate::{Deviation, ErrorQuantiles};
use phase_statistics::percentile;
use serde::Serialize;
use std::collections::BTreeMap;

/// Maximum error up to which an engine counts as following a run (u).
pub(crate) const TRACKING_TOLERANCE: f32 = 0.5;

/// All measurements of one engine. Those not requested are absent.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Report {
    /// The engine's name.
    pub engine: String,
    /// Errors on probes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probes: Option<ProbesReport>,
    /// Errors on runs, simulated freely from their start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runs: Option<Vec<RunReport>>,
    /// Errors on measured recordings, simulated freely from their start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replays: Option<Vec<RunReport>>,
    /// Errors one step after a restart from each recorded state of the runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one_step: Option<HorizonErrors>,
    /// Errors ten steps after a restart from each recorded state of the runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ten_steps: Option<HorizonErrors>,
    /// The last two for an engine without its internal memory, where it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state_alone: Option<StatelessErrors>,
}

/// Errors on probes.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ProbesReport {
    /// Number of probes.
    pub n: usize,
    /// Their families, by name.
    pub families: BTreeMap<String, FamilyReport>,
    /// Every probe.
    pub each: Vec<ProbeReport>,
}

/// Errors after all steps of all probes of a family.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct FamilyReport {
    /// Number of probes.
    pub n: usize,
    /// Number of steps in them.
    pub steps: usize,
    /// Position errors (u).
    pub position: ErrorQuantiles,
    /// Angle errors (rad).
    pub angle: ErrorQuantiles,
    /// Share of steps within 0.01 u and 0.01 rad.
    pub within_0_01: f64,
    /// Share of steps within 0.1 u and 0.1 rad.
    pub within_0_1: f64,
    /// Errors after all substeps.
    pub substeps: SubstepReport,
    /// Steps after which an agent's grip differs from the recorded one.
    pub grip_mismatches: usize,
}

/// Errors after substeps.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct SubstepReport {
    /// Position errors (u).
    pub position: ErrorQuantiles,
    /// Angle errors (rad).
    pub angle: ErrorQuantiles,
}

/// Errors on one probe.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ProbeReport {
    /// Its name.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Number of steps.
    pub steps: usize,
    /// Error after the engine's own idle substep, before the first step.
    pub start: Deviation,
    /// Position errors after steps (u).
    pub position: ErrorQuantiles,
    /// Angle errors after steps (rad).
    pub angle: ErrorQuantiles,
    /// Steps after which an agent's grip differs from the recorded one.
    pub grip_mismatches: usize,
}

/// Errors on one run or measured recording.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct RunReport {
    /// Its name or id.
    pub id: String,
    /// Number of steps.
    pub steps: usize,
    /// Position errors (u).
    pub position: ErrorQuantiles,
    /// Angle errors (rad).
    pub angle: ErrorQuantiles,
    /// Steps before the first whose position error exceeds 0.5 u.
    pub steps_within_0_5: usize,
    /// Position error after each step (u).
    pub position_by_step: Vec<f32>,
    /// Steps after which an agent's grip differs from the recorded one; absent where grips are not recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grip_mismatches: Option<usize>,
}

/// Position errors some steps after restarts (u).
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct HorizonErrors {
    /// Number of restarts.
    pub n: usize,
    /// 50th percentile.
    pub median: f32,
    /// 90th percentile.
    pub p90: f32,
    /// 99th percentile.
    pub p99: f32,
}

/// Errors after restarts of an engine that is given only a state before every step.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct StatelessErrors {
    /// After one step.
    pub one_step: Option<HorizonErrors>,
    /// After ten steps.
    pub ten_steps: Option<HorizonErrors>,
}

impl RunReport {
    /// From the errors after each step; `None` for no steps.
    #[must_use]
    pub fn of(id: &str, deviations: &[Deviation], grip_mismatches: Option<usize>) -> Option<Self> {
        let (positions, angles) = columns(deviations);
        let lost = positions.iter().position(|error| *error > TRACKING_TOLERANCE);
        Some(Self {
            id: id.into(),
            steps: positions.len(),
            position: ErrorQuantiles::of(&positions)?,
            angle: ErrorQuantiles::of(&angles)?,
            steps_within_0_5: lost.unwrap_or(positions.len()),
            position_by_step: positions,
            grip_mismatches,
        })
    }
}

impl HorizonErrors {
    /// Of some position errors; `None` for none.
    #[must_use]
    pub fn of(errors: &[f32]) -> Option<Self> {
        let [median, p90, p99] = [50, 90, 99].map(|hundredths| percentile(errors, hundredths));
        Some(Self { n: errors.len(), median: median?, p90: p90?, p99: p99? })
    }
}

/// Position errors and angle errors.
pub(crate) fn columns(deviations: &[Deviation]) -> (Vec<f32>, Vec<f32>) {
    deviations.iter().map(|deviation| (deviation.position, deviation.angle)).unzip()
}
