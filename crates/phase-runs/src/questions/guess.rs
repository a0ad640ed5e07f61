//! Guesses of a random forest without motion, from the words alone, or from the words and the first frame.

use phase_audit::{FirstFrame, cross_validated};
use phase_model::{AgentId, Entity, ObjectId};
use phase_questions::{Control, Facts, Query, Question};
use std::collections::{BTreeMap, BTreeSet};

/// The guessed option of every question under [`Control::NoVideo`], or [`Control::FirstFrame`].
///
/// For each type of question a forest learns the values of the answers from numbers of the question (agent,
/// entity, moment) and, where the first frame is seen, from all places, sizes and walls. It answers questions
/// about events whose bodies it has not seen in training. Where it names a value that is no option, the guess
/// is the first one.
pub(super) fn guesses(all: &[Question], facts: &BTreeMap<&str, &Facts>, control: Control) -> Vec<usize> {
    let mut guessed = vec![0; all.len()];
    for name in Query::TYPES {
        let of: Vec<usize> = (0..all.len()).filter(|&k| all[k].query.type_name() == name).collect();
        let values: BTreeSet<&str> =
            of.iter().map(|&k| all[k].options[all[k].answer].value.as_str()).collect();
        let values: Vec<&str> = values.into_iter().collect();
        let class = |question: &Question| {
            let right = question.options[question.answer].value.as_str();
            values.iter().position(|value| *value == right).unwrap_or_default() as u32
        };
        let classes: Vec<u32> = of.iter().map(|&k| class(&all[k])).collect();
        let frames: Vec<Option<FirstFrame>> = of
            .iter()
            .map(|&k| facts.get(all[k].events[0].as_str()).map(|facts| FirstFrame::of(&facts.scene)))
            .collect();
        let stages: Vec<&[u32]> =
            frames.iter().map(|frame| frame.as_ref().map_or(&[][..], |frame| &frame.stage)).collect();
        let row = |(&k, frame): (&usize, &Option<FirstFrame>)| {
            let mut row = words(&all[k]);
            if let (Control::FirstFrame, Some(frame)) = (control, frame) {
                row.extend(
                    facts.get(all[k].events[0].as_str()).map(|it| asked(&all[k], it)).unwrap_or_default(),
                );
                row.extend([&frame.places[..], &frame.sizes, &frame.layout].concat());
            }
            row
        };
        let rows: Vec<Vec<f64>> = of.iter().zip(&frames).map(row).collect();
        for (&k, found) in of.iter().zip(cross_validated(&rows, &classes, &stages)) {
            let value = values.get(found as usize).copied().unwrap_or_default();
            guessed[k] = all[k].options.iter().position(|option| option.value == value).unwrap_or_default();
        }
    }
    guessed
}

/// The agent and the entity that a question names, and its moment (steps).
fn named(query: &Query) -> (Option<AgentId>, Option<Entity>, usize) {
    match *query {
        Query::Goal { agent, subject } => (Some(agent), Some(subject), 0),
        Query::EndRoom { entity } => (None, Some(entity), 0),
        Query::RoomAt { entity, step } | Query::Ahead { entity, step, .. } => (None, Some(entity), step),
        Query::FirstTouch { object } | Query::Carrier { object } => (None, Some(Entity::Object(object)), 0),
        Query::EntersFirst { agent } => (None, Some(Entity::Agent(agent)), 0),
        Query::Seen { agent, object, step }
        | Query::Believes { agent, object, step }
        | Query::Expects { agent, object, step }
        | Query::IsRight { agent, object, step }
        | Query::LooksNext { agent, object, step } => (Some(agent), Some(Entity::Object(object)), step),
        Query::Without { idle, .. } => (Some(idle), None, 0),
        _ => (None, None, 0),
    }
}

/// Features of the words alone: what is named, and which of the values 0 to 3 are options.
fn words(question: &Question) -> Vec<f64> {
    let (agent, entity, step) = named(&question.query);
    let entity = match entity {
        None => -1,
        Some(Entity::Agent(agent)) => agent.index() as i32,
        Some(Entity::Object(object)) => 2 + object.index() as i32,
    };
    let mut row = vec![agent.map_or(-1.0, |agent| agent.index() as f64), entity.into(), step as f64];
    row.extend((0..4).map(|value: usize| {
        let value = value.to_string();
        f64::from(u8::from(question.options.iter().any(|option| option.value == value)))
    }));
    row
}

/// Places of the named things in the first frame, the distances of both agents from them, and the side that
/// the named agent turns to the entity.
fn asked(question: &Question, facts: &Facts) -> Vec<f64> {
    let (agent, entity, _) = named(&question.query);
    let start = facts.scene.initial_state();
    let entity = entity.or((!facts.scene.objects.is_empty()).then_some(Entity::Object(ObjectId::ZERO)));
    let Some(entity) = entity else { return vec![0.0; 7] };
    let place = start.position(entity);
    let mut row = vec![f64::from(place.x), f64::from(place.y)];
    row.extend(AgentId::ALL.map(|it| f64::from(start.position(Entity::Agent(it)).distance(place))));
    row.push(row[2] - row[3]);
    let ahead = agent.map_or([0.0; 2], |agent| {
        let body = start.body(Entity::Agent(agent));
        let way = place - body.position;
        // The head of an agent of angle 0 points up.
        let turn =
            libm::atan2(way.y.into(), way.x.into()) - f64::from(body.angle) - core::f64::consts::FRAC_PI_2;
        [libm::cos(turn), libm::sin(turn)]
    });
    row.extend(ahead);
    row
}
