//! An evaluation in several parts: `shard.json` in the folder of a part, and the parts that are merged.

use super::task::{AnswerStore, EVENTS};
use crate::{error::RunError, resume::check_complete};
use phase_files::{FileError, Problem, atomic, json, run::Run};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The file that is written last in the folder of a part.
pub(super) const SHARD_FILE: &str = "shard.json";
/// The value of its field `format`.
const SHARD_FORMAT: &str = "phase-eval-shard/1";
/// The member of a run that says which part it is.
const SHARD: &str = "shard";

/// A part of an evaluation: the events k − 1, k − 1 + n, k − 1 + 2 n …
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EvaluationShard {
    format: String,
    /// Number of the part, from 1.
    shard: usize,
    /// Of how many.
    of: usize,
    /// The evaluation, as in its results.
    whole: Value,
    /// Digest of the program that asked the method.
    program: String,
}

impl EvaluationShard {
    /// The run of the folder.
    pub(super) fn run(&self) -> Value {
        let mut run = self.whole.clone();
        if let Some(members) = run.as_object_mut() {
            members.insert(SHARD.into(), shard_name(self.shard, self.of).into());
        }
        run
    }
}

/// The identity of a run, of the whole or of a part.
pub(super) fn run_of(whole: &Run, shard: Option<(usize, usize)>) -> Run {
    shard.map_or_else(|| whole.clone(), |(shard, of)| whole.clone().with(SHARD, shard_name(shard, of)))
}

/// Marks a part as done.
pub(super) fn write(out: &Path, shard: usize, of: usize, whole: &Run, program: &str) -> Result<(), RunError> {
    let format = SHARD_FORMAT.into();
    let whole = whole.value().clone();
    let part = EvaluationShard { format, shard, of, whole, program: program.into() };
    Ok(atomic::write_json(&out.join(SHARD_FILE), &part)?)
}

/// Reads what a folder is a part of.
pub(super) fn read(folder: &Path) -> Result<EvaluationShard, RunError> {
    let file = folder.join(SHARD_FILE);
    if folder.is_dir() && !file.exists() {
        let rule = format!("holds no finished part of an evaluation (no {SHARD_FILE})");
        return Err(RunError::Usage(format!("{}: {rule}", folder.display())));
    }
    let fail = |problem| FileError { file: file.clone(), problem };
    let what = "shard of an evaluation";
    let part: EvaluationShard = json::read_format(&file, SHARD_FORMAT, what)?;
    if part.shard == 0 || part.shard > part.of {
        let rule = format!("there is no shard {} of {}", part.shard, part.of);
        return Err(fail(Problem::Shape { what, rule }).into());
    }
    Ok(part)
}

/// All parts of an evaluation, in order.
pub(super) struct Merged(Vec<AnswerStore>);

/// Opens the parts, in any order; `None` if there are none. All parts of the evaluation must be there, made
/// by one program.
pub(super) fn open(folders: &[PathBuf], whole: &Run) -> Result<Option<Merged>, RunError> {
    let mut parts = Vec::new();
    for folder in folders {
        let part = read(folder)?;
        whole.check(folder, "a part of a", &part.whole)?;
        parts.push((part, folder));
    }
    parts.sort_by_key(|(part, _)| part.shard);
    let Some((first, place)) = parts.first() else { return Ok(None) };
    for (part, folder) in &parts {
        if part.of != first.of || part.program != first.program {
            let folder = folder.display();
            let place = place.display();
            let rule = "is no part of the same division by the same program as";
            return Err(RunError::Usage(format!("{folder}: {rule} {place}")));
        }
    }
    check_complete(first.of, parts.iter().map(|(part, folder)| (part.shard, folder.as_path())))?;
    let store = |(part, folder): (EvaluationShard, &PathBuf)| AnswerStore {
        folder: folder.join(EVENTS),
        program: part.program,
    };
    Ok(Some(Merged(parts.into_iter().map(store).collect())))
}

impl Merged {
    /// The part with the answer to an event, by its number from 0.
    pub(super) fn store(&self, event: usize) -> &AnswerStore {
        &self.0[event % self.0.len()]
    }
}

fn shard_name(shard: usize, of: usize) -> String {
    format!("{shard}/{of}")
}
