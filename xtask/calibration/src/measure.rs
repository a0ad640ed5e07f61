//! Comparison of an engine with many recordings.

use crate::{
    Deviation, Engine, ErrorQuantiles, FamilyReport, HorizonErrors, Probe, ProbeErrors, ProbeReport,
    ProbesReport, Replay, Run, RunReport, SubstepReport, family, report::columns,
};
use std::collections::BTreeMap;

/// Replays all probes.
#[must_use]
pub fn probes_report<E: Engine>(probes: &[Probe]) -> ProbesReport {
    let mut families: BTreeMap<&str, Vec<ProbeErrors>> = BTreeMap::new();
    let mut each = Vec::with_capacity(probes.len());
    for probe in probes {
        let followed = probe.follow::<E>();
        let family = family(&probe.name);
        each.extend(probe_report(&probe.name, family, &followed));
        families.entry(family).or_default().push(followed);
    }
    let families = families.into_iter();
    let families = families.filter_map(|(name, all)| Some((name.to_owned(), family_report(&all)?)));
    ProbesReport { n: probes.len(), families: families.collect(), each }
}

/// Simulates all runs freely from their starts.
#[must_use]
pub fn run_reports<E: Engine>(runs: &[Run]) -> Vec<RunReport> {
    let report = |run: &Run| {
        let (deviations, mismatches) = run.follow::<E>(0, usize::MAX);
        RunReport::of(&run.name, &deviations, Some(mismatches))
    };
    runs.iter().filter_map(report).collect()
}

/// Simulates measured recordings freely from their starts.
#[must_use]
pub fn replay_reports<E: Engine>(replays: &[Replay]) -> Vec<RunReport> {
    replays.iter().filter_map(|replay| RunReport::of(&replay.id, &replay.follow::<E>(), None)).collect()
}

/// Restarts all runs from every state with at least the given number of steps after it, and takes the
/// position error after the last of these. `None` if no run is long enough.
#[must_use]
pub fn horizon_errors<E: Engine>(runs: &[Run], steps: usize) -> Option<HorizonErrors> {
    let starts = |run: &Run| 0..(run.states.len()).saturating_sub(steps);
    let last = |run: &Run, start| Some(run.follow::<E>(start, steps).0.last()?.position);
    let errors = runs.iter().flat_map(|run| starts(run).filter_map(move |start| last(run, start)));
    HorizonErrors::of(&errors.collect::<Vec<f32>>())
}

fn probe_report(name: &str, family: &str, followed: &ProbeErrors) -> Option<ProbeReport> {
    let (positions, angles) = columns(&followed.steps);
    Some(ProbeReport {
        name: name.into(),
        family: family.into(),
        steps: positions.len(),
        start: followed.start,
        position: ErrorQuantiles::of(&positions)?,
        angle: ErrorQuantiles::of(&angles)?,
        grip_mismatches: followed.grip_mismatches,
    })
}

fn family_report(all: &[ProbeErrors]) -> Option<FamilyReport> {
    let pooled = |of: fn(&ProbeErrors) -> &[Deviation]| all.iter().flat_map(of).copied().collect::<Vec<_>>();
    let steps = pooled(|followed| &followed.steps);
    let substeps = pooled(|followed| &followed.substeps);
    let (positions, angles) = columns(&steps);
    let (substep_positions, substep_angles) = columns(&substeps);
    Some(FamilyReport {
        n: all.len(),
        steps: steps.len(),
        position: ErrorQuantiles::of(&positions)?,
        angle: ErrorQuantiles::of(&angles)?,
        within_0_01: share_within(&steps, 0.01),
        within_0_1: share_within(&steps, 0.1),
        substeps: SubstepReport {
            position: ErrorQuantiles::of(&substep_positions)?,
            angle: ErrorQuantiles::of(&substep_angles)?,
        },
        grip_mismatches: all.iter().map(|followed| followed.grip_mismatches).sum(),
    })
}

/// Share of moments at which position (u) and angle (rad) are both within a limit.
fn share_within(deviations: &[Deviation], limit: f32) -> f64 {
    let within = deviations.iter().filter(|it| it.position <= limit && it.angle <= limit);
    within.count() as f64 / deviations.len().max(1) as f64
}
