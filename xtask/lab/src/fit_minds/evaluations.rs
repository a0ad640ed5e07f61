//! Evaluations of parameters on events: none is computed twice, and all are kept in a file.

use super::case::{Explanation, Method, MindsCase};
use crate::{
    error::LabError,
    evaluations_file::{EvaluationsFile, Line},
};
use phase_cli::{context::Context, error::CliError, output::json_text, parallel::Jobs};
use phase_files::checksum::{hexadecimal, sha256};
use phase_minds::PhaseParameters;
use phase_runs::{error::RunError, event_writer::program, parallel::make_all};
use std::collections::{BTreeMap, BTreeSet};

/// Hexadecimal digits of a key: 128 bits.
const KEY_DIGITS: usize = 32;

/// All that has been evaluated.
pub(super) struct Evaluations<'a> {
    cases: &'a [MindsCase<'a>],
    /// The method and the program, as they enter every key.
    made_by: String,
    known: BTreeMap<String, Explanation>,
    file: Option<EvaluationsFile>,
    jobs: &'a Jobs,
    context: &'a Context,
}

impl<'a> Evaluations<'a> {
    /// Evaluations on these events. Those in the file that this program made by the same method are reused.
    ///
    /// # Errors
    /// [`CliError::Serialise`].
    pub(super) fn new(
        cases: &'a [MindsCase<'a>],
        method: Method,
        kept: Option<(EvaluationsFile, Vec<Line<Explanation>>)>,
        jobs: &'a Jobs,
        context: &'a Context,
    ) -> Result<Self, CliError> {
        let made_by = json_text(&method, "the method")? + &hexadecimal(&program());
        let (file, lines) = kept.map_or_else(|| (None, Vec::new()), |(file, lines)| (Some(file), lines));
        let known = lines.into_iter().map(|line| (line.key, line.figures)).collect();
        Ok(Self { cases, made_by, known, file, jobs, context })
    }

    /// The figures of each wanted pair of parameters and event, in their order. What is not known is
    /// computed, and `activity` says what for.
    ///
    /// # Errors
    /// Parameters that minds do not accept, a file that cannot be written, or an interruption.
    pub(super) fn of(
        &mut self,
        wanted: &[(PhaseParameters, usize)],
        activity: &str,
    ) -> Result<Vec<Explanation>, LabError> {
        let keys = wanted.iter().map(|(parameters, event)| self.key(*parameters, *event));
        let keys: Vec<String> = keys.collect::<Result<_, _>>()?;
        let mut seen = BTreeSet::new();
        let tasks = keys.iter().zip(wanted.iter().copied());
        let tasks: Vec<(&String, (PhaseParameters, usize))> =
            tasks.filter(|(key, _)| !self.known.contains_key(*key) && seen.insert(*key)).collect();
        if !tasks.is_empty() {
            let computed = self.compute(&tasks, activity)?;
            self.known.extend(tasks.iter().map(|(key, _)| (*key).clone()).zip(computed));
        }
        Ok(keys.iter().filter_map(|key| self.known.get(key).copied()).collect())
    }

    fn compute(
        &self,
        tasks: &[(&String, (PhaseParameters, usize))],
        activity: &str,
    ) -> Result<Vec<Explanation>, LabError> {
        let progress =
            self.context.progress_over(&format!("{activity}: {} evaluations", tasks.len()), tasks.len());
        let computed = make_all(self.jobs.threads(), tasks.len(), |k| {
            let (key, (parameters, event)) = &tasks[k];
            let case = &self.cases[*event];
            let Some(figures) = case.evaluate(*parameters)? else { return Ok(None) };
            if let Some(file) = &self.file {
                file.add(&Line { key: (*key).clone(), event: case.id.to_owned(), figures })?;
            }
            progress.step();
            Ok(Some(figures))
        })?;
        drop(progress);
        computed.ok_or_else(|| match &self.file {
            Some(file) => RunError::Interrupted(file.path().to_owned()).into(),
            None => LabError::Interrupted,
        })
    }

    /// A name of everything that determines an evaluation.
    fn key(&self, parameters: PhaseParameters, event: usize) -> Result<String, CliError> {
        let parameters = json_text(&parameters, "a set of parameters")?;
        let all = format!("{} {} {parameters}", self.made_by, self.cases[event].digest);
        let mut key = hexadecimal(&sha256(all.as_bytes()));
        key.truncate(KEY_DIGITS);
        Ok(key)
    }
}
