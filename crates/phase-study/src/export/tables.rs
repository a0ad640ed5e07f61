//! The tables of the Psych-DS dataset.

use super::csv::{Cell, Table};
use crate::{
    config::{Stimulus, StudyConfig},
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
    table.column("standing", "complete: the rater has answered everything and counts; failed: the rater failed more catch trials than allowed; unfinished: the rater has not answered everything");
    table.column("trial", "Place of the video among those of the rater, from 1");
    table.column("stimulus", "Id of the video");
    label_columns(&mut table);
    table.column("catch", "Whether it is a catch trial, a video with a known answer");
    table.column("catch_passed", "Of a catch trial, whether the answer is right; missing for others");
    question_columns(&mut table, &questions, "");
    table.measure(
        "response_time",
        "ms",
        "Time from the first sight of the trial until the answer, as the rater's browser measured it",
    );
    table.column("plays", "How often the rater played the video to its end before it answered");
    table.measure("time", "ms", "When the answer was stored, since the rater came");
    for rater in raters {
        let standing = rater.standing(config).name();
        for (k, trial) in rater.trials.iter().enumerate() {
            let Some(given) = &trial.given else { continue };
            let mut cells = vec![
                Cell::Number(i64::try_from(rater.number).unwrap_or(i64::MAX)),
                Cell::Text(standing.into()),
                Cell::Number(k as i64 + 1),
                Cell::Text(trial.shown.clone()),
            ];
            cells.extend(label_cells(stimulus(config, trial)));
            cells.extend([Cell::Truth(trial.catch), trial.passed(config).map_or(Cell::Missing, Cell::Truth)]);
            cells.extend(question_cells(&questions, Some(&given.answer)));
            cells.extend([given.response_time, given.plays, given.at - rater.joined].map(Cell::Number));
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
    table.column("group", "The source of the rater's videos, where a rater sees those of one source alone");
    table.column("trials", "Number of the rater's videos, catch trials included");
    table.column("answers", "Number of the rater's answers");
    table.column("catch_failures", "Number of catch trials that the rater answered wrongly");
    if external_ids {
        for name in &config.parameters {
            table.column(
                format!("external_{name}"),
                format!("Member {name} of the address with which the rater came"),
            );
        }
    }
    question_columns(&mut table, &config.demographics, "demographics_");
    for rater in raters {
        let answered = rater.trials.iter().filter(|trial| trial.given.is_some()).count();
        let group =
            rater.trials.iter().find_map(|trial| stimulus(config, trial)).filter(|_| config.between_sources);
        let mut cells = vec![
            Cell::Number(i64::try_from(rater.number).unwrap_or(i64::MAX)),
            Cell::Text(rater.standing(config).name().into()),
            text(group.map(|stimulus| &stimulus.source)),
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

/// A row for each video, catch trials last.
pub(super) fn stimuli(config: &StudyConfig) -> Table {
    let mut table = Table::default();
    table.column("stimulus", "Id of the video");
    table.column("video", "File of the video, relative to the configuration of the study");
    label_columns(&mut table);
    table.column("objects", "Number of objects in the video");
    table.column("catch", "Whether it is a catch trial, a video with a known answer");
    for stimulus in &config.stimuli {
        let mut cells = vec![Cell::Text(stimulus.id.clone()), Cell::Text(stimulus.video.clone())];
        cells.extend(label_cells(Some(stimulus)));
        cells.extend([Cell::Number(stimulus.objects.into()), Cell::Truth(false)]);
        table.row(cells);
    }
    for trial in &config.catch_trials {
        let mut cells = vec![Cell::Text(trial.id.clone()), Cell::Text(trial.video.clone())];
        cells.extend(label_cells(None));
        cells.extend([Cell::Number(trial.objects.into()), Cell::Truth(true)]);
        table.row(cells);
    }
    table
}

/// The columns of what is known of a video.
fn label_columns(table: &mut Table) {
    table.column("source", "Origin of the video; missing for catch trials");
    table.column("set", "Set that the video belongs to, such as a minimal pair");
    table.column("condition", "What was varied, and its value in this video");
    table.column("label_kind", "Kind of event");
    table.column("label_relation", "The right answer about the relation");
    for (name, agent) in [("label_goal_0", "red agent (agent 0)"), ("label_goal_1", "green agent (agent 1)")]
    {
        table.column(
            name,
            format!("The right answers about the goal of the {agent}, separated by semicolons"),
        );
    }
}

/// The cells of [`label_columns`].
fn label_cells(stimulus: Option<&Stimulus>) -> Vec<Cell> {
    let labels = stimulus.map(|stimulus| &stimulus.labels);
    let goal = |agent: usize| {
        let goals = labels.and_then(|labels| labels.goals.as_ref())?;
        Some(goals[agent].iter().map(String::as_str).collect::<Vec<_>>().join("; "))
    };
    vec![
        text(stimulus.map(|stimulus| &stimulus.source)),
        text(stimulus.and_then(|stimulus| stimulus.set.as_ref())),
        text(stimulus.and_then(|stimulus| stimulus.condition.as_ref())),
        text(labels.and_then(|labels| labels.kind.as_ref())),
        text(labels.and_then(|labels| labels.relation.as_ref())),
        text(goal(0).as_ref()),
        text(goal(1).as_ref()),
    ]
}

fn text(text: Option<&String>) -> Cell {
    text.map_or(Cell::Missing, |text| Cell::Text(text.clone()))
}

/// The video of a trial, unless it is a catch trial.
fn stimulus<'a>(config: &'a StudyConfig, trial: &Trial) -> Option<&'a Stimulus> {
    if trial.catch { None } else { config.stimulus(&trial.shown) }
}
