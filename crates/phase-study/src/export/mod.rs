//! Answers for others: a Psych-DS dataset, and `phase-ratings/1`.
//!
//! Raters who withdrew or did not agree are in neither. Those who failed catch trials or have not finished
//! are marked in the tables of the dataset and left out of the ratings. Raters are numbers; the members of
//! the address with which they came are only exported on demand.

mod csv;
mod jspsych;
mod tables;

pub use jspsych::{JsPsychError, Participant, participants, ratings_of};

use crate::{
    config::StudyConfig,
    forms::{Form, Forms, RELATION},
    record::{Rater, Standing},
};
use csv::Table;
use phase_eval::ratings::{RATINGS_FORMAT, RatingCounts};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// By relation, the count of one rater who names it.
const RELATIONS: [(&str, RatingCounts); 3] = [
    ("friendly", RatingCounts { friendly: 1, adversarial: 0, neutral: 0 }),
    ("adversarial", RatingCounts { friendly: 0, adversarial: 1, neutral: 0 }),
    ("neutral", RatingCounts { friendly: 0, adversarial: 0, neutral: 1 }),
];

/// A file of an export.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct File {
    /// Its path in the folder of the export, with `/`.
    pub path: String,
    /// Its contents.
    pub text: String,
}

/// The Psych-DS dataset of a study (<https://psych-ds.github.io/>): `dataset_description.json`, `README.md`
/// and three tables in `data`, of answers, of raters and of videos; `docs/reference/formats/studies.md` has
/// their columns. With `external_ids` the table of raters has the members of the address with which they
/// came.
#[must_use]
pub fn psych_ds(config: &StudyConfig, forms: &Forms, raters: &[Rater], external_ids: bool) -> Vec<File> {
    let present: Vec<&Rater> = raters.iter().filter(|rater| rater.departure.is_none()).collect();
    // Values of keywords in names of files have letters and digits alone.
    let study: String = config.name.chars().filter(char::is_ascii_alphanumeric).collect();
    let tables = [
        ("answers", tables::answers(config, forms, &present)),
        ("raters", tables::raters(config, &present, external_ids)),
        ("stimuli", tables::stimuli(config)),
    ];
    let mut files: Vec<File> = Vec::new();
    for (what, table) in &tables {
        files.push(File {
            path: format!("data/study-{study}_description-{what}_data.csv"),
            text: table.to_csv(),
        });
    }
    let description = description(config, &tables.each_ref().map(|(_, table)| table));
    files.push(File { path: "dataset_description.json".into(), text: format!("{description:#}\n") });
    files.push(File { path: "README.md".into(), text: readme(config, [0, 1, 2].map(|k| &*files[k].path)) });
    files
}

fn description(config: &StudyConfig, tables: &[&Table; 3]) -> Value {
    let mut variables = BTreeMap::new();
    for column in tables.iter().flat_map(|table| table.columns()) {
        variables.entry(column.name.as_str()).or_insert_with(|| {
            let mut variable = json!({
                "@type": "PropertyValue", "name": column.name, "description": column.description,
            });
            if let Some(unit) = column.unit {
                variable["unitText"] = unit.into();
            }
            variable
        });
    }
    json!({
        "@context": "http://schema.org/",
        "@type": "Dataset",
        "name": config.title,
        "description": format!(
            "Answers of raters to the form {:?} about {} videos, each by {} raters or more, collected with PHASE.",
            config.form.name(), config.stimuli.len(), config.raters_per_video
        ),
        "variableMeasured": variables.into_values().collect::<Vec<_>>(),
    })
}

fn readme(config: &StudyConfig, [answers, raters, stimuli]: [&str; 3]) -> String {
    format!(
        "# {}\n\nA [Psych-DS](https://psych-ds.github.io/) dataset of the study `{}`. `{answers}` has a row for each answer, `{raters}` one \
         for each rater, `{stimuli}` one for each video; `dataset_description.json` describes their columns. Times are in milliseconds. \
         Raters who withdrew are in none of them. Rows with `standing` other than \
         `complete` do not count in the analysis. An apostrophe stands before texts that a spreadsheet would take for formulas.\n",
        config.title, config.name
    )
}

/// Numbers of raters who count and called each video friendly, neutral and adversarial (`phase-ratings/1`),
/// which `phase eval goals --ratings` reads. `None` if the form does not ask for relations.
#[must_use]
pub fn ratings(config: &StudyConfig, raters: &[Rater]) -> Option<Value> {
    if config.form == Form::Interactions {
        return None;
    }
    let mut counts = BTreeMap::<&str, RatingCounts>::new();
    for rater in raters.iter().filter(|rater| rater.standing(config) == Standing::Complete) {
        for trial in rater.trials.iter().filter(|trial| !trial.catch) {
            let answer = trial.given.as_ref().and_then(|given| given.answer.get(RELATION)?.text());
            if let Some((_, one)) = RELATIONS.iter().find(|(name, _)| Some(*name) == answer) {
                *counts.entry(&trial.shown).or_default() += *one;
            }
        }
    }
    Some(document_of(&counts))
}

/// Counts by event as `phase-ratings/1`.
fn document_of(counts: &BTreeMap<&str, RatingCounts>) -> Value {
    json!({"format": RATINGS_FORMAT, "ratings": counts})
}
