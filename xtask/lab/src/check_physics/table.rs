//! A report for people.

use super::targets::Target;
use phase_calibration::{HorizonErrors, Report, RunReport};
use std::fmt::Write;

/// The tables of a report.
pub(super) fn print(report: &Report, targets: &[Target], mirrored: usize) -> String {
    let mut text = format!("engine: {} (positions in u, angles in rad)\n", report.engine);
    // Writing into a string cannot fail.
    let _ = sections(&mut text, report, targets, mirrored);
    text
}

fn sections(text: &mut String, report: &Report, targets: &[Target], mirrored: usize) -> std::fmt::Result {
    if let Some(probes) = &report.probes {
        writeln!(text, "\n{} probes, errors after each step", probes.n)?;
        writeln!(
            text,
            "{:<16} {:>6} {:>5}  {:^26}  {:^26}  {:>11} {:>11}  wrong",
            "family",
            "probes",
            "steps",
            "position p50/p90/max",
            "angle p50/p90/max",
            "within 0.01",
            "within 0.1"
        )?;
        for (name, it) in &probes.families {
            let position = it.position;
            let angle = it.angle;
            writeln!(
                text,
                "{name:<16} {:>6} {:>5}  {:>8.5} {:>8.5} {:>8.5}  {:>8.5} {:>8.5} {:>8.5}  {:>11.3} {:>11.3}  {:>5}",
                it.n,
                it.steps,
                position.median,
                position.p90,
                position.max,
                angle.median,
                angle.p90,
                angle.max,
                it.within_0_01,
                it.within_0_1,
                it.grip_mismatches,
            )?;
        }
        let worst = probes.each.iter().map(|probe| probe.start.position).fold(0.0, f32::max);
        writeln!(text, "idle substep before the first step, which parts overlaps: worst error {worst:.5} u")?;
        writeln!(
            text,
            "within: share of steps within so many u and rad; wrong: steps after which a grip differs"
        )?;
    }
    if let Some(runs) = &report.runs {
        writeln!(text, "\n{} runs, followed freely from their start (chaotic in the long run)", runs.len())?;
        run_rows(text, runs)?;
    }
    if let Some(replays) = &report.replays {
        writeln!(
            text,
            "\n{} real recordings, followed freely; rows are means over five substeps",
            replays.len()
        )?;
        run_rows(text, replays)?;
        writeln!(text, "not restarted within: a mean over five substeps is no state to start from")?;
        if mirrored > 0 {
            writeln!(text, "{mirrored} mirrored left out: their row 0 lies within the first step")?;
        }
    }
    if report.runs.is_some() {
        writeln!(text, "\nposition errors after a restart from each recorded state of the runs")?;
        writeln!(text, "{:<28} {:>6}  {:>9} {:>9} {:>9}", "", "starts", "p50", "p90", "p99")?;
        ahead_row(text, "one step", report.one_step)?;
        ahead_row(text, "ten steps", report.ten_steps)?;
        if let Some(alone) = report.state_alone {
            ahead_row(text, "one step, state alone", alone.one_step)?;
            ahead_row(text, "ten steps, state alone", alone.ten_steps)?;
        }
    }
    if !targets.is_empty() {
        let missed = targets.iter().filter(|target| !target.met).count();
        writeln!(text, "\n{} targets, {missed} missed", targets.len())?;
        for target in targets {
            let verdict = if target.met { "met" } else { "MISSED" };
            writeln!(text, "{:<58} {:>9.5}  {:>8}  {verdict}", target.what, target.measured, target.rule())?;
        }
    }
    Ok(())
}

fn run_rows(text: &mut String, runs: &[RunReport]) -> std::fmt::Result {
    let width = runs.iter().map(|run| run.id.len()).max().unwrap_or(0).max(16);
    let title = "position p50/p90/max";
    writeln!(text, "{:<width$} {:>5}  {title:^29}  steps within 0.5 u", "", "steps")?;
    for run in runs {
        let position = run.position;
        let within = run.steps_within_0_5;
        writeln!(
            text,
            "{:<width$} {:>5}  {:>9.5} {:>9.5} {:>9.5}  {within:>18}",
            run.id, run.steps, position.median, position.p90, position.max,
        )?;
    }
    Ok(())
}

fn ahead_row(text: &mut String, what: &str, ahead: Option<HorizonErrors>) -> std::fmt::Result {
    match ahead {
        Some(ahead) => writeln!(
            text,
            "{what:<28} {:>6}  {:>9.5} {:>9.5} {:>9.5}",
            ahead.n, ahead.median, ahead.p90, ahead.p99
        ),
        None => writeln!(text, "{what:<28} {:>6}  no run is long enough", 0),
    }
}
