//! `check-schedule`: how long `gen-dataset` takes on a number of cores, from measured CPU times of attempts.
//!
//! The schedule is that of `gen-dataset` itself; what it orders takes as long as measured (`gen-dataset --attempt-times`). Cores
//! are thought to be equally fast however many work: memory, caches and clock rates are not modelled.

mod measured;
mod simulation;

use crate::error::XtaskError;
use clap::{Args, value_parser};
use measured::Measured;
use phase_cli::output::Output;
use serde_json::json;
use simulation::{Run, simulate};
use std::path::PathBuf;

/// Options of `check-schedule`.
#[derive(Args, Debug)]
pub struct CheckSchedule {
    /// Files of attempt times, of a run or of several shards, with --jobs 1 and not interrupted
    #[arg(value_name = "FILE", required = true)]
    pub times: Vec<PathBuf>,
    /// Numbers of cores
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "1,2,4,8,16")]
    #[arg(value_parser = value_parser!(u16).range(1..=1024))]
    pub cores: Vec<u16>,
    /// The first slots only [default: all]
    #[arg(long, value_name = "N")]
    pub slots: Option<usize>,
    /// How the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs the command.
///
/// # Errors
/// If the file cannot be used.
pub fn run(arguments: &CheckSchedule) -> Result<(), XtaskError> {
    let measured = Measured::read(&arguments.times, arguments.slots)?;
    let whole = measured.cpu_seconds();
    let mut text = format!(
        "{} slots, {} attempts, {whole:.0} s of CPU time, {:.1} s of them to complete the dataset\n\n\
         | cores | in sequence (s) | speed-up | ahead (s) | speed-up | in vain |\n|---|---|---|---|---|---|\n",
        measured.slots.len(),
        measured.attempts(),
        measured.completing,
    );
    let mut rows = Vec::new();
    for &cores in &arguments.cores {
        let [sequence, ahead] = [false, true].map(|ahead| simulate(&measured, usize::from(cores), ahead));
        let speed_up = |run: &Run| whole / run.seconds;
        let in_vain = ahead.in_vain.max(0.0) / (whole + ahead.in_vain);
        text += &format!(
            "| {cores} | {:.1} | {:.1} | {:.1} | {:.1} | {:.1} % |\n",
            sequence.seconds,
            speed_up(&sequence),
            ahead.seconds,
            speed_up(&ahead),
            100.0 * in_vain
        );
        rows.push(json!({
            "cores": cores, "in_sequence_seconds": sequence.seconds, "ahead_seconds": ahead.seconds,
            "in_sequence_speed_up": speed_up(&sequence), "ahead_speed_up": speed_up(&ahead), "in_vain": in_vain,
        }));
    }
    let value = json!({
        "slots": measured.slots.len(), "attempts": measured.attempts(), "cpu_seconds": whole,
        "completing_seconds": measured.completing, "runs": rows,
    });
    Ok(arguments.output.print(text, &value)?)
}
