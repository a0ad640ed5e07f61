//! Simulations against the recordings they started from: `summary.json` and its table.

use crate::{
    FileError, Problem,
    checksum::FileEntry,
    json,
    phase_events::{self, Recording},
};
use phase_evidence::{Outcome, Track, statistics::median};
use phase_model::{AGENT_COUNT, EventKind, Goal};
use phase_sim::Event;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// The value of the field `format` of summaries.
pub const SUMMARY_FORMAT: &str = "phase-simulation/1";
/// The summary's file name. It is written last: a folder with a summary is complete.
pub const SUMMARY_FILE: &str = "summary.json";

/// What came out of simulating the scenes of a file.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// Always [`SUMMARY_FORMAT`].
    pub format: String,
    /// The run: program, input, seed, settings.
    pub run: Value,
    /// One line for each kind of event, and one for all.
    pub kinds: Vec<KindRow>,
    /// The events, in the order of the input.
    pub events: Vec<Comparison>,
}

/// One event, recorded and simulated.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Comparison {
    /// The event's id in the input.
    pub id: String,
    /// Its kind.
    pub kind: EventKind,
    /// Steps of the recording (0 if the input had the start alone).
    pub recorded_steps: usize,
    /// Steps of the simulation.
    pub simulated_steps: usize,
    /// The agents.
    pub agents: [AgentComparison; AGENT_COUNT],
    /// The simulated event.
    pub event: FileEntry,
    /// Its video, if one was made.
    pub video: Option<FileEntry>,
}

/// What became of one agent's goal in both.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AgentComparison {
    /// The goal.
    pub goal: Goal,
    /// Social utility weight.
    pub alpha: i8,
    /// In the recording.
    pub recorded: Outcome,
    /// In the simulation.
    pub simulated: Outcome,
}

/// All events of one kind; `None` stands for all kinds together.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KindRow {
    /// The kind.
    pub kind: Option<EventKind>,
    /// Events that have a recording.
    pub events: usize,
    /// Agents in them: twice as many.
    pub agents: usize,
    /// Agents whose goal was reached in both or in neither.
    pub matched: usize,
    /// Agents whose goal was reached in the recording.
    pub recorded_reached: usize,
    /// Agents whose goal was reached in the simulation.
    pub simulated_reached: usize,
    /// Agents whose positive goal was reached in both; the medians below are over them.
    pub timed: usize,
    /// Median steps to the goal in the recording.
    pub recorded_steps: Option<f64>,
    /// Median steps to the goal in the simulation.
    pub simulated_steps: Option<f64>,
}

impl Comparison {
    /// Compares a recording with its simulation, whose files are in a folder already.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn of(folder: &Path, recording: &Recording, event: &Event, video: bool) -> Result<Self, FileError> {
        let recorded = Track { physique: recording.scene.physique(), states: recording.trajectory.states() };
        let simulated = Track::of_event(event);
        let id = recording.id.clone();
        Ok(Self {
            kind: recording.scene.kind,
            recorded_steps: recording.trajectory.steps(),
            simulated_steps: event.steps.len(),
            agents: recording.scene.agents.map(|agent| AgentComparison {
                goal: agent.goal,
                alpha: agent.attitude.alpha(),
                recorded: Outcome::of(&recorded, agent.goal),
                simulated: Outcome::of(&simulated, agent.goal),
            }),
            event: FileEntry::of(folder, format!("{id}.json"))?,
            video: video.then(|| FileEntry::of(folder, format!("{id}.mp4"))).transpose()?,
            id,
        })
    }
}

impl Summary {
    /// Puts the comparisons of a run together.
    #[must_use]
    pub fn new(run: Value, events: Vec<Comparison>) -> Self {
        Self { format: SUMMARY_FORMAT.into(), run, kinds: tabulate(&events), events }
    }

    /// Reads a summary.
    ///
    /// # Errors
    /// If it is no JSON, of another format, or incomplete.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let fail = |problem| FileError { file: path.to_owned(), problem };
        let value = json::read(path)?;
        phase_events::check_format(&value, SUMMARY_FORMAT).map_err(fail)?;
        serde_json::from_value(value)
            .map_err(|error| fail(Problem::Shape { what: "summary", rule: error.to_string() }))
    }

    /// The summary as a file's text.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Writing plain data of ours to a string cannot fail.
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        format!("{text}\n")
    }

    /// Checks that every file is there and unchanged.
    ///
    /// # Errors
    /// Names the first file that is not.
    pub fn verify(&self, folder: &Path) -> Result<(), FileError> {
        let files = self.events.iter().flat_map(|event| [Some(&event.event), event.video.as_ref()]);
        files.flatten().try_for_each(|file| file.verify(folder))
    }

    /// The table for people, with a line for each kind and one for all.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = String::from(
            "kind            events   outcome as recorded   reached: recorded  simulated   \
             median steps: recorded  simulated  (agents)\n",
        );
        for row in &self.kinds {
            let kind = row.kind.map_or("all", EventKind::name);
            let share = 100.0 * row.matched as f64 / row.agents.max(1) as f64;
            let steps =
                |median: Option<f64>| median.map_or_else(|| "-".into(), |steps| format!("{steps:.1}"));
            text.push_str(&format!(
                "{kind:<14} {:>7}   {:>7} of {:>3} {share:>4.0} %   {:>17} {:>10}   {:>22} {:>10}  {:>8}\n",
                row.events,
                row.matched,
                row.agents,
                row.recorded_reached,
                row.simulated_reached,
                steps(row.recorded_steps),
                steps(row.simulated_steps),
                format!("({})", row.timed),
            ));
        }
        text
    }
}

/// One row for each kind that occurs, in the kinds' order, and one for all. Events without a recording do not
/// count.
#[must_use]
pub fn tabulate(events: &[Comparison]) -> Vec<KindRow> {
    let recorded: Vec<&Comparison> = events.iter().filter(|event| event.recorded_steps > 0).collect();
    let of_kind = |kind| recorded.iter().copied().filter(|event| event.kind == kind).collect::<Vec<_>>();
    let rows = EventKind::ALL.map(|kind| row(Some(kind), &of_kind(kind)));
    rows.into_iter().filter(|row| row.events > 0).chain([row(None, &recorded)]).collect()
}

fn row(kind: Option<EventKind>, events: &[&Comparison]) -> KindRow {
    let agents: Vec<&AgentComparison> = events.iter().flat_map(|event| &event.agents).collect();
    let count = |condition: fn(&AgentComparison) -> bool| agents.iter().filter(|it| condition(it)).count();
    let timed = agents.iter().filter_map(|it| Some((it.recorded.steps?, it.simulated.steps?)));
    let (recorded, simulated): (Vec<usize>, Vec<usize>) = timed.unzip();
    KindRow {
        kind,
        events: events.len(),
        agents: agents.len(),
        matched: count(|it| it.recorded.reached == it.simulated.reached),
        recorded_reached: count(|it| it.recorded.reached),
        simulated_reached: count(|it| it.simulated.reached),
        timed: recorded.len(),
        recorded_steps: median(&recorded),
        simulated_steps: median(&simulated),
    }
}
