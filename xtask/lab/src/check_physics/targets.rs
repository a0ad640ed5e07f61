//! The published targets of both engines, and whether they are met.

use phase_calibration::{HorizonErrors, Report, RunReport};
use phase_statistics::percentile;
use serde::Serialize;

/// One target and what was measured.
#[derive(Serialize)]
pub(super) struct Target {
    /// Name of the measure, such as `wall: steps within 0.1 u and 0.1 rad`.
    pub(super) what: String,
    /// The measured value.
    pub(super) measured: f32,
    /// The upper or lower limit.
    limit: f32,
    /// Whether the limit is a lower limit.
    at_least: bool,
    /// Whether it is met; NaN meets nothing.
    pub(super) met: bool,
}

/// Families of which the world must keep nine in ten steps within a limit (u and rad).
const WORLD_FINE: [&str; 4] = ["free", "coast", "turn", "stop"];
const WORLD_COARSE: [&str; 5] = ["wall", "push", "grab", "carry", "collide"];
/// Families of which the world must keep the 90th percentile of positions within 0.05 u.
const WORLD_PERCENTILE: [&str; 2] = ["tug", "push_off_centre"];
/// Families whose 90th percentile the kernel must keep within 0.02 u instead of 0.005 u.
const FORWARD_LOOSE: [&str; 2] = ["carry", "items_collide"];

impl Target {
    fn at_most(what: impl Into<String>, measured: f32, limit: f32) -> Self {
        Self { what: what.into(), measured, limit, at_least: false, met: measured <= limit }
    }

    fn at_least(what: impl Into<String>, measured: f64, limit: f32) -> Self {
        let measured = measured as f32;
        Self { what: what.into(), measured, limit, at_least: true, met: measured >= limit }
    }

    /// The limit in words.
    pub(super) fn rule(&self) -> String {
        format!("{} {}", if self.at_least { ">=" } else { "<=" }, self.limit)
    }
}

/// Targets of the reference world, as far as they were measured.
pub(super) fn of_world(report: &Report) -> Vec<Target> {
    let mut targets = Vec::new();
    for (name, family) in report.probes.iter().flat_map(|probes| &probes.families) {
        let name = name.as_str();
        if WORLD_FINE.contains(&name) {
            let what = format!("{name}: share of steps within 0.01 u and 0.01 rad");
            targets.push(Target::at_least(what, family.within_0_01, 0.9));
        } else if WORLD_COARSE.contains(&name) {
            let what = format!("{name}: share of steps within 0.1 u and 0.1 rad");
            targets.push(Target::at_least(what, family.within_0_1, 0.9));
        } else if WORLD_PERCENTILE.contains(&name) {
            targets.push(Target::at_most(format!("{name}: p90 (u)"), family.position.p90, 0.05));
        }
    }
    if let Some(ahead) = report.one_step {
        targets.push(Target::at_most("one step ahead on runs: p90 (u)", ahead.p90, 0.03));
        targets.push(Target::at_most("one step ahead on runs: p99 (u)", ahead.p99, 0.25));
    }
    targets
}

/// Targets of the kernel, as far as they were measured.
pub(super) fn of_forward(report: &Report) -> Vec<Target> {
    let mut targets = Vec::new();
    for (name, family) in report.probes.iter().flat_map(|probes| &probes.families) {
        let limit = if FORWARD_LOOSE.contains(&name.as_str()) { 0.02 } else { 0.005 };
        targets.push(Target::at_most(format!("{name}: p90 (u)"), family.position.p90, limit));
    }
    if let Some(replays) = &report.replays {
        let steps = |of: fn(&RunReport) -> usize| replays.iter().map(of).sum::<usize>() as f64;
        let followed = steps(|replay| replay.steps_within_0_5) / steps(|replay| replay.steps).max(1.0);
        targets.push(Target::at_least(
            "replays: share of steps before any error exceeds 0.5 u",
            followed,
            1.0,
        ));
        let errors: Vec<f32> = replays.iter().flat_map(|replay| replay.position_by_step.clone()).collect();
        let p90 = percentile(&errors, 90).unwrap_or(f32::NAN);
        targets.push(Target::at_most("replays: p90 over all steps (u)", p90, 0.02));
    }
    let ahead = |what: &str, ahead: Option<HorizonErrors>, limit| {
        ahead.map(|ahead| Target::at_most(format!("{what} ahead on runs: p90 (u)"), ahead.p90, limit))
    };
    targets.extend(ahead("one step", report.one_step, 0.002));
    targets.extend(ahead("ten steps", report.ten_steps, 0.02));
    targets
}
