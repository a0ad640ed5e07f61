//! `fuzz`: runs the targets of `phase-fuzz` on mutations of their seeds, on all cores and any toolchain.

use super::FuzzError;
use crate::{
    fuzzing::{self, Failure},
    targets::{Check, TARGETS},
};
use clap::{Args, builder::PossibleValuesParser, value_parser};
use phase_cli::{context::Context, output::print_result};
use phase_files::{atomic, checksum::sha256_hex};
use phase_runs::interrupt::requested;
use std::{
    fs,
    path::{Path, PathBuf},
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

/// Inputs that are kept, in a folder for each target.
const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus");

/// Options of `fuzz`.
#[derive(Args, Debug)]
pub struct Fuzz {
    /// Time for each target (s)
    #[arg(long, value_name = "N", default_value_t = 10,
        value_parser = value_parser!(u64).range(1..=1_000_000))]
    seconds: u64,
    /// Only these targets [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',',
        value_parser = PossibleValuesParser::new(TARGETS.map(|it| it.0)))]
    targets: Vec<String>,
    /// Random seed of the mutations
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Folder for inputs that fail
    #[arg(long, value_name = "DIR", default_value = "out/fuzz")]
    out: PathBuf,
}

/// Runs the command: prints the number of executions of each target.
///
/// # Errors
/// If a target failed on an input, which is kept, or the command was interrupted.
pub(super) fn run(arguments: &Fuzz, context: &Context) -> Result<(), FuzzError> {
    let chosen = |name: &str| arguments.targets.is_empty() || arguments.targets.iter().any(|it| it == name);
    let targets: Vec<(&str, Check)> = TARGETS.into_iter().filter(|(name, _)| chosen(name)).collect();
    let next = AtomicUsize::new(0);
    let lines = Mutex::new(Vec::new());
    let failures = Mutex::new(Vec::new());
    let work = || {
        while let Some(&target) = targets.get(next.fetch_add(1, Ordering::Relaxed)) {
            context.note(format!("{}: {} s", target.0, arguments.seconds));
            let begun = Instant::now();
            let end = begun + Duration::from_secs(arguments.seconds);
            let goes_on = || Instant::now() < end && !requested();
            let result = corpus(target.0).and_then(|corpus| {
                fuzzing::run(target, corpus, arguments.seed, goes_on)
                    .map_err(|failure| kept(&arguments.out, target.0, &failure))
            });
            match result {
                Ok(executions) => {
                    let seconds = begun.elapsed().as_secs_f64();
                    let line =
                        format!("| {} | {executions} | {:.0} |", target.0, executions as f64 / seconds);
                    lines.lock().unwrap_or_else(PoisonError::into_inner).push((executions, line));
                }
                Err(error) => failures.lock().unwrap_or_else(PoisonError::into_inner).push(error),
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from).min(targets.len()) {
            scope.spawn(work);
        }
    });
    let mut lines = lines.into_inner().unwrap_or_else(PoisonError::into_inner);
    lines.sort_by(|a, b| a.1.cmp(&b.1));
    print_result("| target | executions | a second |\n|---|---|---|")?;
    for (_, line) in &lines {
        print_result(line)?;
    }
    print_result(format!("{} executions", lines.iter().map(|line| line.0).sum::<u64>()))?;
    match failures.into_inner().unwrap_or_else(PoisonError::into_inner).pop() {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

/// The inputs of a target that are kept.
fn corpus(target: &str) -> Result<Vec<Vec<u8>>, FuzzError> {
    let folder = Path::new(CORPUS).join(target);
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let unreadable = |source| FuzzError::Unreadable { folder: folder.clone(), source };
    let mut files = fs::read_dir(&folder)
        .and_then(|files| files.map(|file| Ok(file?.path())).collect::<Result<Vec<_>, _>>())
        .map_err(unreadable)?;
    files.sort();
    files.iter().map(|file| fs::read(file).map_err(unreadable)).collect()
}

/// Keeps the input of a failure, and says where.
fn kept(out: &Path, target: &str, failure: &Failure) -> FuzzError {
    let file = out.join(format!("{target}-{}", &sha256_hex(&failure.input)[..12]));
    let kept = fs::create_dir_all(out).is_ok() && atomic::write(&file, &failure.input).is_ok();
    FuzzError::Failed { target: target.into(), message: failure.message.clone(), file: kept.then_some(file) }
}
