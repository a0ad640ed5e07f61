//! `torture`: stops programs while they write, fills their disk, takes their permissions away and lets two of them race, and checks that
//! nothing is lost, nothing half-written, and that the same command makes the same bytes afterwards.

mod jobs;
mod permissions;
mod run;
mod serve;

use crate::error::XtaskError;
use clap::{Args, value_parser};
use jobs::{JOBS, Job};
use phase_cli::{console::print_result, context::Context, error::CliError};
use phase_model::random::{Pcg64Mcg, Purpose, stream};
use rand::RngExt;
use run::{End, Ground};
use std::{
    fs, io,
    path::{Path, PathBuf},
    time::Duration,
};

/// Longest file of a run whose disk is small (bytes).
const SMALL_DISK: u64 = 40_000;

/// Options of `torture`.
#[derive(Args, Debug)]
pub struct Torture {
    /// Times that each thing is done to each command: it is stopped at a random step of writing, killed at a random moment, finds its disk
    /// full, loses its permission to write, or races
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
    /// The program, such as `target/release/phase`, which has `train` and `serve` [default: this one]
    #[arg(long, value_name = "FILE")]
    pub program: Option<PathBuf>,
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
    /// It loses the permission to write at a moment.
    Revoke,
    /// Another process does the same at the same time.
    Race,
}

impl Torment {
    const ALL: [Self; 6] = [Self::Stop, Self::Kill, Self::Full, Self::SmallDisk, Self::Revoke, Self::Race];

    const fn name(self) -> &'static str {
        match self {
            Self::Stop => "stopped at a step",
            Self::Kill => "killed",
            Self::Full => "disk full",
            Self::SmallDisk => "small disk",
            Self::Revoke => "read-only",
            Self::Race => "raced",
        }
    }
}

/// Runs the command.
///
/// # Errors
/// [`XtaskError::Tortured`] if something was lost, half-written or different; if a command cannot be run at all.
pub fn run(arguments: &Torture, context: &Context) -> Result<(), XtaskError> {
    let this = std::env::current_exe().map_err(XtaskError::Cargo)?;
    // Where everybody may run it, even who may not enter the folder that it was built in.
    let folder = tempfile::tempdir()
        .map_err(|source| run::failed(&std::env::temp_dir(), "create a folder", source))?;
    let program = folder.path().join("phase");
    let copy = || -> io::Result<()> {
        fs::copy(arguments.program.as_ref().unwrap_or(&this), &program)?;
        if permissions::EXIST { permissions::show(folder.path()) } else { Ok(()) }
    };
    copy().map_err(|source| run::failed(&program, "copy the program to", source))?;
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|text| name.contains(text.as_str()));
    if !JOBS.iter().map(|job| job.name).chain([serve::NAME]).any(wanted) {
        return Err(CliError::Usage("--only: no command has such a name".into()).into());
    }
    let mut done = Done { context, rows: Vec::new(), failures: 0 };
    for (number, job) in (0..).zip(&JOBS) {
        if wanted(job.name) {
            command(arguments, &program, job, number, &mut done)?;
        }
    }
    if wanted(serve::NAME) {
        server(arguments, &program, &mut done)?;
    }
    let heads = Torment::ALL.map(Torment::name).join(" | ");
    let rule = "---:|".repeat(1 + Torment::ALL.len());
    print_result(format!("| command | steps | {heads} |\n|---|{rule}\n{}", done.rows.join("\n")));
    if done.failures == 0 { Ok(()) } else { Err(XtaskError::Tortured(done.failures)) }
}

/// What has been done so far.
struct Done<'a> {
    context: &'a Context,
    rows: Vec<String>,
    failures: usize,
}

impl Done<'_> {
    fn row(&mut self, name: &str, steps: &str, counts: [u32; Torment::ALL.len()]) {
        let cells = counts.map(|count| count.to_string()).join(" | ");
        self.rows.push(format!("| {name} | {steps} | {cells} |"));
    }

    fn note(&mut self, name: &str, torment: Torment, what: Option<String>) {
        if let Some(what) = what {
            self.failures += 1;
            self.context.note(format!("{name} {}: {what}", torment.name()));
        }
    }
}

/// A torment that this system has.
fn exists(torment: Torment) -> bool {
    torment != Torment::Revoke || permissions::EXIST
}

/// Tortures a command that ends by itself.
fn command(
    arguments: &Torture,
    program: &Path,
    job: &'static Job,
    number: u64,
    done: &mut Done<'_>,
) -> Result<(), XtaskError> {
    let Some(ground) = Ground::new(program, job)? else {
        done.context.note(format!("{}: the program was built without it", job.name));
        return Ok(());
    };
    let mut random = stream(arguments.seed, Purpose::Event, number);
    let steps = ground.steps()?;
    done.context.note(format!("{}: {steps} steps of writing", job.name));
    let mut counts = [0; Torment::ALL.len()];
    let mut apply = |torment: Torment, step: u64, random: &mut Pcg64Mcg| -> Result<(), XtaskError> {
        counts[torment as usize] += 1;
        let what = inflict(&ground, torment, step, random)?;
        done.note(job.name, torment, what.map(|what| format!("(step {step}) {what}")));
        Ok(())
    };
    if arguments.every_step {
        for step in 1..=steps {
            apply(Torment::Stop, step, &mut random)?;
        }
    }
    for _ in 0..arguments.kills {
        for torment in Torment::ALL.into_iter().filter(|torment| exists(*torment)) {
            let step = random.random_range(1..=steps);
            apply(torment, step, &mut random)?;
        }
    }
    done.row(job.name, &steps.to_string(), counts);
    Ok(())
}

/// Tortures the server.
fn server(arguments: &Torture, program: &Path, done: &mut Done<'_>) -> Result<(), XtaskError> {
    if !serve::is_built_in(program)? {
        done.context.note(format!("{}: the program was built without it", serve::NAME));
        return Ok(());
    }
    done.context.note(format!("{}: with raters and a player", serve::NAME));
    let mut random = stream(arguments.seed, Purpose::Event, JOBS.len() as u64);
    let mut counts = [0; Torment::ALL.len()];
    for _ in 0..arguments.kills {
        for torment in serve::TORMENTS.into_iter().filter(|torment| exists(*torment)) {
            counts[torment as usize] += 1;
            let what = serve::inflict(program, torment, &mut random)?;
            done.note(serve::NAME, torment, what);
        }
    }
    done.row(serve::NAME, "", counts);
    Ok(())
}

/// Does something to a command in a fresh folder, and lets it go on: what is wrong then, if anything.
fn inflict(
    ground: &Ground<'_>,
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
        Torment::Revoke => {
            let share = random.random_range(0.0..1.0);
            vec![ground.revoke(&place, Duration::from_secs_f64(ground.seconds() * share))?]
        }
        Torment::SmallDisk => vec![ground.run_on_small_disk(&place, SMALL_DISK)?],
        Torment::Race => ground.race(&place)?,
    };
    let allowed = |end: &End| match torment {
        Torment::Stop | Torment::Kill => end.is_success() || end.was_killed(),
        Torment::Full | Torment::SmallDisk | Torment::Revoke => end.is_success() || end.says_it_failed(),
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
