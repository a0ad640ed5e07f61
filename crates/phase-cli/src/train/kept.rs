//! What is kept of a training beside its weights: the checkpoint that the same command goes on from, and the record.

use crate::context::Context;
use crate::error::train::TrainError;
use cpu_time::ProcessTime;
use phase_baselines::training::{Final, Network, Record, Run, Source};
use phase_dataset::{WriteError, atomic, json};
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

/// Least time between two checkpoints. Quick rounds are not each worth the wait for the disk.
const KEPT_EVERY: Duration = Duration::from_secs(2);

/// The files of a training under way.
#[derive(Debug)]
pub(super) struct Kept {
    checkpoint: PathBuf,
    file: PathBuf,
    record: Record,
    /// What stands for the events in checkpoints.
    data: String,
    /// When there was last a checkpoint after a round of this process.
    last: Option<Instant>,
}

impl Kept {
    /// Takes up a training that was broken off, or begins to keep the new one: where nothing can be written is to be known
    /// before the work.
    ///
    /// # Errors
    /// If there is a checkpoint of another training, or a file cannot be read or written.
    pub(super) fn open<N: Network>(
        run: &mut Run<N>,
        out: &Path,
        training: Source,
        validation: Source,
        context: &Context,
    ) -> Result<Self, TrainError> {
        let data = format!("{} {} {}", training.sha256, training.events, validation.sha256);
        let (checkpoint, file) = (beside(out, ".checkpoint"), beside(out, ".training.json"));
        let record = Record::new(run, training, validation);
        let mut kept = Self { checkpoint, file, record, data, last: None };
        if kept.checkpoint.exists() {
            let wrong = |source| TrainError::Checkpoint { file: kept.checkpoint.clone(), source };
            run.resume(&json::bytes(&kept.checkpoint)?, &kept.data).map_err(wrong)?;
            let wrong = |source| TrainError::Record {
                file: kept.file.clone(),
                checkpoint: kept.checkpoint.clone(),
                source,
            };
            let earlier = Record::parse(&json::bytes(&kept.file)?).map_err(wrong)?;
            kept.record.resume(earlier, run).map_err(wrong)?;
            context.note(format!("continuing after round {}", run.rounds().len()));
        } else {
            kept.write(run)?;
        }
        Ok(kept)
    }

    /// Goes through a round and writes it down. Whoever breaks off loses the round at work, and those of the last
    /// two seconds. Also says how long the round took (s).
    ///
    /// # Errors
    /// If nothing can be learnt or written.
    pub(super) fn round<N: Network>(
        &mut self,
        run: &mut Run<N>,
        training: &[N::Sample],
        validation: &[N::Sample],
    ) -> Result<f64, TrainError> {
        let (cpu, clock) = (processor_time(), Instant::now());
        let round = run.round(training, validation)?;
        let seconds = clock.elapsed().as_secs_f64();
        let cpu_seconds = processor_time().saturating_sub(cpu).as_secs_f64();
        self.record.add::<N>(round, cpu_seconds, seconds);
        if self.last.is_none_or(|last| last.elapsed() >= KEPT_EVERY) {
            self.write(run)?;
            self.last = Some(Instant::now());
        }
        Ok(seconds)
    }

    /// Writes the record of a training that is finished, whose weights are written, and removes the checkpoint.
    ///
    /// # Errors
    /// If a file cannot be written or removed.
    pub(super) fn finish(mut self, finished: Final) -> Result<(), TrainError> {
        self.record.finished = Some(finished);
        let record = self.record.to_json().map_err(|error| WriteError::json(&self.file, error))?;
        atomic::write(&self.file, record.as_bytes())?;
        Ok(atomic::remove(&self.checkpoint)?)
    }

    /// The record comes first: after a break between the two it has rounds too many, which are dropped, and never too few.
    fn write<N: Network>(&self, run: &Run<N>) -> Result<(), TrainError> {
        let record = self.record.to_json().map_err(|error| WriteError::json(&self.file, error))?;
        atomic::write(&self.file, record.as_bytes())?;
        let wrong = |source| TrainError::Checkpoint { file: self.checkpoint.clone(), source };
        Ok(atomic::write(&self.checkpoint, &run.checkpoint(&self.data).map_err(wrong)?)?)
    }
}

/// What the processor has spent on this program since it began.
fn processor_time() -> Duration {
    ProcessTime::now().as_duration()
}

/// A file beside another, with something after its whole name.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ending);
    name.into()
}
