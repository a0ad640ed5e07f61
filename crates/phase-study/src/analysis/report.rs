//! An analysis as a text with tables and plots.

use super::{Accuracy, Analysis, Categories, Share};
use phase_document::{
    document::{Block, Document},
    plot::bars,
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
