//! `torture`: stops programs while they write, fills their disk and lets two of them race, and checks that nothing is lost, nothing
//! half-written, and that the same command makes the same bytes afterwards.

mod jobs;
mod run;

use crate::error::XtaskError;
use clap::{Args, value_parser};
use jobs::{JOBS, Job};
use phase_cli::{console::print_result, context::Context, error::CliError};
use phase_model::random::{Pcg64Mcg, Purpose, stream};
use rand::RngExt;
use run::{End, Ground};
use std::time::Duration;

/// Longest file of a run whose disk is small (bytes).
const SMALL_DISK: u64 = 40_000;

/// Options of `torture`.
#[derive(Args, Debug)]
pub struct Torture {
    /// Times that each command is stopped at a random step of writing, killed at a random moment, and finds its disk full
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub kills: u32,
    /// Seed of the steps and moments
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Also stop each command at every step of writing there is
    #[arg(long)]
    pub every_step: bool,
    /// Only commands whose names contain this
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
}

/// What is done to a command.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Torment {
    /// It ends at a step of writing.
    Stop,
    /// It is killed at a moment.
    Kill,
    /// Its disk is full from a step of writing on.
    Full,
    /// Its disk takes no file above a size.
    SmallDisk,
    /// Another process does the same at the same time.
    Race,
}

impl Torment {
    const ALL: [Self; 5] = [Self::Stop, Self::Kill, Self::Full, Self::SmallDisk, Self::Race];

    const fn name(self) -> &'static str {
        match self {
            Self::Stop => "stopped at a step",
            Self::Kill => "killed",
            Self::Full => "disk full",
            Self::SmallDisk => "small disk",
            Self::Race => "raced",
        }
    }
}

/// Runs the command.
///
/// # Errors
/// [`XtaskError::Tortured`] if something was lost, half-written or different; if a command cannot be run at all.
pub fn run(arguments: &Torture, context: &Context) -> Result<(), XtaskError> {
    let wanted = |job: &&Job| arguments.only.as_ref().is_none_or(|text| job.name.contains(text.as_str()));
    let chosen: Vec<&Job> = JOBS.iter().filter(wanted).collect();
    if chosen.is_empty() {
        return Err(CliError::Usage("--only: no command has such a name".into()).into());
    }
    let mut rows = Vec::new();
    let mut failures = 0;
    for (number, job) in chosen.into_iter().enumerate() {
        let Some(ground) = Ground::new(job)? else {
            context.note(format!("{}: this program was built without it", job.name));
            continue;
        };
        let mut random = stream(arguments.seed, Purpose::Event, number as u64);
        let steps = ground.steps()?;
        context.note(format!("{}: {steps} steps of writing", job.name));
        let mut counts = [0; Torment::ALL.len()];
        let mut apply = |torment: Torment, step: u64, random: &mut Pcg64Mcg| -> Result<(), XtaskError> {
            counts[torment as usize] += 1;
            if let Some(what) = inflict(&ground, torment, step, random)? {
                failures += 1;
                context.note(format!("{} {} (step {step}): {what}", job.name, torment.name()));
            }
            Ok(())
        };
        if arguments.every_step {
            for step in 1..=steps {
                apply(Torment::Stop, step, &mut random)?;
            }
        }
        for _ in 0..arguments.kills {
            for torment in Torment::ALL {
                let step = random.random_range(1..=steps);
                apply(torment, step, &mut random)?;
            }
        }
        let cells = counts.map(|count| count.to_string()).join(" | ");
        rows.push(format!("| {} | {steps} | {cells} |", job.name));
    }
    let heads = Torment::ALL.map(Torment::name).join(" | ");
    let rule = "---:|".repeat(1 + Torment::ALL.len());
    print_result(format!("| command | steps | {heads} |\n|---|{rule}\n{}", rows.join("\n")));
    if failures == 0 { Ok(()) } else { Err(XtaskError::Tortured(failures)) }
}

/// Does something to a command in a fresh folder, and lets it go on: what is wrong then, if anything.
fn inflict(
    ground: &Ground,
    torment: Torment,
    step: u64,
    random: &mut Pcg64Mcg,
) -> Result<Option<String>, XtaskError> {
    let place = ground.place()?;
    let ends: Vec<End> = match torment {
        Torment::Stop => vec![ground.run_with_fault(&place, &format!("kill@{step}"))?],
        Torment::Full => vec![ground.run_with_fault(&place, &format!("full@{step}"))?],
        Torment::Kill => {
            let share = random.random_range(0.0..1.0);
            vec![ground.run_and_kill(&place, Duration::from_secs_f64(ground.seconds() * share))?]
        }
        Torment::SmallDisk => vec![ground.run_on_small_disk(&place, SMALL_DISK)?],
        Torment::Race => ground.race(&place)?,
    };
    let allowed = |end: &End| match torment {
        Torment::Stop | Torment::Kill => end.is_success() || end.was_killed(),
        Torment::Full | Torment::SmallDisk => end.is_success() || end.says_it_failed(),
        Torment::Race => end.is_success() || end.says_it_is_busy(),
    };
    if let Some(end) = ends.iter().find(|end| !allowed(end)) {
        return Ok(Some(format!("ended with {end}")));
    }
    if torment == Torment::Race && !ends.iter().any(End::is_success) {
        return Ok(Some("neither of two finished".into()));
    }
    if let Some(file) = ground.damaged(&place)? {
        return Ok(Some(format!("left {file}, which is not what a whole run writes")));
    }
    let end = ground.run(&place)?;
    if !end.is_success() {
        return Ok(Some(format!("afterwards ended with {end}")));
    }
    Ok(ground.different(&place)?.map(|file| format!("afterwards made another {file}")))
}
