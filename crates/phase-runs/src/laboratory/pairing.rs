//! Kinds of events matched in low-level motion.

use super::tables::Table;
use crate::{error::RunError, interrupt, listener::Listener, parallel::make_all, source::EventInput, words};
use phase_files::atomic;
use phase_laboratory::{
    clip::seconds_of,
    matching::{Candidate, Matched, matched},
    regressors::{COLUMNS, motion},
};
use phase_model::State;
use serde_json::json;
use std::path::PathBuf;

/// The value of the field `format` of the result.
const MATCH_FORMAT: &str = "phase-match/1";

/// Measures to match on, each with its unit: length of the event and means over frames, of an agent's
/// measures also over both agents; a path is as long as the mean of both.
pub const MEASURES: [(&str, &str); 7] = [
    ("length", "s"),
    ("path", "u"),
    ("speed", "u/s"),
    ("acceleration", "u/s^2"),
    ("distance", "u"),
    ("contact", "share of time"),
    ("motion_energy", "luminance, 0 to 255"),
];

/// A run that finds groups of events, one of each kind, alike in motion.
#[derive(Clone, Debug)]
pub struct Pairing {
    /// The events.
    pub events: PathBuf,
    /// Only these, if there are any.
    pub ids: Vec<String>,
    /// Names of [`MEASURES`].
    pub on: Vec<String>,
    /// Only these kinds, if there are any.
    pub kinds: Vec<String>,
    /// Most that two events of a group may differ in a measure (standard deviations).
    pub caliper: f64,
    /// The folder to write.
    pub out: PathBuf,
    /// Number of events at once.
    pub threads: usize,
}

impl Pairing {
    /// Matches the events, and writes `match.json`, `groups.csv` and `measures.csv`.
    ///
    /// # Errors
    /// If the events cannot be used or a file not be written, or there is nothing to match.
    pub fn run(&self, listener: &dyn Listener) -> Result<Matched, RunError> {
        if let Some(unknown) = self.on.iter().find(|name| MEASURES.iter().all(|(known, _)| known != name)) {
            let known: Vec<&str> = MEASURES.iter().map(|(name, _)| *name).collect();
            return Err(RunError::Usage(format!(
                "--on: there is no measure {unknown:?}; there are {}",
                known.join(", ")
            )));
        }
        let source = EventInput::open(&self.events, &self.ids, listener)?;
        let progress =
            listener.progress(&format!("measuring {}", words::events(source.len())), source.len(), 1);
        let measured = make_all(self.threads, source.len(), |index| {
            let recording = source.load(index)?;
            let kind = recording.scene.kind.name();
            if !self.kinds.is_empty() && !self.kinds.iter().any(|wanted| wanted == kind) {
                return Ok(Some(None));
            }
            if interrupt::requested() {
                return Ok(None);
            }
            let states: Vec<State> = recording.frames().collect();
            let frames = motion(&recording.scene.physics(), &states)
                .map_err(|source| RunError::Render { id: recording.id.clone(), source })?;
            let mean = phase_laboratory::regressors::mean(&frames);
            let column = |name: &str| {
                COLUMNS
                    .iter()
                    .zip(mean)
                    .find(|((column, ..), _)| *column == name)
                    .map_or(f64::NAN, |(_, value)| value)
            };
            let seconds = seconds_of(recording.trajectory.steps());
            let agents =
                |name: &str| 0.5 * (column(&format!("red_{name}")) + column(&format!("green_{name}")));
            let measure = |name: &String| match name.as_str() {
                "length" => seconds,
                "path" => agents("speed") * seconds,
                "distance" | "motion_energy" => column(name),
                _ => agents(name),
            };
            progress.event(0, &recording.id);
            let measures = self.on.iter().map(measure).collect();
            Ok(Some(Some(Candidate { id: recording.id.clone(), kind: kind.to_owned(), measures })))
        })?;
        drop(progress);
        let measured = measured.ok_or(RunError::Stopped(None))?;
        let candidates: Vec<Candidate> = measured.into_iter().flatten().collect();
        let result = matched(&self.on, &candidates, self.caliper)
            .map_err(|error| RunError::Usage(format!("{}: {error}", self.events.display())))?;
        super::create(&self.out)?;
        let mut groups = Table::default();
        result.kinds.iter().for_each(|kind| groups.column(kind.clone(), "", ""));
        groups.rows.clone_from(&result.groups);
        groups.write_csv(&self.out.join("groups.csv"))?;
        let mut measures = Table::default();
        ["id", "kind"]
            .into_iter()
            .chain(self.on.iter().map(String::as_str))
            .for_each(|name| measures.column(name, "", ""));
        measures.column("group", "", "");
        for event in &candidates {
            let group = result.groups.iter().position(|group| group.contains(&event.id));
            let mut row = vec![event.id.clone(), event.kind.clone()];
            row.extend(event.measures.iter().map(|value| format!("{value:.6}")));
            row.push(group.map_or_else(String::new, |group| (group + 1).to_string()));
            measures.rows.push(row);
        }
        measures.write_csv(&self.out.join("measures.csv"))?;
        let file =
            json!({ "format": MATCH_FORMAT, "on": self.on, "caliper": self.caliper, "matched": result });
        atomic::write_json(&self.out.join("match.json"), &file)?;
        Ok(result)
    }
}
