//! The report of Task 1.

use super::{BESIDE, Subject, bars_beside, cost, share};
use crate::published;
use phase_document::{
    document::{Block, Document, head},
    plot::{Axis, Series, line_chart},
};
use phase_eval::{
    Estimate, GroupScores,
    goals::{
        Agreement, Bin, Calibration, RELATIONS, RecognitionScores, RecognitionSummary, RoleScores,
        UNIFORM_SHARE,
    },
};

/// The report of how well a method recognises goals and relations.
#[must_use]
pub fn goals(subject: Subject<'_>, summary: &RecognitionSummary) -> Document {
    let ours = subject.label();
    let mut blocks = vec![
        Block::Text(format!(
            "{}, seed {}: {} events. A goal counts as right if kind, entity, landmark and sign all match, over both \
             agents of each event; of equally likely relations the first of friendly, adversarial and neutral counts.",
            subject.events, subject.seed, summary.all.n
        )),
        beside_published(&ours, &summary.all),
        Block::Text(BESIDE.into()),
        Block::Text(cost(summary.cpu_seconds_per_event)),
        published_plot(
            "goals.svg",
            "Goals right (most likely one), %",
            &ours,
            summary.all.top1.value,
            |row| row.goal[0],
        ),
        published_plot("relations.svg", "Relations right, %", &ours, summary.all.relation.value, |row| {
            row.relation
        }),
        Block::Heading("By kind of event".into()),
        groups("kind", &summary.kinds),
    ];
    if !summary.layouts.is_empty() {
        blocks.push(Block::Heading("By layout".into()));
        blocks.push(Block::Text(
            "Seen: the base layout, in whatever reflection, is in the training or validation events too."
                .into(),
        ));
        blocks.push(groups("layout", &summary.layouts));
    }
    if let Some(sets) = &summary.sets {
        blocks.push(Block::Heading("By set".into()));
        blocks.push(Block::Text(
            "The events of a set differ in one social variable alone; a set counts as right if all of its events do.".into(),
        ));
        let row = vec![sets.n.to_string(), share(&sets.relation), share(&sets.goals), share(&sets.all)];
        blocks.push(Block::Table {
            head: head(&["sets", "all relations right", "all goals right", "both"]),
            rows: vec![row],
        });
    }
    if let Some(roles) = &summary.roles {
        blocks.push(Block::Heading("Who helps or hinders whom".into()));
        blocks.push(Block::Text(
            "Events in which one agent helps or hinders the other. Given that, the agent named is the one whose \
             probability is the greater; the Brier score is (1 − p)² of the share of the right agent, 0.25 for a guess."
                .into(),
        ));
        blocks.push(role_table(roles, &summary.role_kinds));
    }
    if let Some(agreement) = &summary.agreement {
        blocks.push(Block::Heading("Agreement with people".into()));
        blocks.extend(agreement_blocks(agreement, summary.relation_agreement.as_ref()));
        blocks.extend(other_recordings(&ours, &summary.all));
    }
    if !summary.watched.is_empty() {
        blocks.push(Block::Heading("By seconds watched".into()));
        blocks.push(Block::Text("Events that end earlier count with all of them.".into()));
        let whole = GroupScores { name: "to the end".into(), scores: summary.all.clone() };
        blocks.push(groups("watched", &[&summary.watched[..], &[whole]].concat()));
        blocks.push(watched_plot(&summary.watched));
    }
    blocks.push(Block::Heading("Relations taken for one another".into()));
    blocks.push(confusion(summary));
    blocks.push(Block::Heading("Calibration".into()));
    blocks.push(Block::Text(format!(
        "Expected calibration error: {:.3} of the most likely goals, {:.3} of the most likely relations.",
        summary.goal_calibration.error, summary.relation_calibration.error
    )));
    blocks.push(reliability_plot(summary));
    blocks.push(Block::Text("Most likely goals:".into()));
    blocks.push(reliability(&summary.goal_calibration));
    blocks.push(Block::Text("Most likely relations:".into()));
    blocks.push(reliability(&summary.relation_calibration));
    Document { title: format!("Goals and relations recognised by {}", subject.method), blocks }
}

fn role_table(all: &RoleScores, kinds: &[GroupScores<RoleScores>]) -> Block {
    let row = |name: &str, scores: &RoleScores| {
        vec![name.to_owned(), scores.n.to_string(), share(&scores.named), share(&scores.brier)]
    };
    let mut rows = vec![row("all", all)];
    rows.extend(kinds.iter().map(|kind| row(&kind.name, &kind.scores)));
    Block::Table { head: head(&["kind", "events", "agent right", "Brier score"]), rows }
}

fn agreement_blocks(agreement: &Agreement, relations: Option<&Agreement>) -> [Block; 2] {
    let ceiling = agreement.ceiling.as_ref();
    let number = |value: Option<f64>| value.map_or_else(|| "-".into(), |value| format!("{value:.3}"));
    let or_none = |estimate: Option<&Estimate>| estimate.map_or_else(|| "-".into(), share);
    let row = |what: &str, of: &dyn Fn(&Agreement) -> String, people: Option<f64>| {
        let methods = core::iter::once(agreement).chain(relations).map(of);
        core::iter::once(what.to_owned()).chain(methods).chain([number(people)]).collect()
    };
    let rows = vec![
        row(
            "Pearson's correlation of probabilities and shares of raters",
            &|it| or_none(it.correlation.as_ref()),
            ceiling.and_then(|it| it.correlation),
        ),
        row("cross-entropy (nat)", &|it| share(&it.cross_entropy), ceiling.map(|it| it.entropy)),
        row(
            "representational similarity (Spearman's)",
            &|it| or_none(it.similarity.as_ref()),
            ceiling.and_then(|it| it.similarity),
        ),
        row("most frequent rating named", &|it| share(&it.mode), ceiling.map(|it| it.mode)),
    ];
    let columns: &[&str] = if relations.is_some() {
        &["measure", "reports that the method predicts", "its probabilities of relations", "people"]
    } else {
        &["measure", "method", "people"]
    };
    let text = format!(
        "{} events with {} ratings. People: how well one half of the raters predicts the other (the correlations are corrected \
         to all raters), and the entropy of their ratings, the least cross-entropy that is possible. Probabilities are mixed \
         with {} % of the uniform distribution for the cross-entropy.",
        agreement.n,
        agreement.ratings,
        100.0 * UNIFORM_SHARE
    );
    [Block::Text(text), Block::Table { head: head(columns), rows }]
}

fn beside_published(ours: &str, scores: &RecognitionScores) -> Block {
    let human = scores.relation_human.as_ref();
    let mut rows = vec![vec![
        ours.to_owned(),
        share(&scores.top1),
        share(&scores.top2),
        share(&scores.top3),
        share(&scores.relation),
        human.map_or_else(|| "-".into(), share),
        "this run".into(),
    ]];
    rows.extend(published::GOALS.iter().map(|row| {
        let goals = row.goal.map(|accuracy| format!("{accuracy:.3}"));
        let rest = [format!("{:.2}", row.relation), "-".into(), row.source.into()];
        [row.method.to_owned()].into_iter().chain(goals).chain(rest).collect()
    }));
    let columns =
        ["method", "goal top-1", "top-2", "top-3", "relation", "relation as people saw it", "source"];
    Block::Table { head: head(&columns), rows }
}

/// Published results on the recordings that are not in the test set.
fn other_recordings(ours: &str, scores: &RecognitionScores) -> [Block; 2] {
    let none = || "-".to_owned();
    let people = scores.relation_human.as_ref().map_or_else(none, share);
    let mut rows = vec![vec![ours.to_owned(), people, share(&scores.relation)]];
    rows.extend(published::OTHER_RECORDINGS.iter().map(|row| {
        let generator = row.generator.map_or_else(none, |share| format!("{share:.3}"));
        vec![row.method.to_owned(), format!("{:.3}", row.people), generator]
    }));
    let text = format!(
        "Published on the 400 recordings outside the test set (Malik and Isik 2023, ten parts of 100), where {:.3} of the \
         raters give the most frequent answer. These rows compare with this run if it has the same recordings.",
        published::OTHER_AGREEMENT
    );
    [
        Block::Text(text),
        Block::Table { head: head(&["method", "relation as people saw it", "relation"]), rows },
    ]
}

/// Bars of shares, PHASE's first.
fn published_plot(
    file: &'static str,
    title: &str,
    ours: &str,
    value: f64,
    theirs: fn(&published::GoalRow) -> f64,
) -> Block {
    let published = published::GOALS.iter().map(|row| (row.method, 100.0 * theirs(row)));
    bars_beside(file, title, " %", (ours, 100.0 * value), published)
}

fn groups(what: &str, groups: &[GroupScores<RecognitionScores>]) -> Block {
    let row = |group: &GroupScores<RecognitionScores>| {
        let scores = &group.scores;
        vec![
            group.name.clone(),
            scores.n.to_string(),
            share(&scores.top1),
            share(&scores.top2),
            share(&scores.top3),
            share(&scores.relation),
        ]
    };
    Block::Table {
        head: head(&[what, "events", "goal top-1", "top-2", "top-3", "relation"]),
        rows: groups.iter().map(row).collect(),
    }
}

fn watched_plot(groups: &[GroupScores<RecognitionScores>]) -> Block {
    let seconds =
        |group: &GroupScores<RecognitionScores>| group.name.trim_end_matches(" s").parse::<f64>().ok();
    let line = |of: fn(&RecognitionScores) -> f64| -> Vec<(f64, f64)> {
        groups.iter().filter_map(|group| Some((seconds(group)?, of(&group.scores)))).collect()
    };
    let longest = groups.iter().filter_map(seconds).fold(1.0, f64::max);
    let series = [
        Series { name: "goal top-1", points: line(|scores| scores.top1.value) },
        Series { name: "goal top-3", points: line(|scores| scores.top3.value) },
        Series { name: "relation", points: line(|scores| scores.relation.value) },
    ];
    let title = "Share right by seconds watched";
    let axes = [Axis::linear("watched (s)", longest), Axis::linear("right", 1.0)];
    Block::Plot { file: "watched.svg", title: title.into(), svg: line_chart(title, axes, &series) }
}

fn confusion(summary: &RecognitionSummary) -> Block {
    let row = |(right, counts): (phase_model::Relation, &[usize; RELATIONS.len()])| {
        let counts = counts.iter().map(ToString::to_string);
        [right.name().to_owned()].into_iter().chain(counts).collect()
    };
    let said = RELATIONS.map(|relation| format!("taken for {}", relation.name()));
    Block::Table {
        head: ["made to show".to_owned()].into_iter().chain(said).collect(),
        rows: RELATIONS.into_iter().zip(&summary.confusion).map(row).collect(),
    }
}

fn reliability(calibration: &Calibration) -> Block {
    let row = |bin: &Bin| {
        vec![
            format!("{:.1} to {:.1}", bin.from, bin.to),
            bin.n.to_string(),
            format!("{:.3}", bin.confidence),
            format!("{:.3}", bin.accuracy),
        ]
    };
    Block::Table {
        head: head(&["probability", "answers", "mean probability", "share right"]),
        rows: calibration.bins.iter().filter(|bin| bin.n > 0).map(row).collect(),
    }
}

fn reliability_plot(summary: &RecognitionSummary) -> Block {
    let points = |calibration: &Calibration| {
        let bins = calibration.bins.iter().filter(|bin| bin.n > 0);
        bins.map(|bin| (bin.confidence, bin.accuracy)).collect()
    };
    let series = [
        Series { name: "goals", points: points(&summary.goal_calibration) },
        Series { name: "relations", points: points(&summary.relation_calibration) },
        Series { name: "perfect", points: vec![(0.0, 0.0), (1.0, 1.0)] },
    ];
    let title = "Right as often as said?";
    let axes = [Axis::linear("probability given", 1.0), Axis::linear("share right", 1.0)];
    Block::Plot { file: "reliability.svg", title: title.into(), svg: line_chart(title, axes, &series) }
}
