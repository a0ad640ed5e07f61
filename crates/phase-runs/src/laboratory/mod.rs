//! Events as stimuli: clips, regressors, areas of interest, dissimilarity matrices, matched sets and packs
//! for experiment platforms, each as a run on many events.

mod answers;
mod areas;
pub(crate) mod clips;
mod matrices;
mod observation;
mod pack;
mod pairing;
mod presentation;
mod tables;

pub use areas::AreaRun;
pub use clips::{CLIPS_FILE, ClipForm, ClipRun, Clips, Shorter};
pub use matrices::{Correlation, Matrices, MatrixRun, Source};
pub use observation::{Observation, Observed, ObservingMethod};
pub use pack::{Pack, Packed};
pub use pairing::{MEASURES, Pairing};

use crate::error::RunError;
use phase_files::{
    WriteError,
    folder::{self, Contents, Folder},
    run::Run,
};
use phase_laboratory::clip::{ClipError, Cut, Window};
use serde_json::Value;
use std::path::Path;

/// The steps of an event that a run is about.
fn window(cut: Option<Cut>, id: &str, steps: usize) -> Result<Window, RunError> {
    match cut {
        Some(cut) => cut.window(id, steps).map_err(|error| unfit(&error)),
        None => Ok(Window::whole(steps)),
    }
}

pub(crate) use tables::unusable;

fn unfit(error: &ClipError) -> RunError {
    RunError::Usage(error.to_string())
}

/// The folder of a run.
pub(crate) enum Opened {
    /// The run is done; this is the content of its last file.
    Done(Value),
    /// It is to be done.
    Open(Folder),
}

/// Opens a run's folder, which is new, empty, or of the same run. `last` is the file that the run writes
/// last.
pub(crate) fn open(out: &Path, last: &str, run: &Run) -> Result<Opened, RunError> {
    match folder::inspect(out, last)? {
        Contents::Finished => {
            let done: Value = phase_files::json::read(&out.join(last))?;
            run.check(out, "a finished", &done["run"])?;
            folder::remove_leftovers(out, run)?;
            return Ok(Opened::Done(done));
        }
        Contents::Unfinished(other) => run.check(out, "an unfinished", &other)?,
        Contents::Nothing => {}
    }
    Ok(Opened::Open(Folder::claim(out, run)?))
}

pub(crate) fn create(folder: &Path) -> Result<(), RunError> {
    std::fs::create_dir_all(folder).map_err(|source| {
        RunError::Output(WriteError { path: folder.to_owned(), action: "create the folder", source })
    })
}
