//! From events to questions whose answers cannot be guessed.

use crate::{
    BUDGETS, Choice, Facts, FrameBudget, Query, Question, Watched,
    ask::{Draft, about_event},
    beliefs::about_beliefs,
    pairs::about_pair,
    words,
};
use phase_model::{AgentId, Entity, ObjectId, words::Names};
use rand::{Rng, RngExt, seq::SliceRandom};
use std::collections::{BTreeMap, BTreeSet};

/// Makes questions about events. Events of one set follow each other.
///
/// Within a stratum, that is among questions that look alike without motion, every answer is right equally
/// often: questions that would make one more frequent are left out, at random. Right options stand at every
/// place equally often. Of each type no more than `per_type` are made.
///
/// No question about an event tells the answer of another one about it: where an agent is said to know of an
/// object that it does not see, it is not asked whether it has seen it; where a goal is named, it is not
/// asked what anybody wants, or where its subject ends.
#[must_use]
pub fn questions<R: Rng>(
    events: &[Facts],
    names: &Names,
    per_type: Option<usize>,
    random: &mut R,
) -> Vec<Question> {
    let mut drafts: Vec<Draft> = events.iter().flat_map(about_event).collect();
    without_hints(&mut drafts);
    let mut first = 0;
    while first < events.len() {
        let set = &events[first].set;
        let after = events[first..].iter().position(|it| it.set != *set).map_or(events.len(), |k| first + k);
        if set.is_some() {
            for one in first..after {
                for other in one + 1..after {
                    let pair = [&events[one], &events[other]];
                    drafts.extend(about_pair(pair));
                    drafts.extend(about_beliefs(pair));
                }
            }
        }
        first = after.max(first + 1);
    }
    let mut by_type: BTreeMap<usize, Vec<Draft>> = BTreeMap::new();
    for draft in drafts {
        let name = draft.query.type_name();
        let place = Query::TYPES.iter().position(|known| *known == name).unwrap_or_default();
        by_type.entry(place).or_default().push(draft);
    }
    let mut questions = Vec::new();
    for drafts in by_type.into_values() {
        questions.extend(worded(balanced(drafts, per_type, random), names, random));
    }
    questions
}

/// Leaves out questions that the words of another about the same event answer.
fn without_hints(drafts: &mut Vec<Draft>) {
    let told: BTreeSet<(String, AgentId, ObjectId)> = drafts
        .iter()
        .filter_map(|draft| match draft.query {
            Query::Believes { agent, object, .. } => Some((draft.events[0].clone(), agent, object)),
            _ => None,
        })
        .collect();
    let goals: BTreeSet<(String, Entity)> = drafts
        .iter()
        .filter_map(|draft| match draft.query {
            Query::Without { judged, .. } => Some((draft.events[0].clone(), judged.subject())),
            _ => None,
        })
        .collect();
    let with_goals: BTreeSet<String> = goals.iter().map(|(event, _)| event.clone()).collect();
    drafts.retain(|draft| match draft.query {
        Query::Seen { agent, object, .. } => !told.contains(&(draft.events[0].clone(), agent, object)),
        Query::Goal { .. } => !with_goals.contains(&draft.events[0]),
        Query::EndRoom { entity } => !goals.contains(&(draft.events[0].clone(), entity)),
        _ => true,
    });
}

/// Leaves out questions until all values are equally frequent in every stratum, and no more than `most` are
/// left. Two events side by side are swapped instead.
fn balanced<R: Rng>(drafts: Vec<Draft>, most: Option<usize>, random: &mut R) -> Vec<Draft> {
    let mut strata: BTreeMap<String, Vec<Draft>> = BTreeMap::new();
    for draft in drafts {
        strata.entry(draft.stratum.clone()).or_default().push(draft);
    }
    // Questions of one stratum, in which every value is right once.
    let mut rounds: Vec<Vec<Draft>> = Vec::new();
    for mut drafts in strata.into_values() {
        drafts.shuffle(random);
        if drafts[0].events.len() == 2 {
            for (k, draft) in drafts.iter_mut().enumerate() {
                if draft.value != (k % 2).to_string() {
                    draft.events.reverse();
                    draft.value = (k % 2).to_string();
                }
            }
        }
        let mut by_value: BTreeMap<String, Vec<Draft>> =
            drafts[0].values.iter().map(|value| (value.clone(), Vec::new())).collect();
        for draft in drafts {
            by_value.entry(draft.value.clone()).or_default().push(draft);
        }
        let least = by_value.values().map(Vec::len).min().unwrap_or_default();
        rounds.extend((0..least).map(|_| by_value.values_mut().filter_map(Vec::pop).collect()));
    }
    rounds.shuffle(random);
    let mut left = most.unwrap_or(usize::MAX);
    let mut kept: Vec<Draft> = Vec::new();
    for round in rounds {
        if round.len() <= left {
            left -= round.len();
            kept.extend(round);
        }
    }
    kept.shuffle(random);
    kept
}

/// Gives drafts of one type their words and the order of their options.
fn worded<R: Rng>(drafts: Vec<Draft>, names: &Names, random: &mut R) -> Vec<Question> {
    let mut questions = Vec::with_capacity(drafts.len());
    for (k, draft) in drafts.into_iter().enumerate() {
        let Draft { query, events, set, until, value, stratum, proof, p_human, .. } = draft;
        let mut others: Vec<String> = draft.values.iter().filter(|it| **it != value).cloned().collect();
        others.shuffle(random);
        let count = others.len() + 1;
        // Pairs are in place already: left is left.
        let mut values = others;
        let answer = if events.len() == 2 {
            values = draft.values.clone();
            values.iter().position(|it| *it == value).unwrap_or_default()
        } else {
            values.insert(k % count, value);
            k % count
        };
        let human = |shares: Vec<f64>| {
            let share = |value: &String| {
                draft.values.iter().position(|it| it == value).and_then(|k| shares.get(k).copied())
            };
            values.iter().map(|value| share(value).unwrap_or_default()).collect()
        };
        let video = match (&events[..], until) {
            ([event], Some(step)) => format!("{event}-until{step}"),
            (events, _) => events.join("-beside-"),
        };
        questions.push(Question {
            id: format!("{}-{:04}", query.type_name(), k + 1),
            p_human: p_human.map(human),
            text: words::question(&query, random.random_range(0..words::PHRASINGS), names),
            options: values
                .iter()
                .map(|value| Choice { value: value.clone(), text: words::option(&query, value, names) })
                .collect(),
            query,
            events,
            video,
            set,
            until,
            answer,
            frames: None,
            stratum,
            proof,
        });
    }
    questions
}

/// The least number of frames from which, and from every greater number, a question is answered right.
/// `watch` gives what somebody sees in a number of frames of its events.
pub fn frames_needed(
    question: &Question,
    mut watch: impl FnMut(&str, FrameBudget) -> Option<Watched>,
) -> Option<FrameBudget> {
    let values: Vec<String> = question.options.iter().map(|option| option.value.clone()).collect();
    let mut least = None;
    for budget in BUDGETS.into_iter().rev() {
        let watched: Option<Vec<Watched>> =
            question.events.iter().map(|event| watch(event, budget)).collect();
        match watched.and_then(|watched| question.query.choice(&watched, &values)) {
            Some(choice) if choice == question.answer => least = Some(budget),
            _ => break,
        }
    }
    least
}
