//! Answers to events without labels, which cannot be scored.

use super::{Answers, Evaluation, goals, methods, task};
use crate::{
    error::RunError,
    interrupt,
    listener::Listener,
    parallel::{self, make_all},
    words,
};
use cpu_time::ThreadTime;
use phase_dataset::phase_events::{self, Read};
use phase_eval::{goals::Answer, results::GOALS_FORMAT};
use phase_event::{MethodError, ObservedEvent};
use phase_files::atomic;
use serde::Serialize;
use serde_json::{Value, json};
use std::path::PathBuf;

/// A method's answer to an event.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Answered {
    /// The event's name.
    pub id: String,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
    /// CPU time that it took (s).
    pub cpu_seconds: f64,
    /// All that nobody can judge of the event, each as a sentence.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_judged: Vec<String>,
    /// Details that the method adds.
    pub details: Value,
}

impl Evaluation {
    /// The events, if they are those of a file without labels.
    ///
    /// # Errors
    /// If the file cannot be used.
    pub fn unlabelled(&self) -> Result<Option<Vec<(String, ObservedEvent)>>, RunError> {
        if self.events.is_dir() {
            return Ok(None);
        }
        match phase_events::read_any(&self.events)? {
            Read::Labelled(_) => Ok(None),
            Read::Unlabelled(events) => Ok(Some(events)),
        }
    }

    /// Asks a method about events without labels. The answers are written to a file that can be given as
    /// predictions once there are labels.
    ///
    /// # Errors
    /// Those of [`Evaluation::goals`], and [`RunError::Usage`] for options that need labels.
    pub fn answers(
        &self,
        answers: &Answers,
        events: &[(String, ObservedEvent)],
        listener: &dyn Listener,
    ) -> Result<(Vec<Answered>, PathBuf), RunError> {
        let file = self.events.display();
        let Answers::Method { name, weights, minds } = answers else {
            return Err(RunError::Usage(format!(
                "{file}: field `event` and `goal` of agents are needed to score predictions, and some are absent"
            )));
        };
        let unusable = self.split.is_some()
            || self.ratings.is_some()
            || self.shard.is_some()
            || !(self.watched.is_empty() && self.merge.is_empty());
        if unusable {
            return Err(RunError::Usage(format!(
                "{file}: has no labels, which --split, --ratings, --watched, --shard and --merge need"
            )));
        }
        let method = methods::recogniser(name, weights.as_deref(), minds)?;
        let events = &events[..self.limit.unwrap_or(usize::MAX).min(events.len())];
        let activity = format!("asking {name} about {}", words::events(events.len()));
        let progress = listener.progress(&activity, events.len(), method.ticks());
        let all = make_all(parallel::threads(self.threads), events.len(), |k| {
            let (id, observed) = &events[k];
            let failed = |source: MethodError| RunError::Method { id: id.clone(), source };
            let begun = ThreadTime::now();
            let mut tick = || {
                progress.steps(1);
                interrupt::goes_on()
            };
            let asked = goals::judge(&*method, observed, task::event_seed(self.seed, id), &mut tick);
            let Some((answer, details)) = asked.map_err(failed)? else { return Ok(None) };
            progress.event(method.ticks(), id);
            let cpu_seconds = begun.elapsed().as_secs_f64();
            let not_judged = observed.missing().sentences();
            Ok(Some(Answered { id: id.clone(), answer, cpu_seconds, not_judged, details }))
        })?;
        drop(progress);
        let stem = self.events.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let folder = self.out.clone().unwrap_or_else(|| format!("out/eval/goals-{name}-{stem}").into());
        let Some(all) = all else { return Err(RunError::Interrupted(folder)) };
        let file = folder.join("answers.json");
        std::fs::create_dir_all(&folder).map_err(|source| {
            RunError::Output(phase_files::WriteError {
                path: folder.clone(),
                action: "create the folder",
                source,
            })
        })?;
        let document = json!({ "format": GOALS_FORMAT, "method": name, "events": all });
        atomic::write_json(&file, &document).map_err(RunError::Output)?;
        Ok((all, file))
    }
}
