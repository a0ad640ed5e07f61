//! Motion in each video, as a table, and by condition.

use crate::{
    error::RunError,
    listener::{Listener, Silent},
    parallel::{self, make_all},
    source::EventInput,
    words,
};
use phase_dataset::manifest::{MANIFEST_FILE, Manifest};
use phase_evidence::{Track, VideoMotion};
use phase_statistics::{mean, standard_deviation};
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};

/// File name of the table, which has a row for each event.
pub(crate) const MOTION_FILE: &str = "motion.csv";

/// A measure: its column, whose end is its unit, and its value.
type Measure = (&'static str, fn(&VideoMotion) -> f64);

/// The measures, in the order of their columns.
const MEASURES: [Measure; 11] = [
    ("path_0_u", |it| it.path[0]),
    ("path_1_u", |it| it.path[1]),
    ("speed_0_u_per_s", |it| it.speed[0]),
    ("speed_1_u_per_s", |it| it.speed[1]),
    ("acceleration_0_u_per_s2", |it| it.acceleration[0]),
    ("acceleration_1_u_per_s2", |it| it.acceleration[1]),
    ("distance_u", |it| it.distance),
    ("least_distance_u", |it| it.least_distance),
    ("agents_touch_share", |it| it.agents_touch),
    ("contact_0_share", |it| it.contact[0]),
    ("contact_1_share", |it| it.contact[1]),
];

/// An event and its motion.
#[derive(Clone, Debug)]
struct Row {
    id: String,
    set: String,
    /// The stance of the agent that differs in a set, else the kind of event.
    condition: String,
    motion: VideoMotion,
}

/// The motion in all videos of a dataset or of other events.
#[derive(Clone, Debug)]
pub(crate) struct Motions(Vec<Row>);

impl Motions {
    /// Measures the events of a file or folder. Those without steps are left out.
    ///
    /// # Errors
    /// If an event cannot be used; [`RunError::Threads`].
    pub(crate) fn of(path: &Path, threads: Option<usize>, listener: &dyn Listener) -> Result<Self, RunError> {
        let manifest = path.join(MANIFEST_FILE);
        let manifest = manifest.is_file().then(|| Manifest::read(&manifest)).transpose()?;
        let entries = manifest.iter().flat_map(|manifest| &manifest.events);
        let places: BTreeMap<&str, _> =
            entries.filter_map(|entry| Some((entry.id.as_str(), entry.set.as_ref()?))).collect();
        // Warnings about events have been printed by the first reader.
        let source = EventInput::open(path, &[], &Silent)?;
        let count = source.len();
        let progress = listener.progress_over(&format!("measuring {}", words::events(count)), count);
        let rows = make_all(parallel::threads(threads), count, |index| {
            let recording = source.load(index)?;
            progress.steps(1);
            let states = recording.trajectory.states();
            let track = Track { physics: recording.scene.physics(), states };
            let place = places.get(recording.id.as_str());
            let condition =
                place.map_or_else(|| recording.scene.kind.name(), |place| place.stance.name()).to_owned();
            let set = place.map_or_else(String::new, |place| place.set.clone());
            let id = recording.id.clone();
            Ok(Some(VideoMotion::of(&track).map(|motion| Row { id, set, condition, motion })))
        })?;
        Ok(Self(rows.unwrap_or_default().into_iter().flatten().collect()))
    }

    /// The table, in CSV. Ids and names need no quotes.
    pub(crate) fn to_csv(&self) -> String {
        let columns = MEASURES.map(|(name, _)| name).join(",");
        let mut text = format!("id,set,condition,duration_s,{columns}\n");
        for Row { id, set, condition, motion } in &self.0 {
            let values = MEASURES.map(|(_, of)| format!("{:.4}", of(motion))).join(",");
            text += &format!("{id},{set},{condition},{:.2},{values}\n", motion.seconds);
        }
        text
    }

    fn by_condition(&self) -> BTreeMap<&str, Vec<&VideoMotion>> {
        let mut groups = BTreeMap::<&str, Vec<&VideoMotion>>::new();
        for row in &self.0 {
            groups.entry(&row.condition).or_default().push(&row.motion);
        }
        groups
    }

    /// Mean and standard deviation of each measure by condition, as Markdown.
    pub(crate) fn table(&self) -> String {
        let groups = self.by_condition();
        let head: String = groups.iter().map(|(name, all)| format!(" {name} ({}) |", all.len())).collect();
        let mut text = format!("\n| motion: mean ± sd |{head}\n|---|{}\n", "---|".repeat(groups.len()));
        for (name, of) in MEASURES {
            let cell = |motions: &Vec<&VideoMotion>| {
                let values: Vec<f64> = motions.iter().map(|motion| of(motion)).collect();
                let sd = standard_deviation(&values).map_or_else(String::new, |sd| format!(" ± {sd:.2}"));
                format!(" {:.2}{sd} |", mean(&values).unwrap_or_default())
            };
            text += &format!("| {name} |{}\n", groups.values().map(cell).collect::<String>());
        }
        text
    }

    /// Mean and standard deviation of each measure by condition, for programs.
    pub(crate) fn value(&self) -> Value {
        let group = |motions: &Vec<&VideoMotion>| -> Value {
            let measure = |(name, of): Measure| {
                let values: Vec<f64> = motions.iter().map(|motion| of(motion)).collect();
                (name.to_owned(), json!({ "mean": mean(&values), "sd": standard_deviation(&values) }))
            };
            MEASURES.into_iter().map(measure).collect::<serde_json::Map<_, _>>().into()
        };
        let named = |(name, motions): (&&str, &Vec<&VideoMotion>)| {
            ((*name).to_owned(), json!({ "videos": motions.len(), "measures": group(motions) }))
        };
        self.by_condition().iter().map(named).collect::<serde_json::Map<_, _>>().into()
    }
}
