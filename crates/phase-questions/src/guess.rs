//! Guesses without the motion: the best that a rule makes of the words alone, or of the words and the first
//! frame.

use crate::{Control, Query, Question};
use std::collections::BTreeMap;

/// The guessed option of every question under [`Control::NoVideo`] or [`Control::FirstFrame`]; all other
/// controls count as the former.
///
/// The rule chooses the value that is right most often among the questions that look alike: of the same type,
/// about the same things and moments, and, where the first frame is seen, of the same stratum, which says
/// where everything is in it. The counts are those of these very questions, so that its accuracy is an upper
/// bound of what can be guessed from these features.
#[must_use]
pub fn guesses(questions: &[Question], control: Control) -> Vec<usize> {
    let key = |question: &Question| {
        let frame = if control == Control::FirstFrame { question.stratum.as_str() } else { "" };
        let about = match question.query {
            Query::Seen { step, .. } | Query::RoomAt { step, .. } | Query::Believes { step, .. } => step,
            _ => 0,
        };
        (question.query.type_name(), about, frame.to_owned())
    };
    let mut right: BTreeMap<(_, &str), usize> = BTreeMap::new();
    let mut shown: BTreeMap<(_, &str), usize> = BTreeMap::new();
    for question in questions {
        for (k, option) in question.options.iter().enumerate() {
            *shown.entry((key(question), option.value.as_str())).or_default() += 1;
            *right.entry((key(question), option.value.as_str())).or_default() +=
                usize::from(k == question.answer);
        }
    }
    let share = |question: &Question, k: usize| {
        let place = (key(question), question.options[k].value.as_str());
        let right = right.get(&place).copied().unwrap_or_default() as f64;
        right / shown.get(&place).copied().unwrap_or_default().max(1) as f64
    };
    let best = |question: &Question| {
        let options = 0..question.options.len();
        options.max_by(|&a, &b| share(question, a).total_cmp(&share(question, b)).then(b.cmp(&a)))
    };
    questions.iter().map(|question| best(question).unwrap_or_default()).collect()
}
