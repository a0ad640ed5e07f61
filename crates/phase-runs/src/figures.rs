//! The figures of a dataset or of other events beside the paper's, as text, for programs, and as plots.

use crate::{
    error::RunError,
    listener::Listener,
    motion::{Answers, MOTION_FILE, Motions},
    shortcuts::{self, audited},
    source::EventInput,
};
use phase_audit::{Audit, Target};
use phase_dataset::{
    acceptance::Acceptance,
    labels::goal_counts,
    manifest::{MANIFEST_FILE, Manifest},
};
use phase_document::plot::bars;
use phase_files::{WriteError, atomic};
use phase_model::{Scene, arena::STEP_VIDEO_SECONDS};
use phase_report::{
    acceptance,
    statistics::{self, Statistics, StatisticsRow},
};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// Width of the bars in the plot of lengths (s).
const LENGTH_STEP: usize = 1;

/// File name, title, unit, and the bars.
type Plot = (&'static str, &'static str, &'static str, Vec<(String, f64)>);

/// Figures of events.
#[derive(Clone, Debug)]
pub struct EventFigures {
    statistics: Statistics,
    /// The selection of the events of a dataset.
    selection: Vec<Acceptance>,
    /// The shortcut audit: labels that can be predicted without looking at motion.
    audit: Option<Audit>,
    motions: Motions,
    answers: Option<Answers>,
}

impl EventFigures {
    /// The figures of a file or folder of events, read on a number of threads; without one that of this
    /// machine's cores.
    ///
    /// # Errors
    /// If the events cannot be used.
    pub fn of(path: &Path, threads: Option<usize>, listener: &dyn Listener) -> Result<Self, RunError> {
        let (statistics, selection) = statistics(path, listener)?;
        let motions = Motions::of(path, threads, listener)?;
        let audit = audited(path, threads, listener)?;
        Ok(Self { statistics, selection, audit, motions, answers: None })
    }

    /// These figures with the answers of a method beside the events' clarity.
    ///
    /// # Errors
    /// The file of the answers, if none of them is about one of these events.
    pub fn with_answers(self, answers: Answers) -> Result<Self, RunError> {
        self.motions.check(&answers)?;
        Ok(Self { answers: Some(answers), ..self })
    }

    /// The figures for programs.
    #[must_use]
    pub fn value(&self) -> Value {
        let Self { statistics, selection, audit, motions, .. } = self;
        let Statistics { events, lengths, goals, relations, kinds, levels, layouts, .. } = statistics;
        let figure =
            |row: &StatisticsRow| json!({ "figure": row.what, "paper": row.paper, "here": row.ours });
        let figures: Vec<Value> = statistics.figures().iter().map(figure).collect();
        let kinds: BTreeMap<&str, usize> = kinds.iter().map(|(kind, &count)| (kind.name(), count)).collect();
        let levels: BTreeMap<String, usize> =
            levels.iter().map(|(&level, &count)| (u8::from(level).to_string(), count)).collect();
        let shortcuts = audit.as_ref().map(shortcuts::value);
        json!({
            "events": events, "figures": figures, "lengths": lengths, "goals": goals, "relations": relations,
            "kinds": kinds, "levels": levels, "layouts": layouts, "selection": selection,
            "shortcuts": shortcuts, "motion": motions.value(), "clarity": motions.clarity_value(),
        })
    }

    /// The figures for people.
    #[must_use]
    pub fn report(&self) -> String {
        let Self { statistics, selection, audit, motions, answers } = self;
        let mut text = statistics::table(&statistics.figures());
        text += &list("goal", "agents", statistics.goals.iter().map(|(goal, &count)| (goal.clone(), count)));
        text += &list(
            "kind",
            "events",
            statistics.kinds.iter().map(|(kind, &count)| (kind.name().into(), count)),
        );
        if !statistics.levels.is_empty() {
            let levels = statistics.levels.iter();
            let levels = levels.map(|(&level, &count)| (u8::from(level).to_string(), count));
            text += &list("level of reasoning", "agents that do not know the other's goal", levels);
        }
        if !selection.is_empty() {
            text += &format!("\n{}", acceptance::table(selection));
        }
        text += &motions.table();
        text += &motions.clarity(answers.as_ref());
        text += &shortcuts::section(audit.as_ref(), statistics.events);
        text
    }

    /// Writes the figures for people, plots of them and the table of motion (`motion.csv`) into a folder,
    /// which is created if it is not there.
    ///
    /// # Errors
    /// If a file or the folder cannot be written.
    pub fn write(&self, out: &Path) -> Result<(), WriteError> {
        let Self { statistics, selection, audit, motions, .. } = self;
        let failed = |source| WriteError { path: out.to_owned(), action: "create the folder", source };
        fs::create_dir_all(out).map_err(failed)?;
        atomic::write(&out.join("stats.md"), self.report().as_bytes())?;
        atomic::write(&out.join(MOTION_FILE), motions.to_csv().as_bytes())?;
        let mut lengths: BTreeMap<usize, usize> = BTreeMap::new();
        for (steps, count) in &statistics.lengths {
            *lengths.entry((*steps as f64 * STEP_VIDEO_SECONDS) as usize / LENGTH_STEP).or_default() += count;
        }
        let seconds = |at: usize| format!("{} to {} s", at * LENGTH_STEP, (at + 1) * LENGTH_STEP);
        let number = |count: usize| count as f64;
        let told = |target: Target| {
            let majority =
                audit.as_ref().map(|audit| ("nothing".into(), 100.0 * audit.majorities[target as usize]));
            let rows = audit.iter().flat_map(|audit| &audit.rows);
            let rows = rows.map(|row| (row.feature.name().into(), 100.0 * row.accuracies[target as usize]));
            majority.into_iter().chain(rows).collect::<Vec<(String, f64)>>()
        };
        let plots: [Plot; 7] = [
            ("shortcuts-relation.svg", "Relation told from", " %", told(Target::Relation)),
            ("shortcuts-kind.svg", "Kind told from", " %", told(Target::Kind)),
            (
                "lengths.svg",
                "Events by length",
                "",
                lengths.iter().map(|(&at, &n)| (seconds(at), number(n))).collect(),
            ),
            (
                "goals.svg",
                "Agents by goal",
                "",
                statistics.goals.iter().map(|(goal, &n)| (goal.clone(), number(n))).collect(),
            ),
            (
                "kinds.svg",
                "Events by kind",
                "",
                statistics.kinds.iter().map(|(kind, &n)| (kind.name().into(), number(n))).collect(),
            ),
            (
                "relations.svg",
                "Events by relation",
                "",
                statistics.relations.iter().map(|(&it, &n)| (it.name().into(), number(n))).collect(),
            ),
            (
                "acceptance.svg",
                "Scenes accepted, by variant",
                " %",
                selection.iter().map(|row| (row.variant.name().into(), rate(row))).collect(),
            ),
        ];
        for (name, title, unit, rows) in plots.iter().filter(|(_, _, _, rows)| !rows.is_empty()) {
            atomic::write(&out.join(name), bars(title, unit, rows).as_bytes())?;
        }
        Ok(())
    }
}

/// Figures of a dataset, with its manifest's data on the selection; or those of other events, which are in no
/// split.
fn statistics(path: &Path, listener: &dyn Listener) -> Result<(Statistics, Vec<Acceptance>), RunError> {
    let manifest = path.join(MANIFEST_FILE);
    if manifest.is_file() {
        let manifest = Manifest::read(&manifest)?;
        return Ok((Statistics::of(&manifest), manifest.selection));
    }
    let source = EventInput::open(path, &[], listener)?;
    let mut agents = Vec::new();
    let mut layouts = BTreeSet::new();
    let mut lengths = BTreeMap::new();
    let mut relations = BTreeMap::new();
    let mut kinds = BTreeMap::new();
    let mut levels = BTreeMap::new();
    for index in 0..source.len() {
        let recording = source.load(index)?;
        let Scene { layout, kind, agents: specs, .. } = &recording.scene;
        agents.extend(specs.each_ref().map(|agent| (agent.goal, agent.attitude.alpha())));
        layouts.insert((layout.base(), layout.flip()));
        for level in specs.iter().filter_map(|agent| agent.awareness.knows.level()) {
            *levels.entry(level).or_default() += 1;
        }
        *lengths.entry(recording.trajectory.steps()).or_default() += 1;
        *relations.entry(recording.relation).or_default() += 1;
        *kinds.entry(*kind).or_default() += 1;
    }
    let events = source.len();
    let goals = goal_counts(agents);
    let layouts = layouts.len();
    Ok((Statistics { events, lengths, goals, relations, kinds, levels, layouts, parts: None }, Vec::new()))
}

fn list(what: &str, counted: &str, rows: impl Iterator<Item = (String, usize)>) -> String {
    let rows = rows.map(|(name, count)| format!("| {name} | {count} |\n")).collect::<String>();
    format!("\n| {what} | {counted} |\n|---|---|\n{rows}")
}

fn rate(row: &Acceptance) -> f64 {
    100.0 * row.events as f64 / row.attempts.max(1) as f64
}
