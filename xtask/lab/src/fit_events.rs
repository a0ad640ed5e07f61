//! Shared by the commands that fit SIMPLE to events: their options, and figures of events that are computed
//! once and kept.

use crate::{
    check_minds,
    error::LabError,
    evaluations_file::{EvaluationsFile, Line},
};
use clap::{Args, value_parser};
use core::ops::ControlFlow;
use phase_cli::{context::Context, error::CliError, interrupt, json_file, parallel::Jobs};
use phase_event::{MethodError, ProgressCallback, Recording};
use phase_files::checksum::{hexadecimal, sha256};
use phase_runs::{error::RunError, event_writer::program, interrupt::requested, parallel::make_all, words};
use serde::{Serialize, de::DeserializeOwned};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

/// Options of `check-forecasts`, `check-search`, `fit-beliefs`, `fit-forecast`, `fit-inference` and
/// `fit-intents`.
#[derive(Args, Debug)]
pub struct FitEvents {
    /// The events to fit to or to check: a file in the format phase-events/1, or the folder of a dataset or
    /// of simulations; may be given several times
    #[arg(long, value_name = "FILE|DIR", required = true)]
    pub events: Vec<PathBuf>,
    /// Further events, to which nothing is fitted; their figures are reported beside. May be given several
    /// times
    #[arg(long, value_name = "FILE|DIR")]
    pub held_out: Vec<PathBuf>,
    /// Only the first N events of each file
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub limit: Option<u32>,
    /// File for the fit (JSON); what was simulated of each event is kept in a file beside it, and the same
    /// command goes on from there
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The seed of all random draws, the same in every event, and of a division into folds
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

impl FitEvents {
    /// Checks that `--out` can be written and is no input.
    pub(crate) fn check_out<'a>(
        &'a self,
        others: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Result<(), CliError> {
        let Some(out) = &self.out else { return Ok(()) };
        json_file::check("--out", out, self.events.iter().chain(&self.held_out).chain(others))
    }

    /// Refuses `--held-out`, for commands that fit nothing.
    pub(crate) fn check_nothing_held_out(&self) -> Result<(), RunError> {
        if self.held_out.is_empty() {
            return Ok(());
        }
        Err(RunError::Usage("--held-out: nothing is fitted here; give these events with --events".into()))
    }

    /// Writes the fit, if a file was named.
    pub(crate) fn write(&self, fit: &impl Serialize) -> Result<(), CliError> {
        self.out.as_deref().map_or(Ok(()), |out| json_file::write(out, fit))
    }

    /// The events of a file, as many as were asked for.
    pub(crate) fn read(&self, file: &Path, context: &Context) -> Result<Vec<Recording>, RunError> {
        let mut recordings = check_minds::recordings(file, &[], None, context)?;
        recordings.truncate(self.limit.map_or(usize::MAX, |limit| limit as usize));
        Ok(recordings)
    }

    /// The events of all these files, one after the other.
    pub(crate) fn read_all(&self, files: &[PathBuf], context: &Context) -> Result<Vec<Recording>, RunError> {
        let files = files.iter().map(|file| self.read(file, context)).collect::<Result<Vec<_>, _>>()?;
        Ok(files.into_iter().flatten().collect())
    }

    /// The events of all these files, which have to be simulated: nobody knows the beliefs of others.
    pub(crate) fn read_simulated(
        &self,
        files: &[PathBuf],
        context: &Context,
    ) -> Result<Vec<Recording>, RunError> {
        let mut all = Vec::new();
        for file in files {
            let recordings = self.read(file, context)?;
            if let Some(measured) = recordings.iter().find(|it| it.simulation.is_none()) {
                let rule = "was not simulated, so nobody knows its agents' beliefs";
                return Err(RunError::Usage(format!("{}: event {}: {rule}", file.display(), measured.id)));
            }
            all.extend(recordings);
        }
        Ok(all)
    }
}

impl FitEvents {
    /// Computes something of each event to fit to, and of each held out, all of which have to be simulated.
    /// `compute` returns `None` if its tick breaks.
    pub(crate) fn of_simulated<T: Clone + Send + Sync + Serialize + DeserializeOwned>(
        &self,
        activity: &str,
        context: &Context,
        compute: impl Fn(&Recording, ProgressCallback<'_>) -> Result<Option<T>, MethodError> + Sync,
    ) -> Result<[Vec<T>; 2], LabError> {
        self.check_out([])?;
        let own = self.read_simulated(&self.events, context)?;
        let others = self.read_simulated(&self.held_out, context)?;
        interrupt::listen();
        let kept = KeptFigures::new("", self, context)?;
        let known = |recordings: &[Recording]| {
            let all: Vec<&Recording> = recordings.iter().collect();
            kept.of(activity, &all, 1, |recording, tick| {
                let found = compute(recording, tick);
                found.map_err(|source| RunError::Method { id: recording.id.clone(), source })
            })
        };
        Ok([known(&own)?, known(&others)?])
    }
}

/// Figures of events, computed once each and kept in the file beside `--out`.
pub(crate) struct KeptFigures<'a, T> {
    arguments: &'a FitEvents,
    context: &'a Context,
    /// Program, settings and seed, as they enter every key.
    made_by: String,
    file: Option<EvaluationsFile>,
    known: BTreeMap<String, T>,
}

impl<'a, T: Clone + Send + Sync + Serialize + DeserializeOwned> KeptFigures<'a, T> {
    /// Nothing yet but what the file holds. `settings` names what determines the figures beside program, seed
    /// and event.
    pub(crate) fn new(
        settings: &str,
        arguments: &'a FitEvents,
        context: &'a Context,
    ) -> Result<Self, RunError> {
        let made_by = format!("{} {settings} {}", hexadecimal(&program()), arguments.seed);
        let kept = arguments.out.as_deref().map(EvaluationsFile::beside).transpose()?;
        let (file, lines) = kept.map_or_else(|| (None, Vec::new()), |(file, lines)| (Some(file), lines));
        let known = lines.into_iter().map(|line: Line<T>| (line.key, line.figures)).collect();
        Ok(Self { arguments, context, made_by, file, known })
    }

    /// The figures of these events, in their order. `compute` calls its tick about once a simulation, `ticks`
    /// times an event, and returns `None` if the tick breaks.
    pub(crate) fn of(
        &self,
        activity: &str,
        recordings: &[&Recording],
        ticks: usize,
        compute: impl Fn(&Recording, ProgressCallback<'_>) -> Result<Option<T>, RunError> + Sync,
    ) -> Result<Vec<T>, LabError> {
        let activity = format!("{activity} of {}", words::events(recordings.len()));
        let progress = self.context.progress(&activity, recordings.len(), ticks);
        let made = make_all(self.arguments.jobs.threads(), recordings.len(), |k| {
            let mut ticks = 0;
            let figures = self.one(recordings[k], |event| {
                compute(event, &mut || {
                    ticks += 1;
                    progress.step();
                    if requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                })
            })?;
            if figures.is_some() {
                progress.event(ticks, &recordings[k].id);
            }
            Ok(figures)
        })?;
        drop(progress);
        made.ok_or_else(|| match &self.file {
            Some(file) => RunError::Interrupted(file.path().to_owned()).into(),
            None => LabError::Interrupted,
        })
    }

    fn one(
        &self,
        recording: &Recording,
        mut compute: impl FnMut(&Recording) -> Result<Option<T>, RunError>,
    ) -> Result<Option<T>, RunError> {
        let event = recording.to_json().map_err(RunError::EventWrite)?;
        let key = hexadecimal(&sha256(format!("{} {event}", self.made_by).as_bytes()));
        if let Some(known) = self.known.get(&key) {
            return Ok(Some(known.clone()));
        }
        let figures = compute(recording)?;
        if let (Some(file), Some(figures)) = (&self.file, &figures) {
            file.add(&Line { key, event: recording.id.clone(), figures: figures.clone() })?;
        }
        Ok(figures)
    }
}
