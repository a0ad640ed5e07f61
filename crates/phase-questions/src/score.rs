//! The score of answers: by type, number of frames and control.

use crate::{Control, FrameBudget, Query, Question, accepted};
use phase_model::words::Names;
use phase_statistics::wilson_interval;
use serde::Serialize;
use std::collections::BTreeMap;

/// An answer to a question.
#[derive(Clone, PartialEq, Debug)]
pub struct Answer {
    /// The question.
    pub id: String,
    /// The material that was shown with it.
    pub control: Control,
    /// The option that was chosen; none if the answer names none. An index that is no option's is wrong: a
    /// free answer can name a value that is no option.
    pub option: Option<usize>,
    /// The probability of every option, if there are any; they sum to 1.
    pub probabilities: Option<Vec<f64>>,
}

/// Right answers of a number of them.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Accuracy {
    /// Right answers.
    pub right: usize,
    /// All answers.
    pub of: usize,
    /// The share of right ones.
    pub accuracy: f64,
    /// Lower end of Wilson's 95 % interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Accuracy of random choice.
    pub chance: f64,
}

/// One line of a score.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Row {
    /// The material that was shown.
    pub control: &'static str,
    /// The name of a type, `all`, `frames 8` (questions that need so many) or `frames not certified`.
    pub group: String,
    /// Right answers in the group.
    #[serde(flatten)]
    pub accuracy: Accuracy,
}

/// The score of a file of answers.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Score {
    /// Answers that name no option, which count as wrong.
    pub unreadable: usize,
    /// By control: all questions, every type, and every number of frames that questions need.
    pub rows: Vec<Row>,
    /// Sets of events that differ in one social variable of which all relations were answered right, of those
    /// of which all were answered.
    pub sets: Option<Accuracy>,
    /// Pairs of questions of one type about two events with opposite beliefs of which both were answered
    /// right, of those of which both were answered.
    pub belief_pairs: Option<Accuracy>,
    /// Mean cross-entropy of people's answers with the given probabilities (nat), where both are known.
    pub cross_entropy: Option<f64>,
    /// The mean entropy of people's answers there, the least cross-entropy that is possible.
    pub human_entropy: Option<f64>,
}

/// The least probability that counts, so that one answer does not decide the mean.
const LEAST: f64 = 1e-3;

/// Scores answers to questions; answers to other questions are left out, which the caller has to prevent.
#[must_use]
pub fn score(questions: &[Question], answers: &[Answer]) -> Score {
    let by_id: BTreeMap<&str, &Question> = questions.iter().map(|it| (it.id.as_str(), it)).collect();
    let answered: Vec<(&Question, &Answer)> =
        answers.iter().filter_map(|answer| Some((*by_id.get(answer.id.as_str())?, answer))).collect();
    let mut groups: BTreeMap<(Control, usize, String), Vec<(bool, f64)>> = BTreeMap::new();
    for (question, answer) in &answered {
        let right = answer.option == Some(question.answer);
        let choices = match answer.control {
            Control::FreeForm => accepted(&question.query, &Names::PAPER).len(),
            _ => question.options.len(),
        };
        let entry = (right, 1.0 / choices.max(1) as f64);
        let frames = match question.frames {
            Some(FrameBudget::Frames(frames)) => format!("frames {frames}"),
            Some(FrameBudget::All) => "frames all".to_owned(),
            None => "frames not certified".to_owned(),
        };
        let order = question.frames.map_or(usize::MAX, |frames| match frames.number() {
            0 => usize::MAX - 1,
            frames => 1000 + frames,
        });
        let place = Query::TYPES.iter().position(|name| *name == question.query.type_name());
        for (order, group) in [
            (0, "all".to_owned()),
            (1 + place.unwrap_or_default(), question.query.type_name().to_owned()),
            (order, frames),
        ] {
            groups.entry((answer.control, order, group)).or_default().push(entry);
        }
    }
    let rows = groups.into_iter().map(|((control, _, group), entries)| Row {
        control: control.name(),
        group,
        accuracy: accuracy(&entries),
    });
    let human: Vec<(f64, f64)> = answered
        .iter()
        .filter_map(|(question, answer)| {
            let people = question.p_human.as_ref()?;
            let model = answer.probabilities.as_ref()?;
            let cross = |(p, q): (&f64, &f64)| -p * libm::log(q.max(LEAST));
            let own = people.iter().filter(|p| **p > 0.0).map(|p| -p * libm::log(*p)).sum();
            Some((people.iter().zip(model).map(cross).sum(), own))
        })
        .collect();
    let mean = |pick: fn(&(f64, f64)) -> f64| {
        (!human.is_empty()).then(|| human.iter().map(pick).sum::<f64>() / human.len() as f64)
    };
    Score {
        unreadable: answers.iter().filter(|answer| answer.option.is_none()).count(),
        rows: rows.collect(),
        sets: sets(&answered, |query| matches!(query, Query::Relation)),
        belief_pairs: sets(&answered, |query| {
            matches!(query, Query::Expects { .. } | Query::IsRight { .. } | Query::LooksNext { .. })
        }),
        cross_entropy: mean(|it| it.0),
        human_entropy: mean(|it| it.1),
    }
}

fn accuracy(entries: &[(bool, f64)]) -> Accuracy {
    let right = entries.iter().filter(|(right, _)| *right).count();
    let of = entries.len();
    let interval = wilson_interval(right, of);
    let chance = entries.iter().map(|(_, chance)| chance).sum::<f64>() / of.max(1) as f64;
    Accuracy {
        right,
        of,
        accuracy: right as f64 / of.max(1) as f64,
        low: interval.low,
        high: interval.high,
        chance,
    }
}

/// Sets of which every answer to questions of one type is right, of the types that are meant.
fn sets(answered: &[(&Question, &Answer)], is_meant: impl Fn(&Query) -> bool) -> Option<Accuracy> {
    let mut sets: BTreeMap<(&str, &str), (usize, bool, f64)> = BTreeMap::new();
    for (question, answer) in answered {
        let (Some(set), true, Control::Video) = (&question.set, is_meant(&question.query), answer.control)
        else {
            continue;
        };
        let entry = sets.entry((set, question.query.type_name())).or_insert((0, true, 1.0));
        entry.0 += 1;
        entry.1 &= answer.option == Some(question.answer);
        entry.2 /= question.options.len() as f64;
    }
    let whole: Vec<(bool, f64)> = sets
        .into_values()
        .filter(|(count, ..)| *count > 1)
        .map(|(_, right, chance)| (right, chance))
        .collect();
    (!whole.is_empty()).then(|| accuracy(&whole))
}
