//! Sources of answers: one of PHASE's methods, or a predictions file.

use super::{
    Answers,
    input::{Event, Input},
};
use crate::{effort::MindChoice, error::RunError, listener::Listener};
use cpu_time::ThreadTime;
use phase_event::{EventReadError, MethodError};
use phase_files::{
    FileError, Problem,
    checksum::{hexadecimal, sha256},
    json,
};
use phase_model::json::FieldError;
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};

/// The answers of a method, by its name in folders and reports.
pub(crate) struct AnswerSource<M: ?Sized, A> {
    /// The name.
    pub(super) name: String,
    kind: Kind<M, A>,
}

enum Kind<M: ?Sized, A> {
    /// A method of PHASE.
    Method(Box<M>),
    /// An external method.
    PredictionsFile(PredictionsFile<A>),
}

/// The answer to an event with details of the method, and the CPU time for it (s) where a method was asked;
/// `None` if it was cancelled.
pub(super) type Answered<A> = Option<(A, Value, Option<f64>)>;

impl<M: ?Sized, A: Clone> AnswerSource<M, A> {
    /// The answers of one of PHASE's methods, which `method` finds, or those that `file` reads.
    pub(super) fn of(
        answers: &Answers,
        method: impl FnOnce(&str, Option<&Path>, &MindChoice) -> Result<Box<M>, RunError>,
        file: impl FnOnce(&Path) -> Result<PredictionsFile<A>, RunError>,
    ) -> Result<Self, RunError> {
        match answers {
            Answers::Predictions(path) => {
                let given = file(path)?;
                Ok(Self { name: given.name.clone(), kind: Kind::PredictionsFile(given) })
            }
            Answers::Method { name, weights, minds } => {
                Ok(Self::of_method(&minds.name(name), method(name, weights.as_deref(), minds)?))
            }
        }
    }

    /// The answers of a method, under any name.
    pub(crate) fn of_method(name: &str, method: Box<M>) -> Self {
        Self { name: name.into(), kind: Kind::Method(method) }
    }

    /// Whether the answers come from a file.
    pub(super) const fn is_external(&self) -> bool {
        matches!(self.kind, Kind::PredictionsFile(_))
    }

    /// The method, unless the answers come from a file.
    pub(super) fn method(&self) -> Option<&M> {
        match &self.kind {
            Kind::Method(method) => Some(method),
            Kind::PredictionsFile(_) => None,
        }
    }

    /// Everything that determines the answers: what `of_method` says of a method, or the contents of the
    /// file.
    pub(super) fn settings(&self, of_method: impl FnOnce(&M) -> Value) -> Value {
        match &self.kind {
            Kind::Method(method) => of_method(method),
            Kind::PredictionsFile(given) => json!({ "predictions_sha256": given.sha256 }),
        }
    }

    /// The answer to an event: the file's, or the one that `ask` gets from the method, with the CPU time that
    /// it takes.
    pub(super) fn answer(
        &self,
        event: &Event,
        ask: impl FnOnce(&M) -> Result<Option<(A, Value)>, MethodError>,
    ) -> Result<Answered<A>, MethodError> {
        match &self.kind {
            Kind::PredictionsFile(given) => {
                let answer = given.answers.get(&event.id).cloned();
                let answer = answer.ok_or_else(|| MethodError::new("has no prediction"))?;
                Ok(Some((answer, Value::Null, None)))
            }
            Kind::Method(method) => {
                let begun = ThreadTime::now();
                let asked = ask(method)?;
                let cpu_seconds = begun.elapsed().as_secs_f64();
                Ok(asked.map(|(answer, details)| (answer, details, Some(cpu_seconds))))
            }
        }
    }
}

/// The answers of a file, one for each requested event.
pub(super) struct PredictionsFile<A> {
    /// The name of the method: the file's member `method`, or else the file's name without its ending.
    name: String,
    answers: BTreeMap<String, A>,
    sha256: String,
}

impl<A> PredictionsFile<A> {
    /// Reads a file. `parse` finds the answers by the ids of their events, `fit` adapts each to its event.
    pub(super) fn read(
        file: &Path,
        input: &Input,
        listener: &dyn Listener,
        parse: impl Fn(&Value) -> Result<BTreeMap<String, A>, EventReadError>,
        fit: impl Fn(&Event, A) -> Result<A, FieldError>,
    ) -> Result<Self, RunError> {
        let value = json::read(file)?;
        let fail =
            |error: EventReadError| FileError { file: file.to_owned(), problem: Problem::content(error) };
        // A file of results says which method it scored; it is named after the file.
        let named = value.get("method").filter(|_| value.get("format").is_none());
        let name = match named {
            None | Some(Value::Null) => file.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            Some(Value::String(name)) => name.clone(),
            Some(_) => {
                let problem = FieldError { field: "method".into(), rule: "must be text".into() };
                return Err(fail(EventReadError::Field { event: None, problem }).into());
            }
        };
        let mut others = parse(&value).map_err(fail)?;
        let ids = input.events.iter().map(|event| event.id.as_str());
        let missing: Vec<&str> = ids.filter(|id| !others.contains_key(*id)).collect();
        if !missing.is_empty() {
            let known = others.keys().map(String::as_str);
            return Err(RunError::no_answers(file, &missing, input.events.len(), &input.description, known));
        }
        let mut answers = BTreeMap::new();
        for event in &input.events {
            let Some(answer) = others.remove(&event.id) else { continue };
            let wrong = |problem| fail(EventReadError::Field { event: Some(event.id.clone()), problem });
            answers.insert(event.id.clone(), fit(event, answer).map_err(wrong)?);
        }
        if !others.is_empty() {
            let others = others.len();
            listener.note(&format!("note: {}: {others} of its events are not evaluated", file.display()));
        }
        Ok(Self { name, answers, sha256: hexadecimal(&sha256(value.to_string().as_bytes())) })
    }
}
