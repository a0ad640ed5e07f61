//! Training files beside the weights: the checkpoint from which the same command resumes, and the record.

use crate::{error::train::TrainError, listener::Listener};
use cpu_time::ProcessTime;
use phase_baselines::training::{DataSource, Final, Network, TrainingRecord, TrainingRun};
use phase_files::{WriteError, atomic, json};
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

/// Minimum time between two checkpoints. Quick rounds are not each worth the wait for the disk.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(2);

/// The files of a training in progress.
#[derive(Debug)]
pub(super) struct TrainingFiles {
    checkpoint: PathBuf,
    file: PathBuf,
    record: TrainingRecord,
    /// Digest of the events, stored in checkpoints.
    data: String,
    /// Time of the last checkpoint after a round of this process.
    last: Option<Instant>,
}

impl TrainingFiles {
    /// Resumes an interrupted training or creates the files of a new one, so that an unwritable folder is
    /// reported before the work.
    pub(super) fn open<N: Network>(
        run: &mut TrainingRun<N>,
        out: &Path,
        training: DataSource,
        more: Vec<DataSource>,
        validation: DataSource,
        listener: &dyn Listener,
    ) -> Result<Self, TrainError> {
        let more_data = more.iter().map(|source| format!(" {} {}", source.sha256, source.events));
        let more_data: String = more_data.collect();
        let data = format!("{} {} {}{more_data}", training.sha256, training.events, validation.sha256);
        let checkpoint = beside(out, ".checkpoint");
        let file = beside(out, ".training.json");
        let record = TrainingRecord::new(run, training, more, validation);
        [out, checkpoint.as_path(), file.as_path()].into_iter().for_each(atomic::remove_abandoned);
        let mut training_files = Self { checkpoint, file, record, data, last: None };
        if training_files.checkpoint.exists() {
            let wrong = |source| TrainError::Checkpoint { file: training_files.checkpoint.clone(), source };
            run.resume(&json::bytes(&training_files.checkpoint)?, &training_files.data).map_err(wrong)?;
            let wrong = |source| TrainError::TrainingRecord {
                file: training_files.file.clone(),
                checkpoint: training_files.checkpoint.clone(),
                source,
            };
            let earlier = TrainingRecord::parse(&json::bytes(&training_files.file)?).map_err(wrong)?;
            training_files.record.resume(earlier, run).map_err(wrong)?;
            listener.note(&format!("continuing after round {}", run.rounds().len()));
        } else {
            training_files.write(run)?;
        }
        Ok(training_files)
    }

    /// Runs a round and records it. An interruption loses the current round and those of the last two
    /// seconds. Also returns the duration of the round (s).
    pub(super) fn round<N: Network>(
        &mut self,
        run: &mut TrainingRun<N>,
        training: &[N::Sample],
        validation: &[N::Sample],
    ) -> Result<f64, TrainError> {
        let cpu = processor_time();
        let clock = Instant::now();
        let round = run.round(training, validation)?;
        let seconds = clock.elapsed().as_secs_f64();
        let cpu_seconds = processor_time().saturating_sub(cpu).as_secs_f64();
        self.record.add::<N>(round, cpu_seconds, seconds);
        if self.last.is_none_or(|last| last.elapsed() >= CHECKPOINT_INTERVAL) {
            self.write(run)?;
            self.last = Some(Instant::now());
        }
        Ok(seconds)
    }

    /// Writes the record of a training that is finished, whose weights are written, and removes the
    /// checkpoint.
    pub(super) fn finish(mut self, finished: Final) -> Result<(), TrainError> {
        self.record.finished = Some(finished);
        let record = self.record.to_json().map_err(|error| WriteError::json(&self.file, error))?;
        atomic::write(&self.file, record.as_bytes())?;
        Ok(atomic::remove(&self.checkpoint)?)
    }

    /// The record is written first: after an interruption between the two it has too many rounds, which are
    /// dropped, and never too few.
    fn write<N: Network>(&self, run: &TrainingRun<N>) -> Result<(), TrainError> {
        let record = self.record.to_json().map_err(|error| WriteError::json(&self.file, error))?;
        atomic::write(&self.file, record.as_bytes())?;
        let wrong = |source| TrainError::Checkpoint { file: self.checkpoint.clone(), source };
        Ok(atomic::write(&self.checkpoint, &run.checkpoint(&self.data).map_err(wrong)?)?)
    }
}

/// CPU time of this process so far.
fn processor_time() -> Duration {
    ProcessTime::now().as_duration()
}

/// A path with a suffix added to the whole file name.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ending);
    name.into()
}
