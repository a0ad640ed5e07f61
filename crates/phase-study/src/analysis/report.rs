//! An analysis as a text with tables and plots.

use super::{Accuracy, Analysis, Answers, Categories, Confusion, Share};
use phase_document::{
    document::{Block, Document},
    plot::{bars, matrix},
};
use phase_eval::Estimate;

/// The analysis of a study with a title.
#[must_use]
pub fn document(title: &str, analysis: &Analysis) -> Document {
    let raters = &analysis.raters;
    let coverage = &analysis.coverage;
    let mut blocks = vec![
        table(
            &["raters", "complete", "failed catch trials", "unfinished", "withdrawn", "declined"],
            vec![
                [
                    raters.joined,
                    raters.complete,
                    raters.failed,
                    raters.unfinished,
                    raters.withdrawn,
                    raters.declined,
                ]
                .map(|count| count.to_string())
                .into(),
            ],
        ),
        Block::Text(format!(
            "Only complete raters count: {} judgements of {} of {} videos, {} to {} each. 95 % confidence intervals over videos: \
             percentile bootstrap for means and α, Wilson for proportions.",
            coverage.judgements, coverage.judged, coverage.videos, coverage.least, coverage.most
        )),
    ];
    if !analysis.accuracy.is_empty() {
        blocks.extend(accuracy(&analysis.accuracy));
    }
    blocks.extend(analysis.confusion.iter().chain(&analysis.goal_confusion).flat_map(confusion));
    blocks.extend(by_condition(&analysis.conditions));
    if !analysis.human_likeness.is_empty() {
        blocks.extend(likeness(analysis));
    }
    for categories in &analysis.interactions {
        blocks.extend(interactions(categories));
    }
    blocks.push(Block::Heading("Agreement".into()));
    blocks.push(Block::Text(
        "Krippendorff's α for nominal data: 1 is complete agreement, 0 that of chance.".into(),
    ));
    let row = |it: &super::Agreement| {
        let what = it.choice.as_ref().unwrap_or(&it.question).clone();
        vec![what, estimate(it.alpha, 3), it.videos.to_string()]
    };
    blocks.push(table(&["question", "α", "videos"], analysis.agreement.iter().map(row).collect()));
    for (title, groups) in [("Sets", &analysis.sets), ("Videos", &analysis.videos)] {
        if !groups.is_empty() {
            blocks.push(Block::Heading(title.into()));
            blocks.push(Block::Text("Intervals are over the judgements of each.".into()));
            blocks.push(answers(groups));
        }
    }
    Document { title: title.into(), blocks }
}

fn accuracy(accuracies: &[Accuracy]) -> Vec<Block> {
    let row = |it: &Accuracy| {
        vec![
            it.question.into(),
            source(it.source.as_ref()),
            estimate(it.mean, 3),
            share(&it.majority),
            it.videos.to_string(),
        ]
    };
    let head = ["question", "source", "judgements that are right", "majorities that are right", "videos"];
    vec![Block::Heading("Accuracy".into()), table(&head, accuracies.iter().map(row).collect())]
}

/// Answers by label: counts as a table, shares as a plot.
fn confusion(confusion: &Confusion) -> Vec<Block> {
    let by_label = confusion.labels.iter().zip(&confusion.counts).zip(&confusion.judgements);
    let shares = by_label.clone().map(|((_, counts), &judgements)| {
        counts.iter().map(|&count| count as f64 / judgements.max(1) as f64).collect()
    });
    let shares: Vec<Vec<f64>> = shares.collect();
    let (title, text, file) = match confusion.question {
        "relation" => (
            "Answers by label",
            "Each row has the judgements of videos with one label; right answers are in the column of the same name.",
            "confusion.svg",
        ),
        "goals" => (
            "Answers by goal",
            "Each row has the judgements of agents with one goal, whose right answers it names.",
            "confusion-goals.svg",
        ),
        _ => (
            "Answers by condition",
            "Each row has one condition, and how many of its judgements name each type of interaction.",
            "confusion.svg",
        ),
    };
    // Many answers fit in a picture, not in the columns of a table.
    let mut blocks = vec![Block::Heading(title.into()), Block::Text(text.into())];
    if confusion.question == "relation" {
        let mut head = vec!["label".to_owned()];
        head.extend(confusion.answers.iter().cloned());
        head.push("judgements".into());
        let row = |((label, counts), judgements): ((&String, &Vec<usize>), &usize)| {
            let mut row = vec![label.clone()];
            row.extend(counts.iter().map(usize::to_string));
            row.push(judgements.to_string());
            row
        };
        blocks.push(Block::Table { head, rows: by_label.map(row).collect() });
    }
    let title = "Share of the judgements of each row (%)";
    let svg = matrix(title, &confusion.labels, &confusion.answers, &shares);
    blocks.push(Block::Plot { file, title: title.into(), svg });
    blocks
}

fn by_condition(conditions: &[Answers]) -> Vec<Block> {
    if conditions.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![Block::Heading("Conditions".into()), answers(conditions)];
    let bar = |it: &Answers| it.relation_right.map(|right| (it.name.clone(), 100.0 * right.value));
    let rows: Vec<(String, f64)> = conditions.iter().filter_map(bar).collect();
    if !rows.is_empty() {
        let title = "Judgements with the right relation, by condition";
        let svg = bars(title, " %", &rows);
        blocks.push(Block::Plot { file: "conditions.svg", title: title.into(), svg });
    }
    blocks
}

/// A column of a table of answers: its name, its value, and how many decimals it has.
type Measure = (&'static str, fn(&Answers) -> Option<Estimate>, usize);

/// A table of answers, with the columns that some row has.
fn answers(groups: &[Answers]) -> Block {
    let mut head = vec!["name", "videos", "judgements"];
    let measures: [Measure; 3] = [
        ("right relations", |it| it.relation_right, 3),
        ("right goals", |it| it.goals_right, 3),
        ("human-likeness", |it| it.human_likeness, 2),
    ];
    let shown: Vec<_> =
        measures.into_iter().filter(|(_, of, _)| groups.iter().any(|it| of(it).is_some())).collect();
    head.extend(shown.iter().map(|(name, ..)| *name));
    head.push("most frequent answers");
    let row = |it: &Answers| {
        let mut row = vec![it.name.clone(), it.videos.to_string(), it.judgements.to_string()];
        row.extend(shown.iter().map(|(_, of, digits)| estimate(of(it), *digits)));
        row.push(most_frequent(it));
        row
    };
    table(&head, groups.iter().map(row).collect())
}

/// The three answers that were given most, with their numbers.
fn most_frequent(answers: &Answers) -> String {
    let mut given: Vec<&(String, usize)> = answers.given.iter().filter(|(_, count)| *count > 0).collect();
    given.sort_by_key(|(_, count)| core::cmp::Reverse(*count));
    let words = given.iter().take(3).map(|(choice, count)| format!("{choice} {count}"));
    words.collect::<Vec<_>>().join(", ")
}

fn likeness(analysis: &Analysis) -> Vec<Block> {
    let rows = analysis.human_likeness.iter().map(|it| {
        let sd = it.sd.map_or_else(|| "–".into(), |sd| format!("{sd:.2}"));
        vec![it.source.clone(), estimate(it.mean, 2), sd, it.videos.to_string()]
    });
    let mut blocks = vec![
        Block::Heading("Human-likeness".into()),
        Block::Text(
            "How likely people would behave like this, 1 to 5: mean and standard deviation over videos."
                .into(),
        ),
        table(&["source", "mean", "sd", "videos"], rows.collect()),
    ];
    let differences: Vec<Vec<String>> = analysis
        .human_likeness_differences
        .iter()
        .map(|it| vec![format!("{} − {}", it.source, it.other), estimate(Some(it.difference), 2)])
        .collect();
    if !differences.is_empty() {
        blocks.push(table(&["difference", "of means"], differences));
    }
    let bar = |it: &super::Likeness| it.mean.map(|mean| (it.source.clone(), mean.value));
    let rows: Vec<(String, f64)> = analysis.human_likeness.iter().filter_map(bar).collect();
    let title = "Human-likeness by source, 1 to 5";
    blocks.push(Block::Plot { file: "human-likeness.svg", title: title.into(), svg: bars(title, "", &rows) });
    blocks
}

fn interactions(categories: &Categories) -> Vec<Block> {
    let place = source(categories.source.as_ref());
    let mut sorted: Vec<_> = categories.categories.iter().collect();
    sorted.sort_by_key(|category| std::cmp::Reverse(category.by_half.count));
    let rows =
        sorted.iter().map(|it| vec![it.choice.clone(), share(&it.by_half), it.given.to_string()]).collect();
    let mut blocks = vec![
        Block::Heading(format!("Interactions: {place}")),
        Block::Text(format!(
            "{} of {} types of interaction were given to at least one video by some rater, {} by at least half of its raters.",
            categories.given,
            categories.categories.len(),
            categories.by_half
        )),
        table(
            &[
                "interaction",
                "videos in which at least half of the raters see it",
                "videos in which anybody does",
            ],
            rows,
        ),
    ];
    if categories.source.is_none() {
        let bar: Vec<(String, f64)> =
            sorted.iter().map(|it| (it.choice.clone(), 100.0 * it.by_half.share)).collect();
        let title = "Videos in which at least half of the raters see an interaction";
        blocks.push(Block::Plot {
            file: "interactions.svg",
            title: title.into(),
            svg: bars(title, " %", &bar),
        });
    }
    blocks
}

fn source(source: Option<&String>) -> String {
    source.map_or_else(|| "all".into(), Clone::clone)
}

fn estimate(estimate: Option<Estimate>, digits: usize) -> String {
    let text = |it: Estimate| format!("{:.digits$} [{:.digits$}, {:.digits$}]", it.value, it.low, it.high);
    estimate.map_or_else(|| "–".into(), text)
}

fn share(share: &Share) -> String {
    format!("{:.3} [{:.3}, {:.3}] ({} of {})", share.share, share.low, share.high, share.count, share.of)
}

fn table(head: &[&str], rows: Vec<Vec<String>>) -> Block {
    Block::Table { head: head.iter().map(|&name| name.into()).collect(), rows }
}
