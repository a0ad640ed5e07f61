//! The leaderboard: methods by measures, those of the benchmark and those that others have handed in.

use super::{length, share};
use crate::published;
use phase_document::{
    document::{Block, head},
    markup::escape_markdown,
};
use phase_eval::{
    Estimate,
    benchmark::{Benchmark, GENERATED, Origin, PAIRS, RECORDED, Row},
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The value of the field `format` of [`Scores`].
pub const LEADERBOARD_FORMAT: &str = "phase-leaderboard/1";
/// Text of the table where a method was not asked.
const NOTHING: &str = "–";

/// The scores of all predictions that were handed in.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scores {
    /// Always [`LEADERBOARD_FORMAT`].
    pub format: String,
    /// A score for each file of predictions, by method, task and set.
    pub scores: Vec<Score>,
}

/// The score of one file of predictions.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Score {
    /// The method: the name of its files.
    pub method: String,
    /// The set of events: the label of one of [`Benchmark::sets`], or `sealed-` and the first digits of a
    /// seal.
    pub set: String,
    /// Digest of the file of predictions.
    pub predictions: String,
    /// Digest of the events, as in [`phase_eval::benchmark::EventSet`].
    pub events: String,
    /// The seal, if the events were sealed while they were answered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sealed: Option<SealedSet>,
    /// The measures.
    #[serde(flatten)]
    pub measures: Measures,
}

/// A sealed dataset.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SealedSet {
    /// Digest of the published description of what is sealed.
    pub seal: String,
    /// Number of its events.
    pub events: usize,
}

/// The measures of a task.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(tag = "task", rename_all = "kebab-case")]
pub enum Measures {
    /// Task 1.
    Goals {
        /// The correct goal is the most likely one.
        top1: Estimate,
        /// The most likely relation is the intended one.
        relation: Estimate,
        /// All goals and relations of a set of events that differ in one social variable; of events in such
        /// sets only.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        whole_sets: Option<Estimate>,
    },
    /// Task 2 (u).
    Trajectories {
        /// Average displacement error of the agents.
        ade: Estimate,
        /// Final displacement error of the agents.
        fde: Estimate,
    },
}

/// The authors of a method that was handed in.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The authors' names.
    pub by: String,
    /// Address of its code or description.
    pub source: String,
}

/// One line before it is sorted: the value that it is sorted by, and its cells.
struct Line {
    rank: f64,
    cells: Vec<String>,
}

/// The page as Markdown: goals and relations, best first, and trajectories.
#[must_use]
pub fn leaderboard(benchmark: &Benchmark, scores: &Scores, sources: &BTreeMap<String, Source>) -> String {
    let set = |label: &str| benchmark.sets.iter().find(|set| set.label == label);
    let described = [(GENERATED, "generated events"), (RECORDED, "recordings"), (PAIRS, "minimal pairs")];
    let described = described.into_iter().filter_map(|(label, name)| {
        set(label).map(|set| format!("{name}: {} ({} events)", set.name, set.events))
    });
    let table = |columns: &[&str], mut lines: Vec<Line>| {
        lines.sort_by(|a, b| a.rank.total_cmp(&b.rank));
        let rows = lines.into_iter().map(|line| line.cells).collect();
        Block::Table { head: head(columns), rows }.to_markdown()
    };
    let goals = table(
        &[
            "method",
            "generated: goals",
            "relations",
            "recordings: goals",
            "relations",
            "minimal pairs: whole sets",
        ],
        goal_lines(benchmark, scores),
    );
    let trajectories = table(
        &["method", "generated: ADE", "FDE", "recordings: ADE", "FDE"],
        trajectory_lines(benchmark, scores),
    );
    let sources = sources.iter().map(|(method, Source { by, source })| {
        let [method, by, source] = [method, by, source].map(|text| escape_markdown(text));
        format!("- {method}: {by}, {source}\n")
    });
    format!(
        "# Leaderboard\n\n\
         <!-- Written by `cargo xtask results` from data/results.json and data/leaderboard/scores.json. -->\n\n\
         {}. Square brackets hold 95 % bootstrap intervals. [The overview](overview.md) has all measures of the bundled methods; \
         [how-to/method.md](../how-to/method.md) says what a method may use and how to submit yours. Published figures are of all \
         100 recordings.\n\n\
         ## Goals and relations\n\n{goals}\n\
         Sorted by goal accuracy on generated events; methods without that score by goal accuracy on recordings. A minimal-pair \
         set counts as correct only if all its goals and relations are. Goals of `socialgnn`, which infers \
         relations alone, are those of `chance`.\n\n\
         ## Trajectories\n\n{trajectories}\n\
         Displacement errors of the agents in u, sorted by ADE.\n\n{}\
         ## Submitted methods\n\n{}",
        described.collect::<Vec<_>>().join("; "),
        sealed_section(scores),
        sources.collect::<String>(),
    )
}

/// The scores on sealed events, by seal and then best first; nothing without any.
fn sealed_section(scores: &Scores) -> String {
    let lines = scores.scores.iter().filter_map(|score| {
        let Measures::Goals { top1, relation, whole_sets } = score.measures else { return None };
        let SealedSet { seal, events } = score.sealed.as_ref()?;
        let cells = [seal.clone(), events.to_string(), score.method.clone()].into_iter();
        let shares = [Some(top1), Some(relation), whole_sets].map(share_or_nothing);
        Some((seal, -top1.value, cells.chain(shares).collect()))
    });
    let mut lines: Vec<(&String, f64, Vec<String>)> = lines.collect();
    if lines.is_empty() {
        return String::new();
    }
    lines.sort_by(|a, b| a.0.cmp(b.0).then(a.1.total_cmp(&b.1)));
    let columns = head(&["seal", "events", "method", "goals", "relations", "whole sets"]);
    let rows = lines.into_iter().map(|(_, _, cells)| cells).collect();
    format!(
        "## Sealed events\n\n{}\n\
         Whoever answered had the motion alone, and labels that nobody could look up or make again \
         ([sealed datasets](../how-to/questions.md#a-split-that-nobody-can-look-up)). The seal is the \
         SHA-256 of the published `seal.json`. Each seal has other events, so that scores of two seals are \
         not of the same difficulty. They are the word of whoever keeps the dataset until that is published; \
         then everybody can score the answers again.\n\n",
        Block::Table { head: columns, rows }.to_markdown()
    )
}

/// Goals, relations, and, of sets that differ in one social variable, whole sets.
type GoalScores = (Estimate, Estimate, Option<Estimate>);

fn goal_lines(benchmark: &Benchmark, scores: &Scores) -> Vec<Line> {
    let line = |name: String, of: &dyn Fn(&str) -> Option<GoalScores>| {
        let [generated, recorded, pairs] = [GENERATED, RECORDED, PAIRS].map(of);
        let two = |scores: &Option<GoalScores>| {
            [scores.as_ref().map(|it| it.0), scores.as_ref().map(|it| it.1)].map(share_or_nothing)
        };
        let sets = share_or_nothing(pairs.and_then(|scores| scores.2));
        let rank = generated.as_ref().or(recorded.as_ref()).map_or(0.0, |scores| -scores.0.value);
        let cells = [name].into_iter().chain(two(&generated)).chain(two(&recorded)).chain([sets]).collect();
        Line { rank, cells }
    };
    let published = published::GOALS.iter().map(|row| Line {
        rank: -row.goal[0],
        cells: vec![
            format!("{} ({})", row.method, row.source),
            NOTHING.into(),
            NOTHING.into(),
            format!("{:.3}", row.goal[0]),
            format!("{:.2}", row.relation),
            NOTHING.into(),
        ],
    });
    let ours = methods(&benchmark.goals).into_iter().map(|method| {
        line(format!("{method} (ours)"), &|label| {
            let summary = &row(benchmark, &benchmark.goals, method, label)?.summary;
            Some((summary.all.top1, summary.all.relation, summary.sets.as_ref().map(|sets| sets.all)))
        })
    });
    let given = handed_in(scores, |measures| matches!(measures, Measures::Goals { .. }));
    let given = given.into_iter().map(|method| {
        line(method.to_owned(), &|label| {
            let of = scores.scores.iter().filter(|score| score.method == method && score.set == label);
            of.into_iter().find_map(|score| match &score.measures {
                Measures::Goals { top1, relation, whole_sets } => Some((*top1, *relation, *whole_sets)),
                Measures::Trajectories { .. } => None,
            })
        })
    });
    published.chain(ours).chain(given).collect()
}

fn trajectory_lines(benchmark: &Benchmark, scores: &Scores) -> Vec<Line> {
    let line = |name: String, of: &dyn Fn(&str) -> Option<(Estimate, Estimate)>| {
        let [generated, recorded] = [GENERATED, RECORDED].map(of);
        let two = |scores: Option<(Estimate, Estimate)>| {
            [scores.map(|it| it.0), scores.map(|it| it.1)]
                .map(|it| it.map_or_else(|| NOTHING.into(), |it| length(&it)))
        };
        let rank = generated.or(recorded).map_or(f64::INFINITY, |scores| scores.0.value);
        Line { rank, cells: [name].into_iter().chain(two(generated)).chain(two(recorded)).collect() }
    };
    let published = published::TRAJECTORIES.iter().map(|row| Line {
        rank: row.ade[2],
        cells: vec![
            format!("{} ({})", row.method, row.source),
            NOTHING.into(),
            NOTHING.into(),
            format!("{:.2}", row.ade[2]),
            format!("{:.2}", row.fde[2]),
        ],
    });
    let ours = methods(&benchmark.trajectories).into_iter().map(|method| {
        line(format!("{method} (ours)"), &|label| {
            let all = &row(benchmark, &benchmark.trajectories, method, label)?.summary.all;
            Some((all.ade, all.fde))
        })
    });
    let given = handed_in(scores, |measures| matches!(measures, Measures::Trajectories { .. }));
    let given = given.into_iter().map(|method| {
        line(method.to_owned(), &|label| {
            let of = scores.scores.iter().filter(|score| score.method == method && score.set == label);
            of.into_iter().find_map(|score| match &score.measures {
                Measures::Trajectories { ade, fde } => Some((*ade, *fde)),
                Measures::Goals { .. } => None,
            })
        })
    });
    published.chain(ours).chain(given).collect()
}

/// The methods of the program, each once.
fn methods<S>(rows: &[Row<S>]) -> Vec<&str> {
    let mut names: Vec<&str> =
        rows.iter().filter(|row| row.origin == Origin::Ours).map(|row| row.method.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn row<'a, S>(benchmark: &Benchmark, rows: &'a [Row<S>], method: &str, label: &str) -> Option<&'a Row<S>> {
    let set = benchmark.sets.iter().position(|set| set.label == label)?;
    rows.iter().find(|row| row.origin == Origin::Ours && row.method == method && row.set == set)
}

/// The methods that were handed in for a task on events that everybody has, each once.
fn handed_in(scores: &Scores, does: fn(&Measures) -> bool) -> Vec<&str> {
    let scores = scores.scores.iter().filter(|score| score.sealed.is_none() && does(&score.measures));
    let mut names: Vec<&str> = scores.map(|score| score.method.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn share_or_nothing(estimate: Option<Estimate>) -> String {
    estimate.map_or_else(|| NOTHING.into(), |it| share(&it))
}
