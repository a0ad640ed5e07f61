//! Answers about the videos of each condition, of each set, and about each video; and which answers videos of
//! each label get.

use super::{
    Answers, Confusion,
    judgements::{Judged, Judgements},
};
use crate::{
    config::Stimulus,
    forms::{Form, Forms, GOALS, HUMAN_LIKENESS, INTERACTIONS, MOST_OBJECTS, RELATION},
    question::Responses,
};
use phase_eval::Estimate;
use phase_statistics::mean;
use std::collections::{BTreeMap, BTreeSet};

/// Things that an interval is over.
#[derive(Clone, Copy)]
pub(super) enum Over {
    Videos,
    Judgements,
}

/// The value of the condition in a video; where the configuration names none, its kind of event.
fn condition(stimulus: &Stimulus) -> Option<&str> {
    stimulus.condition.as_deref().or(stimulus.labels.kind.as_deref())
}

/// Answers by condition.
pub(super) fn by_condition(
    judgements: &Judgements<'_>,
    form: Form,
    forms: &Forms,
    seed: u64,
) -> Vec<Answers> {
    grouped(judgements, condition, Over::Videos, form, forms, seed)
}

/// Answers by set.
pub(super) fn by_set(judgements: &Judgements<'_>, form: Form, forms: &Forms, seed: u64) -> Vec<Answers> {
    grouped(judgements, |stimulus| stimulus.set.as_deref(), Over::Judgements, form, forms, seed)
}

/// Answers by video.
pub(super) fn by_video(judgements: &Judgements<'_>, form: Form, forms: &Forms, seed: u64) -> Vec<Answers> {
    grouped(judgements, |stimulus| Some(&stimulus.id), Over::Judgements, form, forms, seed)
}

fn grouped<'a>(
    judgements: &'a Judgements<'_>,
    name: impl Fn(&'a Stimulus) -> Option<&'a str>,
    over: Over,
    form: Form,
    forms: &Forms,
    seed: u64,
) -> Vec<Answers> {
    let mut groups = BTreeMap::<&str, Vec<&Judged<'_>>>::new();
    for judged in &judgements.0 {
        if let Some(name) = name(judged.stimulus) {
            groups.entry(name).or_default().push(judged);
        }
    }
    groups.into_iter().map(|(name, videos)| answers(name, &videos, over, form, forms, seed)).collect()
}

fn answers(name: &str, videos: &[&Judged<'_>], over: Over, form: Form, forms: &Forms, seed: u64) -> Answers {
    let estimate = |score: &dyn Fn(&Stimulus, &Responses) -> Option<f64>| {
        let of = |judged: &&Judged<'_>| -> Vec<f64> {
            judged.answers.iter().filter_map(|answer| score(judged.stimulus, answer)).collect()
        };
        let values: Vec<f64> = match over {
            Over::Judgements => videos.iter().flat_map(of).collect(),
            Over::Videos => videos.iter().filter_map(|judged| mean(&of(judged))).collect(),
        };
        Estimate::of(&values, seed)
    };
    let question = if form == Form::Interactions { INTERACTIONS } else { RELATION };
    let choices = choices(forms, form, question);
    let counts = counts(videos.iter().copied(), question, &choices);
    Answers {
        name: name.into(),
        videos: videos.len(),
        judgements: videos.iter().map(|judged| judged.answers.len()).sum(),
        given: choices.into_iter().zip(counts).collect(),
        relation_right: estimate(&|stimulus, answer| {
            let given = answer.get(RELATION)?;
            Some(f64::from(u8::from(given.has(stimulus.labels.relation.as_deref()?))))
        }),
        goals_right: estimate(&|stimulus, answer| {
            let right = |agent: usize, labels: &BTreeSet<String>| {
                let given = answer.get(GOALS[agent])?;
                Some(f64::from(u8::from(labels.iter().any(|label| given.has(label)))))
            };
            let labels = stimulus.labels.goals.as_ref()?;
            Some(0.5 * (right(0, &labels[0])? + right(1, &labels[1])?))
        }),
        human_likeness: estimate(&|_, answer| answer.get(HUMAN_LIKENESS)?.text()?.parse().ok()),
    }
}

/// Counts of the answers that videos of each relation get; of the form of interactions those of each
/// condition.
pub(super) fn confusion(judgements: &Judgements<'_>, form: Form, forms: &Forms) -> Option<Confusion> {
    let (question, label): (_, fn(&Stimulus) -> Option<&str>) = match form {
        Form::Interactions => (INTERACTIONS, condition),
        Form::Goals | Form::Relation => (RELATION, |stimulus| stimulus.labels.relation.as_deref()),
    };
    let labelled = judgements.0.iter().filter_map(|it| Some((label(it.stimulus)?.to_owned(), it, question)));
    confusion_of(question, choices(forms, form, question), labelled)
}

/// Counts of the answers that agents of each goal get.
pub(super) fn goal_confusion(judgements: &Judgements<'_>, form: Form, forms: &Forms) -> Option<Confusion> {
    if form != Form::Goals {
        return None;
    }
    let of_agent = |question: &'static str, agent: usize| {
        judgements.0.iter().filter_map(move |judged| {
            let right: Vec<&str> =
                judged.stimulus.labels.goals.as_ref()?[agent].iter().map(String::as_str).collect();
            Some((right.join(" or "), judged, question))
        })
    };
    let labelled = GOALS.iter().zip(0..).flat_map(|(question, agent)| of_agent(question, agent));
    confusion_of("goals", choices(forms, form, GOALS[0]), labelled)
}

/// Counts of the choices by label, from videos, each with its label and a question about it.
fn confusion_of<'a>(
    name: &'static str,
    choices: Vec<String>,
    labelled: impl Iterator<Item = (String, &'a Judged<'a>, &'static str)>,
) -> Option<Confusion> {
    let mut groups = BTreeMap::<String, (usize, Vec<usize>)>::new();
    for (label, judged, question) in labelled {
        let (judgements, sums) = groups.entry(label).or_insert_with(|| (0, vec![0; choices.len()]));
        *judgements += judged.answers.len();
        for (sum, count) in sums.iter_mut().zip(counts(core::iter::once(judged), question, &choices)) {
            *sum += count;
        }
    }
    // Labels that are answers come in the order of the form.
    let mut groups: Vec<(String, (usize, Vec<usize>))> = groups.into_iter().collect();
    groups.sort_by_key(|(label, _)| choices.iter().position(|choice| choice == label));
    (!groups.is_empty()).then(|| Confusion {
        question: name,
        judgements: groups.iter().map(|(_, (judgements, _))| *judgements).collect(),
        counts: groups.iter().map(|(_, (_, counts))| counts.clone()).collect(),
        labels: groups.into_iter().map(|(label, _)| label).collect(),
        answers: choices,
    })
}

fn choices(forms: &Forms, form: Form, question: &str) -> Vec<String> {
    let questions = forms.questions(form, MOST_OBJECTS);
    let asked = questions.iter().find(|asked| asked.name == question);
    asked.iter().flat_map(|asked| asked.kind.choices()).map(|choice| choice.value.clone()).collect()
}

/// Numbers of judgements of all these videos that give each choice.
fn counts<'a>(
    videos: impl Iterator<Item = &'a Judged<'a>>,
    question: &str,
    choices: &[String],
) -> Vec<usize> {
    let choices: Vec<&str> = choices.iter().map(String::as_str).collect();
    let mut sums = vec![0; choices.len()];
    for judged in videos {
        for (sum, count) in sums.iter_mut().zip(judged.counts(question, &choices)) {
            *sum += count;
        }
    }
    sums
}
