//! Motion in each video and how clearly it shows its event, as a table, and by condition and variant.

use crate::{
    error::RunError,
    eval::{Evaluation, input::Input},
    listener::{Listener, Silent},
    parallel::{self, make_all},
    source::EventInput,
    words,
};
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_eval::{goals::RecognisedEvent, results::GOALS_FORMAT};
use phase_evidence::{Clarity, Manner, Track, VideoMotion};
use phase_files::{FileError, Problem, json::bytes};
use phase_model::{AGENT_COUNT, AgentId, Relation, RelationProbabilities};
use phase_statistics::{mean, standard_deviation};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    iter,
    path::{Path, PathBuf},
};

/// File name of the table, which has a row for each event.
pub(crate) const MOTION_FILE: &str = "motion.csv";

/// A measure: its column, whose end is its unit, and its value; `None` where it has none.
type Measure = (&'static str, fn(&Row) -> Option<f64>);

/// The measures, in the order of their columns.
const MEASURES: [Measure; 11] = [
    ("path_0_u", |it| Some(it.motion.path[0])),
    ("path_1_u", |it| Some(it.motion.path[1])),
    ("speed_0_u_per_s", |it| Some(it.motion.speed[0])),
    ("speed_1_u_per_s", |it| Some(it.motion.speed[1])),
    ("acceleration_0_u_per_s2", |it| Some(it.motion.acceleration[0])),
    ("acceleration_1_u_per_s2", |it| Some(it.motion.acceleration[1])),
    ("distance_u", |it| Some(it.motion.distance)),
    ("least_distance_u", |it| Some(it.motion.least_distance)),
    ("agents_touch_share", |it| Some(it.motion.agents_touch)),
    ("contact_0_share", |it| Some(it.motion.contact[0])),
    ("contact_1_share", |it| Some(it.motion.contact[1])),
];

/// Measures of clarity, in the order of their columns, which follow those of motion.
const CLARITY: [Measure; 13] = [
    ("knotted_share", |it| Some(it.clarity.knotted)),
    ("knot_at_end_steps", |it| Some(it.clarity.knot_at_end as f64)),
    ("spinning_share", |it| Some(it.clarity.spinning)),
    ("trembling_share", |it| Some(it.clarity.trembling)),
    ("remaining_0_u", |it| Some(it.clarity.remaining[0])),
    ("remaining_1_u", |it| Some(it.clarity.remaining[1])),
    ("at_object_end", |it| Some(it.clarity.at_object.map(|at| f64::from(u8::from(at))).iter().sum())),
    ("changes_late", |it| Some(f64::from(u8::from(it.clarity.changes_late)))),
    ("rest_at_end_steps", |it| Some(it.clarity.rest_at_end as f64)),
    ("trying_0_steps", |it| Some(it.clarity.trying[0] as f64)),
    ("trying_1_steps", |it| Some(it.clarity.trying[1] as f64)),
    ("shown_0_u", |it| it.clarity.shown[0]),
    ("shown_1_u", |it| it.clarity.shown[1]),
];

/// The kind of file that `--results` takes.
const RESULTS: &str = "set of results of eval goals";

/// The least distance by which the subject of a goal comes closer to its landmark than to each other one for
/// the landmark to count as [shown](Clarity::shown) (u).
const SHOWN: f64 = 1.0;

/// The answers of a method to events.
#[derive(Clone, Debug)]
pub struct Answers {
    file: PathBuf,
    /// The answers by the names of their events.
    judged: BTreeMap<String, Judged>,
}

/// An answer beside its label.
#[derive(Clone, Copy, Debug)]
struct Judged {
    /// The reports of people that the method predicts, if it does.
    reported: Option<RelationProbabilities>,
    /// Whether the most likely goal of each agent is the right one.
    right: [bool; AGENT_COUNT],
}

impl Answers {
    /// Reads the results of `eval goals` for the events of a file or folder, or for some of them: a split,
    /// or the first ones.
    ///
    /// # Errors
    /// A file that cannot be read, or that has other results or those of other events; events that cannot
    /// be used.
    pub fn read(file: &Path, events: &Path) -> Result<Self, RunError> {
        let fail = |problem: Problem| RunError::File(FileError { file: file.to_owned(), problem });
        let mut value = phase_model::json::parse(&bytes(file)?).map_err(|error| fail(error.into()))?;
        if value["format"] != GOALS_FORMAT {
            let rule = format!("field format must be {GOALS_FORMAT:?}");
            return Err(fail(Problem::Shape { what: RESULTS, rule }));
        }
        let answered = value.get_mut("events").map(Value::take).unwrap_or_default();
        let answered: Vec<RecognisedEvent> = phase_model::json::read_as(answered)
            .map_err(|source| fail(Problem::Incomplete { what: RESULTS, source }))?;
        let digest = value["run"]["events_sha256"].as_str().unwrap_or_default();
        if !is_digest_of(digest, answered.len(), events)? {
            let events = events.display();
            let rule = format!("field `run.events_sha256` is not that of the events of {events}");
            return Err(fail(Problem::Shape { what: RESULTS, rule }));
        }
        let judged = |event: RecognisedEvent| {
            let right = AgentId::ALL.map(|it| event.answer.place(it, event.label.goals[it]) == Some(0));
            (event.id, Judged { reported: event.answer.reported, right })
        };
        Ok(Self { file: file.to_owned(), judged: answered.into_iter().map(judged).collect() })
    }

    /// The cells of some events: the mean probability that people report the label, how often that is the
    /// likeliest report, and how many goals about landmarks are right where motion shows the landmark, and
    /// where it does not.
    fn cells(&self, rows: &[&Row]) -> String {
        let told: Vec<_> = rows.iter().filter_map(|row| Some((*row, *self.judged.get(&row.id)?))).collect();
        let reports: Vec<_> =
            told.iter().filter_map(|(row, it)| Some((it.reported?, row.relation))).collect();
        let label: Vec<f64> = reports.iter().map(|(reported, label)| reported.of(*label)).collect();
        let likeliest = reports.iter().filter(|(reported, label)| reported.most_likely() == *label).count();
        let mean = mean(&label).map_or_else(|| "–".into(), |mean| format!("{mean:.2}"));
        let goals = |is_shown: bool| {
            let agents =
                told.iter().flat_map(|(row, it)| AgentId::ALL.map(|k| (row.clarity.shown[k], it.right[k])));
            let these: Vec<bool> = agents
                .filter_map(|(shown, right)| Some((shown? >= SHOWN, right)))
                .filter_map(|(shown, right)| (shown == is_shown).then_some(right))
                .collect();
            format!("{} of {}", these.iter().filter(|right| **right).count(), these.len())
        };
        format!(" {mean} | {likeliest} of {} | {} | {} |", reports.len(), goals(true), goals(false))
    }
}

/// Whether a digest is that of the events of a file or folder as an evaluation opens them: all, or a split,
/// or so many of the first of either.
fn is_digest_of(digest: &str, count: usize, events: &Path) -> Result<bool, RunError> {
    let found = |split| {
        // Warnings about events are printed by their next reader.
        let evaluation = Evaluation { split, limit: Some(count), ..Evaluation::new(events) };
        Input::open(&evaluation, &Silent).map(|input| input.sha256)
    };
    if found(None)? == digest {
        return Ok(true);
    }
    // A split without events cannot be opened, and nothing was evaluated on it.
    let is_of = |split| found(Some(split)).is_ok_and(|sha256| sha256 == digest);
    Ok(events.join(MANIFEST_FILE).is_file() && Split::ALL.into_iter().any(is_of))
}

/// An event and its motion.
#[derive(Clone, Debug)]
struct Row {
    id: String,
    set: String,
    /// The stance of the agent that differs in a set, else the kind of event.
    condition: String,
    /// Its kind, its variant and the manners that it shows, by which clarity is told.
    groups: Vec<String>,
    relation: Relation,
    motion: VideoMotion,
    clarity: Clarity,
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
        let entries: BTreeMap<&str, _> = entries.map(|entry| (entry.id.as_str(), entry)).collect();
        // Warnings about events have been printed by the first reader.
        let source = EventInput::open(path, &[], &Silent)?;
        let count = source.len();
        let progress = listener.progress_over(&format!("measuring {}", words::events(count)), count);
        let rows = make_all(parallel::threads(threads), count, |index| {
            let recording = source.load(index)?;
            progress.steps(1);
            let states = recording.trajectory.states();
            let track = Track { physics: recording.scene.physics(), states };
            let entry = entries.get(recording.id.as_str());
            let place = entry.and_then(|entry| entry.set.as_ref());
            let condition =
                place.map_or_else(|| recording.scene.kind.name(), |place| place.stance.name()).to_owned();
            let set = place.map_or_else(String::new, |place| place.set.clone());
            let scene = &recording.scene;
            let kind = scene.kind.name();
            let variant = entry.and_then(|entry| entry.variant).map(|it| format!("{kind}, {}", it.name()));
            // Grips tell how an object is carried; motion and clarity are measured without them.
            let with_grips = crate::source::track(&recording);
            let manners = match &recording.simulation {
                Some(simulation) => Manner::of_event(&simulation.event, &with_grips),
                None => Manner::shown(scene, &with_grips),
            };
            let manners = manners.into_iter().map(|manner| format!("{kind}, seen: {}", manner.name()));
            let groups = iter::once(kind.to_owned()).chain(variant).chain(manners).collect();
            let (id, relation) = (recording.id.clone(), recording.relation);
            let row = VideoMotion::of(&track).zip(Clarity::of(scene, &track));
            Ok(Some(row.map(|(motion, clarity)| Row {
                id,
                set,
                condition,
                groups,
                relation,
                motion,
                clarity,
            })))
        })?;
        Ok(Self(rows.unwrap_or_default().into_iter().flatten().collect()))
    }

    /// The table, in CSV. Ids and names need no quotes.
    pub(crate) fn to_csv(&self) -> String {
        let columns: Vec<&str> = MEASURES.iter().chain(&CLARITY).map(|(name, _)| *name).collect();
        let columns = columns.join(",");
        let mut text = format!("id,set,condition,duration_s,{columns}\n");
        for row in &self.0 {
            let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.4}"));
            let values: Vec<String> =
                MEASURES.iter().chain(&CLARITY).map(|(_, of)| number(of(row))).collect();
            let values = values.join(",");
            let Row { id, set, condition, motion, .. } = row;
            text += &format!("{id},{set},{condition},{:.2},{values}\n", motion.seconds);
        }
        text
    }

    /// Checks that answers are about some of these events.
    ///
    /// # Errors
    /// The file of the answers, if none is.
    pub(crate) fn check(&self, answers: &Answers) -> Result<(), RunError> {
        if self.0.iter().any(|row| answers.judged.contains_key(&row.id)) {
            return Ok(());
        }
        let rule = "field events must have one of the events given".to_owned();
        let problem = Problem::Shape { what: RESULTS, rule };
        Err(RunError::File(FileError { file: answers.file.clone(), problem }))
    }

    fn by_condition(&self) -> BTreeMap<&str, Vec<&Row>> {
        let mut groups = BTreeMap::<&str, Vec<&Row>>::new();
        for row in &self.0 {
            groups.entry(&row.condition).or_default().push(row);
        }
        groups
    }

    /// Mean and standard deviation of each measure by condition, as Markdown.
    pub(crate) fn table(&self) -> String {
        let groups = self.by_condition();
        let head: String = groups.iter().map(|(name, all)| format!(" {name} ({}) |", all.len())).collect();
        let mut text = format!("\n| motion: mean ± sd |{head}\n|---|{}\n", "---|".repeat(groups.len()));
        for (name, of) in MEASURES {
            let cell = |rows: &Vec<&Row>| {
                let values: Vec<f64> = rows.iter().filter_map(|row| of(row)).collect();
                let sd = standard_deviation(&values).map_or_else(String::new, |sd| format!(" ± {sd:.2}"));
                format!(" {:.2}{sd} |", mean(&values).unwrap_or_default())
            };
            text += &format!("| {name} |{}\n", groups.values().map(cell).collect::<String>());
        }
        text
    }

    /// Mean and standard deviation of each measure of motion by condition, for programs.
    pub(crate) fn value(&self) -> Value {
        value(self.by_condition(), &MEASURES)
    }

    /// Mean and standard deviation of each measure of clarity by kind, variant and manner, for programs.
    pub(crate) fn clarity_value(&self) -> Value {
        value(self.by_group(), &CLARITY)
    }

    fn by_group(&self) -> BTreeMap<&str, Vec<&Row>> {
        let mut groups = BTreeMap::<&str, Vec<&Row>>::new();
        for row in &self.0 {
            for name in &row.groups {
                groups.entry(name).or_default().push(row);
            }
        }
        groups
    }

    /// The mean of each measure of clarity by kind, variant and manner, as Markdown; with the answers of a
    /// method, also what they say of reports and goals.
    pub(crate) fn clarity(&self, answers: Option<&Answers>) -> String {
        let names: String = CLARITY.iter().map(|(name, _)| format!(" {name} |")).collect();
        let told = [" label reported |", " likeliest |", " goals right: shown |", " not shown |"];
        let told = if answers.is_some() { &told[..] } else { &[] };
        let head = told.concat();
        let columns = CLARITY.len() + 1 + told.len();
        let mut text =
            format!("\n| clarity: mean | events |{names}{head}\n|---|{}\n", "---|".repeat(columns));
        for (group, rows) in self.by_group() {
            text += &format!("| {group} | {} |", rows.len());
            for (_, of) in CLARITY {
                let values: Vec<f64> = rows.iter().filter_map(|row| of(row)).collect();
                let mean = mean(&values).map_or_else(|| "–".into(), |mean| format!("{mean:.2}"));
                text += &format!(" {mean} |");
            }
            if let Some(answers) = answers {
                text += &answers.cells(&rows);
            }
            text += "\n";
        }
        text
    }
}

/// Mean and standard deviation of measures by groups.
fn value(groups: BTreeMap<&str, Vec<&Row>>, measures: &[Measure]) -> Value {
    let measured = |rows: &[&Row]| -> Value {
        let measure = |&(name, of): &Measure| {
            let values: Vec<f64> = rows.iter().filter_map(|row| of(row)).collect();
            (name.to_owned(), json!({ "mean": mean(&values), "sd": standard_deviation(&values) }))
        };
        measures.iter().map(measure).collect::<serde_json::Map<_, _>>().into()
    };
    let named = |(name, rows): (&str, Vec<&Row>)| {
        (name.to_owned(), json!({ "videos": rows.len(), "measures": measured(&rows) }))
    };
    groups.into_iter().map(named).collect::<serde_json::Map<_, _>>().into()
}
