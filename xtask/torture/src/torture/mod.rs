//! `torture`: stops programs while they write, fills their disk, takes their permissions away and lets two of
//! them race, and checks that nothing is lost, nothing half-written, and that the same command makes the same
//! bytes afterwards.

mod jobs;
mod permissions;
mod run;
mod serve;

use crate::error::TortureError;
use clap::{Args, value_parser};
use jobs::{JOBS, Job};
use phase_cli::{context::Context, interrupt, output::print_result, parallel::Jobs};
use phase_model::random::{Pcg64Mcg, Purpose, stream};
use phase_runs::{error::RunError, interrupt::requested, parallel::make_all};
use rand::RngExt;
use run::{End, Ground};
use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
    time::Duration,
};

/// Longest file of a run whose disk is small (bytes).
const SMALL_DISK: u64 = 40_000;

/// Options of `torture`.
#[derive(Args, Debug)]
pub struct Torture {
    /// Times that each thing is done to each command: it is stopped at a random step of writing, killed at a
    /// random moment, finds its disk full, loses its permission to write, or races
    #[arg(long, value_name = "N", default_value_t = 5,
        value_parser = value_parser!(u32).range(1..=1_000_000))]
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
    /// Number at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Something that is done to a command.
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

/// Runs the command. What was done until an interruption is told, too.
///
/// # Errors [`TortureError::Tortured`] if something was lost, half-written or different; if a command cannot
/// be run at all.
pub fn run(arguments: &Torture, context: &Context) -> Result<(), TortureError> {
    interrupt::listen();
    let this = std::env::current_exe().map_err(TortureError::Start)?;
    // Where everybody may run it, even who may not enter the folder that it was built in.
    let folder = tempfile::tempdir()
        .map_err(|source| run::failed(&std::env::temp_dir(), "create a folder", source))?;
    let program = folder.path().join("phase");
    let copy = || -> io::Result<()> {
        fs::copy(arguments.program.as_ref().unwrap_or(&this), &program)?;
        if permissions::EXIST { permissions::show(folder.path()) } else { Ok(()) }
    };
    copy().map_err(|source| run::failed(&program, "copy the program to", source))?;
    let subjects = subjects(arguments, &program, context)?;
    let all = disturbances(arguments, &subjects);
    let progress = context.progress_over(&format!("{} disturbances", all.len()), all.len());
    let done: Vec<AtomicBool> = all.iter().map(|_| AtomicBool::new(false)).collect();
    // What a disturbance is does not depend on which others there were.
    let results = make_all(arguments.jobs.threads(), all.len(), |index| {
        let disturbance = &all[index];
        let subject = &subjects[disturbance.subject];
        let result = subject.suffer(&program, disturbance, arguments.seed);
        if requested() {
            // An interruption reaches the command as well.
            return Ok(None);
        }
        if let Ok(Some(what)) = &result {
            context.note(format!("{} {}: {what}", subject.name, disturbance.torment.name()));
        }
        done[index].store(true, Ordering::Relaxed);
        progress.step();
        Ok(Some(result))
    })?;
    drop(progress);
    let heads = Torment::ALL.map(Torment::name).join(" | ");
    let rule = "---:|".repeat(1 + Torment::ALL.len());
    let counted = |(it, done): (_, &AtomicBool)| done.load(Ordering::Relaxed).then_some(it);
    let counted: Vec<&Disturbance> = all.iter().zip(&done).filter_map(counted).collect();
    let rows: Vec<String> =
        (0..subjects.len()).map(|number| row(number, &subjects[number], &counted)).collect();
    print_result(format!("| command | steps | {heads} |\n|---|{rule}\n{}", rows.join("\n")))?;
    let Some(results) = results else { return Err(TortureError::Interrupted) };
    let wrong = results.into_iter().collect::<Result<Vec<_>, _>>()?;
    match wrong.iter().flatten().count() {
        0 => Ok(()),
        failures => Err(TortureError::Tortured(failures)),
    }
}

/// A command or the server.
struct Subject<'a> {
    name: &'static str,
    /// Its number among all there are, wanted or not.
    number: u64,
    /// Place in which the command runs, and its steps of writing; `None` for the server.
    command: Option<(Ground<'a>, u64)>,
}

/// Something that is done to a subject.
struct Disturbance {
    subject: usize,
    torment: Torment,
    /// Its number among those of this subject.
    number: u64,
    /// The step of writing that it concerns; `None` for a random one.
    step: Option<u64>,
}

impl Subject<'_> {
    /// Disturbs it, and says in words what is wrong afterwards, if anything.
    fn suffer(&self, program: &Path, it: &Disturbance, seed: u64) -> Result<Option<String>, TortureError> {
        let mut random = stream(seed, Purpose::Event, self.number << 32 | it.number);
        let Some((ground, steps)) = &self.command else {
            return serve::inflict(program, it.torment, &mut random);
        };
        let step = it.step.unwrap_or_else(|| random.random_range(1..=*steps));
        let what = inflict(ground, it.torment, step, &mut random)?;
        Ok(what.map(|what| format!("(step {step}) {what}")))
    }

    /// Torments that can be inflicted on it on this system.
    fn torments(&self) -> impl Iterator<Item = Torment> {
        let of_servers = self.command.is_none();
        let fits = move |torment: &Torment| !of_servers || serve::TORMENTS.contains(torment);
        Torment::ALL.into_iter().filter(fits).filter(|torment| exists(*torment))
    }
}

/// Prepares the wanted subjects; leaves out those that the program was built without.
fn subjects<'a>(
    arguments: &Torture,
    program: &'a Path,
    context: &Context,
) -> Result<Vec<Subject<'a>>, TortureError> {
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|text| name.contains(text.as_str()));
    let jobs: Vec<(u64, &Job)> = (0..).zip(&JOBS).filter(|(_, job)| wanted(job.name)).collect();
    if jobs.is_empty() && !wanted(serve::NAME) {
        return Err(RunError::Usage("--only: no command has such a name".into()).into());
    }
    let without = |name: &str| context.note(format!("{name}: the program was built without it"));
    let prepared = make_all(arguments.jobs.threads(), jobs.len(), |index| {
        let (number, job) = jobs[index];
        let prepare = || -> Result<Option<Subject<'a>>, TortureError> {
            let Some(ground) = Ground::new(program, job)? else {
                without(job.name);
                return Ok(None);
            };
            let steps = ground.steps()?;
            context.note(format!("{}: {steps} steps of writing", job.name));
            Ok(Some(Subject { name: job.name, number, command: Some((ground, steps)) }))
        };
        Ok(Some(prepare()))
    })?;
    let Some(prepared) = prepared else { return Err(TortureError::Interrupted) };
    let mut subjects: Vec<Subject<'a>> =
        prepared.into_iter().filter_map(Result::transpose).collect::<Result<_, _>>()?;
    if wanted(serve::NAME) {
        if serve::is_built_in(program)? {
            context.note(format!("{}: with raters and a player", serve::NAME));
            subjects.push(Subject { name: serve::NAME, number: JOBS.len() as u64, command: None });
        } else {
            without(serve::NAME);
        }
    }
    Ok(subjects)
}

/// All that is to be done, to one subject after the other.
fn disturbances(arguments: &Torture, subjects: &[Subject<'_>]) -> Vec<Disturbance> {
    let mut all = Vec::new();
    for (subject, it) in subjects.iter().enumerate() {
        let steps = it.command.as_ref().map_or(0, |(_, steps)| if arguments.every_step { *steps } else { 0 });
        let each = (1..=steps).map(|step| (Torment::Stop, Some(step)));
        let random = (0..arguments.kills).flat_map(|_| it.torments().map(|torment| (torment, None)));
        let of = |(number, (torment, step))| Disturbance { subject, torment, number, step };
        all.extend((0..).zip(each.chain(random)).map(of));
    }
    all
}

/// The row of a subject: how often what was done to it.
fn row(number: usize, subject: &Subject<'_>, all: &[&Disturbance]) -> String {
    let times = |torment| all.iter().filter(|it| it.subject == number && it.torment == torment).count();
    let counts = Torment::ALL.map(|torment| times(torment).to_string()).join(" | ");
    let steps = subject.command.as_ref().map(|(_, steps)| steps.to_string()).unwrap_or_default();
    format!("| {} | {steps} | {counts} |", subject.name)
}

/// A torment that this system has.
fn exists(torment: Torment) -> bool {
    torment != Torment::Revoke || permissions::EXIST
}

/// Does something to a command in a fresh folder, and lets it go on: what is wrong then, if anything.
fn inflict(
    ground: &Ground<'_>,
    torment: Torment,
    step: u64,
    random: &mut Pcg64Mcg,
) -> Result<Option<String>, TortureError> {
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
