//! The tables of the Psych-DS dataset.

use super::csv::{Cell, Table};
use crate::{
    config::StudyConfig,
    forms::{Forms, MOST_OBJECTS},
    question::{Given, Kind, Question, Responses},
    record::{Rater, Trial},
};

/// A column for each question, or for each choice of one that wants several.
fn question_columns(table: &mut Table, questions: &[Question], prefix: &str) {
    for question in questions {
        match &question.kind {
            Kind::Many { choices } => {
                for choice in choices {
                    let name = format!("{prefix}{}_{}", question.name, choice.value.replace([' ', '-'], "_"));
                    table.column(name, format!("Whether {:?} was chosen of: {}", choice.text, question.text));
                }
            }
            Kind::One { choices } | Kind::List { choices } => {
                let known: Vec<String> = choices.iter().map(|choice| choice.value.clone()).collect();
                let text = format!("Answer to: {} One of: {}.", question.text, known.join("; "));
                table.column(format!("{prefix}{}", question.name), text);
            }
            Kind::Whole { .. } | Kind::Text { .. } => {
                table.column(format!("{prefix}{}", question.name), format!("Answer to: {}", question.text));
            }
        }
    }
}

fn question_cells(questions: &[Question], answer: Option<&Responses>) -> Vec<Cell> {
    let mut cells = Vec::new();
    for question in questions {
        let given = answer.and_then(|answer| answer.get(&question.name));
        match (&question.kind, given) {
            (Kind::Many { choices }, Some(given)) => {
                cells.extend(choices.iter().map(|choice| Cell::Truth(given.has(&choice.value))));
            }
            (Kind::Many { choices }, None) => cells.extend(choices.iter().map(|_| Cell::Missing)),
            (_, Some(Given::Text(text))) => cells.push(Cell::Text(text.clone())),
            (_, Some(Given::Number(number))) => cells.push(Cell::Number(*number)),
            (_, Some(Given::Many(_)) | None) => cells.push(Cell::Missing),
        }
    }
    cells
}

/// A row for each answer, in the order of raters and trials.
pub(super) fn answers(config: &StudyConfig, forms: &Forms, raters: &[&Rater]) -> Table {
    let questions = forms.questions(config.form, MOST_OBJECTS);
    let mut table = Table::default();
    table.column("rater", "Number of the rater, from 1, in the order in which raters came");
    table.column("standing", "complete: the rater has answered everything and counts; failed: it failed more catch trials than allowed; unfinished: it has not answered everything");
    table.column("trial", "Place of the video among those of the rater, from 1");
    table.column("stimulus", "Id of the video");
    table.column("source", "Where the video comes from; missing for catch trials");
    table.column("catch", "Whether it is a catch trial, a video with a known answer");
    table.column("catch_passed", "Of a catch trial, whether the answer is right; missing for others");
    question_columns(&mut table, &questions, "");
    table.measure(
        "response_time",
        "ms",
        "Time from the first sight of the trial until the answer, as the rater's browser measured it",
    );
    table.column("plays", "How often the rater played the video to its end before it answered");
    table.measure("time", "s", "When the answer was stored, in seconds since the rater came");
    for rater in raters {
        let standing = rater.standing(config).name();
        for (k, trial) in rater.trials.iter().enumerate() {
            let Some(given) = &trial.given else { continue };
            let mut cells = vec![
                Cell::Number(i64::try_from(rater.number).unwrap_or(i64::MAX)),
                Cell::Text(standing.into()),
                Cell::Number(k as i64 + 1),
                Cell::Text(trial.shown.clone()),
                source(config, trial).map_or(Cell::Missing, |source| Cell::Text(source.into())),
                Cell::Truth(trial.catch),
                trial.passed(config).map_or(Cell::Missing, Cell::Truth),
            ];
            cells.extend(question_cells(&questions, Some(&given.answer)));
            cells.extend(
                [given.response_time, given.plays, (given.at - rater.joined) / 1000].map(Cell::Number),
            );
            table.row(cells);
        }
    }
    table
}

/// A row for each rater.
pub(super) fn raters(config: &StudyConfig, raters: &[&Rater], external_ids: bool) -> Table {
    let mut table = Table::default();
    table.column("rater", "Number of the rater, from 1, in the order in which raters came");
    table.column("standing", "As in the table of answers");
    table.column("group", "The source whose videos it saw, where a rater sees those of one source alone");
    table.column("trials", "How many videos it was to see, catch trials included");
    table.column("answers", "How many it has answered");
    table.column("catch_failures", "How many catch trials it answered wrongly");
    if external_ids {
        for name in &config.parameters {
            table.column(
                format!("external_{name}"),
                format!("Member {name} of the address with which it came"),
            );
        }
    }
    question_columns(&mut table, &config.demographics, "demographics_");
    for rater in raters {
        let answered = rater.trials.iter().filter(|trial| trial.given.is_some()).count();
        let group =
            rater.trials.iter().find_map(|trial| source(config, trial)).filter(|_| config.between_sources);
        let mut cells = vec![
            Cell::Number(i64::try_from(rater.number).unwrap_or(i64::MAX)),
            Cell::Text(rater.standing(config).name().into()),
            group.map_or(Cell::Missing, |group| Cell::Text(group.into())),
            Cell::Number(rater.trials.len() as i64),
            Cell::Number(answered as i64),
            Cell::Number(rater.catch_failures(config) as i64),
        ];
        if external_ids {
            let of =
                |name: &String| rater.parameters.get(name).map_or(Cell::Missing, |it| Cell::Text(it.clone()));
            cells.extend(config.parameters.iter().map(of));
        }
        cells.extend(question_cells(
            &config.demographics,
            rater.demographics.as_ref().map(|(_, answer)| answer),
        ));
        table.row(cells);
    }
    table
}

fn source<'a>(config: &'a StudyConfig, trial: &Trial) -> Option<&'a str> {
    let stimulus = (!trial.catch).then(|| config.stimulus(&trial.shown)).flatten()?;
    Some(&stimulus.source)
}
