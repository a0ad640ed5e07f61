//! The results page of the documents: prose from a template, every figure from the benchmark.

use super::{charts, growth, mistakes, people, tables, training};
use minijinja::{Environment, Error, UndefinedBehavior, syntax::SyntaxConfig};
use phase_document::document::Block;
use phase_eval::{
    benchmark::{Benchmark, Familiarity, Origin, Row},
    goals::RecognitionSummary,
    trajectories::ForecastSummary,
};
use serde_json::{Map, Value, json};

/// The page's prose, and the places of its figures. Links in it are relative to the folder `docs`.
const TEMPLATE: &str = include_str!("results.md.jinja");
/// The page's pictures, in this folder of the documents.
const IMAGES: &str = "images";

/// A page and its pictures.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Page {
    /// The page as Markdown.
    pub text: String,
    /// The pictures: paths relative to the folder of the documents, and contents.
    pub pictures: Vec<(String, String)>,
}

/// The results page of a benchmark.
///
/// # Errors
/// If the benchmark lacks a figure that the prose takes for granted.
pub fn page(benchmark: &Benchmark) -> Result<Page, Error> {
    let growth = growth::blocks(benchmark);
    let charts = charts(benchmark);
    let pictures = charts.iter().chain(&growth).filter_map(|block| match block {
        Block::Plot { file, svg, .. } => Some((format!("{IMAGES}/{file}"), svg.clone())),
        _ => None,
    });
    let [layouts, interactions] = Familiarity::PAIRS;
    let table = |block: Option<Block>| block.map(|block| block.to_markdown().trim_end().to_owned());
    let parts =
        |pair| [tables::goal_parts(benchmark, pair), tables::trajectory_parts(benchmark, pair)].map(table);
    let values = json!({
        "options": benchmark.options.join(" "),
        "generator": benchmark.generator,
        "seed": benchmark.seed,
        "sets": benchmark.sets.iter().map(|set| (set.label.clone(), json!(set))).collect::<Map<_, _>>(),
        "goals": figures(benchmark, &benchmark.goals, goal_figures),
        "trajectories": figures(benchmark, &benchmark.trajectories, trajectory_figures),
        "unseen_layouts": count(benchmark, Familiarity::UnseenLayout),
        "unseen_interactions": count(benchmark, Familiarity::UnseenInteraction),
        "goal_charts": charts.iter().map(in_page).collect::<Vec<_>>(),
        "goal_table": table(Some(tables::goals(benchmark))),
        "role_table": table(people::roles(benchmark)),
        "trajectory_table": table(Some(tables::trajectories(benchmark))),
        "ablation_table": table(Some(tables::ablation(benchmark))),
        "mistake_table": table(mistakes::table(benchmark)),
        "layout_tables": parts(layouts),
        "interaction_tables": parts(interactions),
        "agreement_table": table(people::agreement(benchmark)),
        "report_protocol": people::protocol(benchmark),
        "ratings": ratings(benchmark),
        "pair_table": table(tables::sets(benchmark)),
        "training_table": table(training::table(benchmark)),
        "growth": growth.iter().map(in_page).collect::<Vec<_>>(),
    });
    let mut environment = Environment::empty();
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).keep_trailing_newline(true).build()?);
    // A figure that does not exist may be asked for, not shown.
    environment.set_undefined_behavior(UndefinedBehavior::SemiStrict);
    let values = minijinja::Value::from(minijinja::value::Serde(values));
    let text = environment.render_named_str("results.md", TEMPLATE, values)?;
    Ok(Page { text, pictures: pictures.collect() })
}

/// A block of a section; pictures are in their own folder.
fn in_page(block: &Block) -> String {
    match block {
        Block::Plot { file, title, .. } => format!("![{title}](../{IMAGES}/{file})"),
        block => block.to_markdown().trim_end().to_owned(),
    }
}

/// The figures of single methods for the prose: by the label of the set, then by method.
fn figures<S>(benchmark: &Benchmark, rows: &[Row<S>], of: fn(&Row<S>) -> Value) -> Value {
    let of_set = |set: usize| -> Map<String, Value> {
        let rows = rows.iter().filter(|row| row.set == set && row.origin == Origin::Ours);
        rows.map(|row| (row.method.clone(), of(row))).collect()
    };
    let sets = benchmark.sets.iter().enumerate();
    sets.map(|(index, set)| (set.label.clone(), Value::Object(of_set(index)))).collect::<Map<_, _>>().into()
}

fn goal_figures(row: &Row<RecognitionSummary>) -> Value {
    let scores = &row.summary.all;
    let agents = 2 * row.summary.all.n;
    let right = row.mistakes.as_ref().map_or(0, |mistakes| mistakes.right);
    json!({
        "top1": format!("{:.3}", scores.top1.value),
        "relation": format!("{:.3}", scores.relation.value),
        "wrong": agents - right.min(agents),
        "wrong_landmark": row.mistakes.as_ref().map_or(0, |mistakes| mistakes.landmark),
    })
}

fn trajectory_figures(row: &Row<ForecastSummary>) -> Value {
    let scores = &row.summary.all;
    json!({ "ade": format!("{:.2}", scores.ade.value), "fde": format!("{:.2}", scores.fde.value) })
}

/// Number of events of a kind, of the first method that was asked about them.
fn count(benchmark: &Benchmark, familiarity: Familiarity) -> usize {
    let mut parts = benchmark.goals.iter().flat_map(|row| &row.parts);
    parts.find(|part| part.familiarity == familiarity).map_or(0, |part| part.summary.all.n)
}

/// Number of ratings, of the first method that was compared with them.
fn ratings(benchmark: &Benchmark) -> Option<usize> {
    benchmark.goals.iter().find_map(|row| Some(row.summary.agreement.as_ref()?.ratings))
}
