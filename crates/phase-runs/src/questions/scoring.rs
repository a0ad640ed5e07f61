//! The score of a file of answers, without any evaluator.

use super::QUESTIONS_FILE;
use crate::{error::RunError, laboratory::unusable};
use phase_files::{FileError, Problem, json, regular};
use phase_model::{
    json::{Field, FieldError, parse_line, read_as},
    words::Names,
};
use phase_questions::{Answer, Control, Question, Score, accepted, parse_answer, parse_free, score};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// A score, and what it is of.
#[derive(Clone, PartialEq, Debug)]
pub struct Scored {
    /// The score.
    pub score: Score,
    /// Number of answers.
    pub answers: usize,
    /// Number of questions of the benchmark.
    pub questions: usize,
}

/// A line of a file of answers.
struct Line {
    id: String,
    answer: String,
    control: Option<String>,
    probabilities: Option<Vec<f64>>,
}

impl Line {
    fn read(line: &Field<'_>) -> Result<Self, FieldError> {
        line.only(&["id", "answer", "control", "probabilities"])?;
        let number = |it: Field<'_>| it.value().as_f64().ok_or_else(|| it.must_be("a number"));
        let numbers = |list: Field<'_>| list.items()?.map(number).collect();
        Ok(Self {
            id: line.required("id")?.text()?.into(),
            answer: line.required("answer")?.text()?.into(),
            control: line.optional("control")?.map(|it| it.text().map(String::from)).transpose()?,
            probabilities: line.optional("probabilities")?.map(numbers).transpose()?,
        })
    }
}

/// Numbers of people who called events friendly, adversarial and neutral.
pub(super) fn ratings(file: &Path) -> Result<BTreeMap<String, [usize; 3]>, RunError> {
    let fail = |problem: Problem| FileError { file: file.to_owned(), problem };
    let value = phase_model::json::parse(&json::bytes(file)?).map_err(|error| fail(error.into()))?;
    let ratings = phase_eval::ratings::ratings(&value).map_err(|error| fail(Problem::content(error)))?;
    Ok(ratings.into_iter().map(|(id, counts)| (id, counts.counts())).collect())
}

/// Reads the questions of a benchmark, one a line.
pub(crate) fn questions(file: &Path) -> Result<Vec<Question>, RunError> {
    let text = regular::text(file)?;
    let read = |(k, line): (usize, &str)| {
        let value = parse_line(line.as_bytes(), k + 1).map_err(|error| unusable(file, &error.to_string()))?;
        read_as(value).map_err(|error| unusable(file, &format!("line {}: {error}", k + 1)))
    };
    text.lines().enumerate().map(read).collect()
}

/// Scores a JSONL file of answers (`id`, `answer`, perhaps `control` and `probabilities`) to the questions
/// of a folder or of a file of questions.
///
/// # Errors
/// If a file cannot be read, or a line is no answer to one of the questions, or the second one.
pub fn score_file(answers: &Path, benchmark: &Path) -> Result<Scored, RunError> {
    let file = if benchmark.is_dir() { benchmark.join(QUESTIONS_FILE) } else { benchmark.to_owned() };
    let questions = questions(&file)?;
    let known: BTreeMap<&str, &Question> = questions.iter().map(|it| (it.id.as_str(), it)).collect();
    let text = regular::text(answers)?;
    let mut all = Vec::new();
    let mut seen = BTreeSet::new();
    for (k, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let wrong = |rule: &str| unusable(answers, &format!("line {}: {rule}", k + 1));
        let value =
            parse_line(line.as_bytes(), k + 1).map_err(|error| unusable(answers, &error.to_string()))?;
        let Line { id, answer, control, probabilities } =
            Line::read(&Field::root(&value)).map_err(|error| wrong(&error.to_string()))?;
        let name = control.as_deref().unwrap_or(Control::Video.name());
        let names = || Control::ALL.map(Control::name).join(", ");
        let control = Control::named(name)
            .ok_or_else(|| wrong(&format!("control must be one of {}, not {name:?}", names())))?;
        let question =
            known.get(id.as_str()).ok_or_else(|| wrong(&format!("there is no question {id:?}")))?;
        if !seen.insert((id.clone(), control)) {
            return Err(wrong(&format!("question {id:?} is answered twice under control {name}")));
        }
        let (options, _) = question.shown(control);
        if let Some(shares) = &probabilities {
            let sum: f64 = shares.iter().sum();
            let valid = shares.iter().all(|share| (0.0..=1.0).contains(share)) && (sum - 1.0).abs() < 1e-3;
            if shares.len() != options.len() || !valid {
                return Err(wrong(&format!(
                    "probabilities must be {} numbers from 0 to 1 that sum to 1",
                    options.len()
                )));
            }
        }
        let option = if control == Control::FreeForm {
            if accepted(&question.query, &Names::PAPER).is_empty() {
                let name = question.query.type_name();
                return Err(wrong(&format!("questions of the type {name} are asked with options only")));
            }
            let value = parse_free(&answer, &question.query, &Names::PAPER);
            let place = |value| question.options.iter().position(|option| option.value == value);
            value.map(|value| place(value).unwrap_or(options.len()))
        } else {
            parse_answer(&answer, &options)
        };
        all.push(Answer { id, control, option, probabilities });
    }
    if all.is_empty() {
        return Err(unusable(answers, "has no answers"));
    }
    Ok(Scored { score: score(&questions, &all), answers: all.len(), questions: questions.len() })
}
