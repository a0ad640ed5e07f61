//! Task 1: how often goals and relations are recognised.

use super::{
    input::{Event, Input},
    methods,
    options::{EvalGoals, steps_of},
    task::{self, Task},
};
use crate::{console::remark, error::CliError};
use cpu_time::ThreadTime;
use phase_dataset::{
    FileError,
    checksum::{hexadecimal, sha256},
    json,
    phase_events::Recording,
};
use phase_eval::{
    MethodError, Recogniser, Tick,
    goals::{Answer, Glimpse, Label, RecognisedEvent, Summary},
    predictions,
    report::{self, Document, Subject},
    results,
};
use phase_model::ObservedEvent;
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub(super) fn run(arguments: &EvalGoals) -> Result<(), CliError> {
    let input = Input::open(&arguments.common)?;
    let goals = match (&arguments.predictions, &arguments.method) {
        (Some(file), _) => Goals::given(file, &input)?,
        (None, method) => {
            let name = method.clone().unwrap_or_default();
            let recogniser = methods::recogniser(&name, arguments.weights.as_deref())?;
            let mut watched = arguments.watched.clone();
            watched.sort_by(f64::total_cmp);
            watched.dedup();
            Goals { name, answers: Answers::Method(recogniser), watched }
        }
    };
    task::run(&goals, &input, &arguments.common)
}

/// The task.
struct Goals {
    name: String,
    answers: Answers,
    /// Parts of each event to ask about too, by their lengths (s).
    watched: Vec<f64>,
}

/// Where answers come from.
enum Answers {
    /// A method of ours.
    Method(Box<dyn Recogniser>),
    /// Somebody else's, by id, from a file with this checksum.
    Given(BTreeMap<String, Answer>, String),
}

impl Goals {
    /// The answers of a file; there has to be one to each event.
    fn given(file: &Path, input: &Input) -> Result<Self, CliError> {
        let value = json::read(file)?;
        let fail = |problem| FileError { file: file.to_owned(), problem };
        let answers = predictions::parse(&value).map_err(fail)?;
        if let Some(event) = input.events.iter().find(|event| !answers.contains_key(&event.id)) {
            return Err(CliError::unknown_id(file, &event.id, answers.keys().map(String::as_str)));
        }
        let others = answers.len() - input.events.len();
        if others > 0 {
            remark(format!("note: {}: {others} of its events are not asked for", file.display()));
        }
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let sha256 = hexadecimal(&sha256(value.to_string().as_bytes()));
        Ok(Self { name, answers: Answers::Given(answers, sha256), watched: Vec::new() })
    }
}

impl Task for Goals {
    type Answered = RecognisedEvent;

    const NAME: &'static str = "goals";

    fn method(&self) -> &str {
        &self.name
    }

    fn settings(&self) -> Value {
        match &self.answers {
            Answers::Method(method) => json!({ "method": method.settings(), "watched": self.watched }),
            Answers::Given(_, sha256) => json!({ "predictions_sha256": sha256 }),
        }
    }

    fn ticks(&self) -> usize {
        match &self.answers {
            Answers::Method(method) => method.ticks() * (1 + self.watched.len()),
            Answers::Given(..) => 1,
        }
    }

    fn check(&self, _: &Event) -> Result<(), CliError> {
        Ok(())
    }

    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: Tick<'_>,
    ) -> Result<Option<RecognisedEvent>, MethodError> {
        let (answer, details, cpu_seconds, watched) = match &self.answers {
            Answers::Given(answers, _) => {
                let answer = answers.get(&event.id).cloned();
                let missing = || MethodError("has no prediction".into());
                (answer.ok_or_else(missing)?, Value::Null, None, Vec::new())
            }
            Answers::Method(method) => {
                let observed = recording.observed().map_err(|error| MethodError(error.to_string()))?;
                let begun = ThreadTime::now();
                let judged = judge(method.as_ref(), &observed, seed, tick)?;
                let cpu_seconds = begun.elapsed().as_secs_f64();
                let Some((answer, details)) = judged else { return Ok(None) };
                let mut watched = Vec::with_capacity(self.watched.len());
                for &seconds in &self.watched {
                    let part = observed.watched_for(steps_of(seconds));
                    let Some((answer, _)) = judge(method.as_ref(), &part, seed, tick)? else {
                        return Ok(None);
                    };
                    watched.push(Glimpse { seconds, answer });
                }
                (answer, details, Some(cpu_seconds), watched)
            }
        };
        let label = label(event, recording);
        Ok(Some(RecognisedEvent { id: event.id.clone(), answer, label, watched, cpu_seconds, details }))
    }

    fn sum_up(
        &self,
        run: &Value,
        subject: Subject<'_>,
        events: &[RecognisedEvent],
    ) -> Option<(Value, Document)> {
        let summary = Summary::of(events, subject.seed)?;
        Some((results::goals(run, &summary, events), report::goals(subject, &summary)))
    }
}

fn judge(
    method: &dyn Recogniser,
    observed: &ObservedEvent,
    seed: u64,
    tick: Tick<'_>,
) -> Result<Option<(Answer, Value)>, MethodError> {
    let Some((judgement, details)) = method.judge(observed, seed, tick)? else { return Ok(None) };
    let answer = Answer::of(&judgement).map_err(|error| MethodError(format!("the method's {error}")))?;
    Ok(Some((answer, details)))
}

fn label(event: &Event, recording: &Recording) -> Label {
    Label {
        kind: recording.scene.kind,
        goals: recording.scene.goals(),
        relation: recording.relation,
        relation_human: recording.relation_human,
        layout_seen: event.layout_seen,
    }
}
