//! The page of a benchmark of questions.

use serde::Deserialize;
use std::{collections::BTreeMap, fmt::Write as _};

/// The description of a benchmark of questions, `questions.json`, as far as the page shows it.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct AskedQuestions {
    /// Number of questions.
    pub questions: usize,
    /// Number of videos.
    pub videos: usize,
    /// Number of questions by type.
    pub types: BTreeMap<String, usize>,
    /// SHA-256 of the questions.
    pub sha256: String,
    /// The method that certified numbers of frames.
    pub certified_by: String,
    /// Right answers by method, control and type.
    pub scores: Vec<TypeScore>,
}

/// Right answers of a method to the questions of a type.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct TypeScore {
    /// The method.
    pub method: String,
    /// The material that was shown.
    pub control: String,
    /// The type, or `all`.
    #[serde(rename = "type")]
    pub kind: String,
    /// Right answers.
    pub right: usize,
    /// Questions.
    pub of: usize,
    /// Accuracy of random choice.
    pub chance: f64,
}

/// Accuracy above chance from which a guess without motion is marked.
const MARKED: f64 = 0.03;

/// The page: accuracy by type of every method, beside guesses without motion. Guesses that are better than
/// chance by more than three points are marked.
#[must_use]
pub fn questions_page(asked: &AskedQuestions) -> String {
    let mut types: Vec<&str> = Vec::new();
    for score in asked.scores.iter().filter(|score| score.kind != "all") {
        if !types.contains(&score.kind.as_str()) {
            types.push(&score.kind);
        }
    }
    let mut columns: Vec<(&str, &str)> = Vec::new();
    for score in asked.scores.iter().filter(|score| score.method != "chance") {
        let column = (score.method.as_str(), score.control.as_str());
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    let heads: String = columns.iter().map(|(method, control)| format!(" {method}: {control} |")).collect();
    let mut rows = String::new();
    for kind in types.into_iter().chain(["all"]) {
        let of = |column: &(&str, &str)| {
            let same = |it: &&TypeScore| {
                (it.method.as_str(), it.control.as_str(), it.kind.as_str()) == (column.0, column.1, kind)
            };
            asked.scores.iter().find(same)
        };
        let Some(any) = columns.iter().find_map(of) else { continue };
        let cell = |column: &(&str, &str)| match of(column) {
            Some(it) => {
                let accuracy = it.right as f64 / it.of.max(1) as f64;
                let is_guess = matches!(it.control.as_str(), "no-video" | "first-frame");
                format!(
                    " {accuracy:.3}{} |",
                    if is_guess && accuracy > it.chance + MARKED { " †" } else { "" }
                )
            }
            None => " – |".to_owned(),
        };
        let cells: String = columns.iter().map(cell).collect();
        let _ = writeln!(rows, "| {kind} | {} | {:.3} |{cells}", any.of, any.chance);
    }
    let AskedQuestions { questions, videos, sha256, certified_by, .. } = asked;
    let kinds = asked.types.values().filter(|count| **count > 0).count();
    let rule = "---|".repeat(columns.len() + 3);
    format!(
        "# PHASE-Questions 1.0\n\n\
         <!-- Written by `cargo xtask results` from data/questions.json. -->\n\n\
         {questions} questions of {kinds} types about {videos} videos of the test events of phase-500, of phase-pairs and of \
         phase-beliefs, made by \
         [`phase questions`](../how-to/questions.md#phase-questions-10). SHA-256 of `questions.jsonl`: `{sha256}`. \
         Frames were certified by `{certified_by}`.\n\n\
         **No vision-language model was run.** People were not asked about these events.\n\n\
         | type | questions | chance |{heads}\n|{rule}\n{rows}\n\
         `guess` is a random forest that learns from the words, or from the words and the places, sizes and walls of the first \
         frame, and answers about events with other bodies. In balanced questions without a hint such a guess falls below \
         chance, because the value that is rarer among those left out is more frequent among those learnt from. †: more than \
         three points above chance.\n\n\
         Methods of the benchmark judge goals and relations, or what comes next; –: a method does not judge the type, or was not \
         asked, and `all` has the types that it judges. `rules` answers what happens by the definition of the right answer, and `stronger`, `seen` and what agents \
         believe by a rule from the motion: that row is a check of the questions, and of the order of frames.\n"
    )
}
