//! The benchmark: every method at both tasks, compared with published results, in one report.
//!
//! [`plan`] selects the methods, `rows` has each of them evaluated, exactly as an evaluation alone would, and
//! the results are combined in one report. Evaluations stay in their folders, so a benchmark can be
//! interrupted and resumed.

pub mod plan;
mod rows;

use crate::{
    error::RunError,
    eval::{networks, task},
    listener::Listener,
};
use phase_document::document::Document;
use phase_eval::benchmark::Benchmark;
use phase_files::{
    WriteError, atomic,
    folder::{self, Contents, Folder},
    run::Run,
};
use phase_minds::MindKind;
use phase_report::evaluation;
use plan::entries;
use rows::Rows;
use std::path::{Path, PathBuf};

/// The benchmark's figures; written last.
const BENCHMARK_FILE: &str = "benchmark.json";
/// The default seed.
pub const SEED: u64 = 1;

/// A benchmark of methods on the test events of a dataset, and on others.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct BenchmarkRun {
    /// Folder of a finished dataset that is divided; methods are evaluated on its test events.
    pub data: PathBuf,
    /// Recordings to evaluate on, too: a `phase-events/1` file or a folder of events.
    pub real: Option<PathBuf>,
    /// Ratings by people of the relations of the recordings (`phase-ratings/1`).
    pub ratings: Option<PathBuf>,
    /// A dataset of sets to evaluate goals on, too; without the variants of SIMPLE and networks of `trained`.
    pub pairs: Option<PathBuf>,
    /// Names of methods, see [`plan::METHODS`]; all if empty.
    pub methods: Vec<String>,
    /// Minds that SIMPLE imagines, and no others.
    pub minds: Option<MindKind>,
    /// Files of weights of networks to evaluate, too.
    pub trained: Vec<PathBuf>,
    /// Files `results.json` of evaluations of the same events to show, too.
    pub results: Vec<PathBuf>,
    /// Only so many of the first events of each, at least 1.
    pub limit: Option<usize>,
    /// Random seed of methods and intervals.
    pub seed: u64,
    /// Folder with a folder for each method and task; finished evaluations are not repeated.
    pub evaluations: PathBuf,
    /// Folder for the report: new, empty, or of a benchmark, which is overwritten.
    pub out: PathBuf,
    /// File for the figures that documents show, a row on each line.
    pub figures: Option<PathBuf>,
    /// The part of the events to ask about, from 1, and the number of parts; without it all.
    pub shard: Option<(usize, usize)>,
    /// Folders of the evaluations of all parts, to take the answers from.
    pub merge: Vec<PathBuf>,
    /// Number of threads; without it that of this machine's cores.
    pub threads: Option<usize>,
}

impl BenchmarkRun {
    /// Evaluates every method that is not yet evaluated and writes the report; `None` if that is only a part,
    /// which is now done.
    ///
    /// # Errors
    /// If events, weights or a folder cannot be used, a method has no answer, a file cannot be written, or a
    /// stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<Option<(Benchmark, Document)>, RunError> {
        let entries = entries(self)?;
        let mut rows = Rows::open(self, listener)?;
        for file in &self.results {
            rows.add_results(file)?;
        }
        let out = &self.out;
        let run = Run::new([("command", "benchmark".into())]);
        if let Contents::Unfinished(other) = folder::inspect(out, BENCHMARK_FILE)? {
            run.check(out, "an unfinished", &other)?;
        }
        // A part has no report.
        let folder = match self.shard {
            None => Some(Folder::claim(out, &run)?),
            Some(_) => None,
        };
        let asked = entries.iter().map(|entry| (0..rows.sets()).filter(|&set| rows.asks(entry, set)).count());
        let all = asked.sum::<usize>();
        let mut begun = 0;
        for entry in &entries {
            let training = match &entry.weights {
                Some(file) => Some(networks::training_of(file)?),
                None => networks::training(&entry.method)?,
            };
            let training = training.map(|training| rows.add_training(training));
            for set in 0..rows.sets() {
                if !rows.asks(entry, set) {
                    continue;
                }
                begun += 1;
                listener.note(&format!("{begun} of {all}: {}, {}", entry.description(), rows.name(set)));
                rows.add(entry, training, set, listener)?;
            }
        }
        let Some(folder) = folder else { return Ok(None) };
        let benchmark = rows.finish();
        let document = evaluation::benchmark(&benchmark);
        task::write_report(out, &document)?;
        if let Some(file) = &self.figures {
            let text = evaluation::to_lines(&evaluation::figures(&benchmark));
            atomic::write(file, text.map_err(|error| WriteError::json(file, error))?.as_bytes())?;
        }
        atomic::write_json(&out.join(BENCHMARK_FILE), &benchmark)?;
        folder.finish()?;
        Ok(Some((benchmark, document)))
    }

    /// Whether any of the methods is a neural network.
    #[must_use]
    pub fn needs_networks(&self) -> bool {
        plan::needs_networks(self)
    }

    /// The options that determine what is measured, as a command line has them; those that are left at their
    /// defaults are left out.
    fn measured(&self) -> Vec<String> {
        let path = |path: &Path| path.display().to_string();
        let paths = |paths: &[PathBuf]| paths.iter().map(|it| path(it)).collect::<Vec<_>>();
        let one = |value: &Option<PathBuf>| paths(value.as_slice());
        let all = [
            ("--data", vec![path(&self.data)]),
            ("--real", one(&self.real)),
            ("--ratings", one(&self.ratings)),
            ("--pairs", one(&self.pairs)),
            ("--methods", if self.methods.is_empty() { Vec::new() } else { vec![self.methods.join(",")] }),
            ("--minds", self.minds.iter().map(|minds| minds.name().to_owned()).collect()),
            ("--trained", paths(&self.trained)),
            ("--results", paths(&self.results)),
            ("--limit", self.limit.iter().map(usize::to_string).collect()),
            ("--seed", if self.seed == SEED { Vec::new() } else { vec![self.seed.to_string()] }),
        ];
        let given = all.into_iter().filter(|(_, values)| !values.is_empty());
        given.flat_map(|(name, values)| [name.to_owned()].into_iter().chain(values)).collect()
    }
}
