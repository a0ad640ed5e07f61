//! Predictions of an external method for either task, from a file.

use crate::{
    goals::{Answer, canonical},
    trajectories::{PREDICTED_STEPS, WATCHED_STEPS},
};
use phase_event::{EventReadError, Prediction};
use phase_model::{
    AGENT_COUNT, Forecast, Goal, Judgement, RelationProbabilities, RoleProbabilities, Vec2,
    json::{Field, FieldError, finite},
};
use serde_json::Value;
use std::collections::BTreeMap;

/// Most futures that a prediction may have; their distances are compared in pairs.
pub const MAX_FUTURES: usize = 200;

/// The members of an event: those of predictions for either task, and those of results.
const OF_EVENT: [&str; 19] = [
    "id",
    "not_judged",
    "goals",
    "relation",
    "roles",
    "reported",
    "strengths",
    "forecast",
    "futures",
    "watched_steps",
    "label",
    "watched",
    "cpu_seconds",
    "details",
    "kind",
    "steps",
    "agents",
    "entities",
    "samples",
];
/// The members of a file: those of predictions, and those of results of either task.
const OF_FILE: [&str; 28] = [
    "events",
    "method",
    "watched_steps",
    "predicted_steps",
    "format",
    "run",
    "seed",
    "n_events",
    "intervals",
    "kinds",
    "goal",
    "relation",
    "layouts",
    "watched",
    "sets",
    "roles",
    "role_kinds",
    "agreement",
    "relation_agreement",
    "confusion",
    "calibration",
    "ade",
    "fde",
    "ade_entities",
    "fde_entities",
    "samples",
    "shorter",
    "by_step",
];

/// Reads answers to Task 1 by the ids of their events:
/// `{"events": [{"id", "goals": [[{"goal", "p"}…], […]],`
/// `"relation": {"friendly", "adversarial", "neutral"}, "roles": {"helps": [p, p], "hinders": [p, p]}}…]}`,
/// where `roles`, the probabilities that either agent helps or hinders the other, may be absent, and so may
/// `reported`, the shares of people who would report each relation, of the form of `relation`. The members of
/// results are known too, so results of PHASE are valid predictions; names that begin with `_` are free.
///
/// # Errors
/// If there is no event, one occurs twice, a field is missing, unknown or of the wrong type, or a probability
/// is invalid.
pub fn goals(value: &Value) -> Result<BTreeMap<String, Answer>, EventReadError> {
    by_id(value, |event, id| {
        let judgement = judgement(event).map_err(|problem| of_event(id, problem))?;
        Answer::of(&judgement).map_err(|error| {
            of_event(id, FieldError { field: String::new(), rule: format!("field {error}") })
        })
    })
}

/// Reads answers to Task 2 by the ids of their events:
/// `{"events": [{"id", "forecast": [[[x, y], …steps] …entities], "futures": [forecast…]}…]}`, positions in u,
/// where `futures`, equally likely ones, may be absent. The file or an event may say after how many steps
/// the forecasts were made, `watched_steps`, and the file for how many, `predicted_steps`. The members of
/// results are known too, so results of PHASE are valid predictions; names that begin with `_` are free.
/// Whether a forecast has the shape of its event is checked by [`fit`].
///
/// # Errors
/// If there is no event, one occurs twice, a field is missing, unknown or of the wrong type, a number is not
/// finite, or the forecasts are of other steps than those that are scored.
pub fn forecasts(value: &Value) -> Result<BTreeMap<String, Prediction>, EventReadError> {
    let file = Field::root(value);
    scored_steps(&file, "watched_steps", WATCHED_STEPS)
        .and_then(|()| scored_steps(&file, "predicted_steps", PREDICTED_STEPS))
        .map_err(|problem| EventReadError::Field { event: None, problem })?;
    by_id(value, |event, id| prediction(event).map_err(|problem| of_event(id, problem)))
}

/// Checks a number of steps of a forecast, if it is told.
fn scored_steps(field: &Field<'_>, key: &str, scored: usize) -> Result<(), FieldError> {
    match field.optional(key)? {
        Some(told) if told.value().as_u64() != Some(scored as u64) => {
            Err(told.must_be(&format!("{scored}, as in the forecasts that are scored")))
        }
        _ => Ok(()),
    }
}

/// The parts of a prediction for an event; see [`fit`].
///
/// # Errors
/// The rules of [`fit`], and for more than [`MAX_FUTURES`] futures.
pub fn fit_prediction(
    prediction: &Prediction,
    entities: usize,
    steps: usize,
) -> Result<Prediction, FieldError> {
    if prediction.samples.len() > MAX_FUTURES {
        let rule = format!("must hold at most {MAX_FUTURES} futures, not {}", prediction.samples.len());
        return Err(FieldError { field: "futures".into(), rule });
    }
    let future = |(k, future): (usize, &Forecast)| {
        fit(future, entities, steps).map_err(|FieldError { field, rule }| {
            let field = field.replacen("forecast", &format!("futures[{k}]"), 1);
            FieldError { field, rule }
        })
    };
    Ok(Prediction {
        forecast: fit(&prediction.forecast, entities, steps)?,
        samples: prediction.samples.iter().enumerate().map(future).collect::<Result<_, _>>()?,
    })
}

/// The part of a forecast for an event with the given number of entities and steps to predict, at most
/// [`PREDICTED_STEPS`]. It may extend beyond the event's end, up to that many, since a method need not know
/// how long an event is; the excess is dropped. Longer forecasts would be positions of something else, such
/// as the whole event.
///
/// # Errors
/// If there are more or fewer entities, or some entity has too few or too many positions.
pub fn fit(forecast: &Forecast, entities: usize, steps: usize) -> Result<Forecast, FieldError> {
    let field = "forecast".to_owned();
    if forecast.len() != entities {
        let rule = format!(
            "must hold {entities} lists, one for each agent and then for each object, not {}",
            forecast.len()
        );
        return Err(FieldError { field, rule });
    }
    let wanted = steps..=PREDICTED_STEPS;
    if let Some(entity) = forecast.iter().position(|path| !wanted.contains(&path.len())) {
        let found = forecast.get(entity).map_or(0, Vec::len);
        let rule = if steps == PREDICTED_STEPS {
            format!("must hold {steps} positions, not {found}")
        } else {
            format!("must hold {steps} to {PREDICTED_STEPS} positions, not {found}")
        };
        return Err(FieldError { field: format!("{field}[{entity}]"), rule });
    }
    Ok(forecast.iter().map(|path| path.iter().take(steps).copied().collect()).collect())
}

/// Reads the events of a file, each of them with `read`, which is told its id.
fn by_id<A>(
    value: &Value,
    read: impl Fn(&Field<'_>, &str) -> Result<A, EventReadError>,
) -> Result<BTreeMap<String, A>, EventReadError> {
    let of_file = |problem| EventReadError::Field { event: None, problem };
    let file = Field::root(value);
    let events = file.only(&OF_FILE).and_then(|()| file.required("events")).map_err(of_file)?;
    let mut answers = BTreeMap::new();
    for (k, event) in events.array().map_err(of_file)?.iter().enumerate() {
        let event = Field::root(event);
        let id = event.required("id").and_then(|id| id.text());
        let id = id.map_err(|problem| of_event(&format!("number {}", k + 1), problem))?;
        event.only(&OF_EVENT).map_err(|problem| of_event(id, problem))?;
        if answers.insert(id.to_owned(), read(&event, id)?).is_some() {
            return Err(EventReadError::DuplicateId(id.into()));
        }
    }
    if answers.is_empty() { Err(EventReadError::NoEvents) } else { Ok(answers) }
}

fn of_event(id: &str, problem: FieldError) -> EventReadError {
    EventReadError::Field { event: Some(id.into()), problem }
}

fn prediction(event: &Field<'_>) -> Result<Prediction, FieldError> {
    scored_steps(event, "watched_steps", WATCHED_STEPS)?;
    let samples = event.optional("futures")?.map_or_else(
        || Ok(Vec::new()),
        |futures| {
            futures.items()?.map(|future| forecast(&future)).collect::<Result<Vec<Forecast>, FieldError>>()
        },
    )?;
    Ok(Prediction { forecast: forecast(&event.required("forecast")?)?, samples })
}

fn forecast(paths: &Field<'_>) -> Result<Forecast, FieldError> {
    paths.items()?.map(|path| path.items()?.map(|at| position(&at)).collect()).collect()
}

fn position(field: &Field<'_>) -> Result<Vec2, FieldError> {
    let numbers = field.array()?;
    let [x, y] = numbers.as_slice() else { return Err(field.must_be("[x, y]")) };
    match (finite(x), finite(y)) {
        (Some(x), Some(y)) => Ok(Vec2::new(x, y)),
        _ => Err(field.must_be("two finite numbers")),
    }
}

fn judgement(event: &Field<'_>) -> Result<Judgement, FieldError> {
    let goals = event.required("goals")?;
    let lists = goals.items()?;
    if lists.len() != AGENT_COUNT {
        return Err(goals.error(format!("must hold {AGENT_COUNT} lists, not {}", lists.len())));
    }
    let lists = lists.map(|list| ranked(&list)).collect::<Result<Vec<_>, _>>()?;
    let relation = relation_probabilities(&event.required("relation")?)?;
    let reported = event.optional("reported")?.map(|it| relation_probabilities(&it)).transpose()?;
    let roles = event.optional("roles")?.map(|roles| role_probabilities(&roles)).transpose()?;
    let mut lists = lists.into_iter();
    let goals = core::array::from_fn(|_| lists.next().unwrap_or_default());
    Ok(Judgement { goals, relation, roles, reported })
}

fn relation_probabilities(relation: &Field<'_>) -> Result<RelationProbabilities, FieldError> {
    relation.only(&["friendly", "adversarial", "neutral"])?;
    let p = |name| probability(&relation.required(name)?);
    Ok(RelationProbabilities {
        friendly: p("friendly")?,
        adversarial: p("adversarial")?,
        neutral: p("neutral")?,
    })
}

fn role_probabilities(roles: &Field<'_>) -> Result<RoleProbabilities, FieldError> {
    roles.only(&["helps", "hinders"])?;
    let both = |name| {
        let field = roles.required(name)?;
        let numbers = field.items()?.map(|number| probability(&number)).collect::<Result<Vec<_>, _>>()?;
        <[f64; AGENT_COUNT]>::try_from(numbers)
            .map_err(|numbers| field.error(format!("must hold {AGENT_COUNT} numbers, not {}", numbers.len())))
    };
    Ok(RoleProbabilities { helps: both("helps")?, hinders: both("hinders")? })
}

fn ranked(list: &Field<'_>) -> Result<Vec<(Goal, f64)>, FieldError> {
    let mut goals: Vec<(Goal, f64)> = Vec::new();
    for share in list.items()? {
        share.only(&["goal", "p"])?;
        let field = share.required("goal")?;
        let goal: Goal = serde_json::from_value(field.value().clone())
            .map_err(|error| field.error(format!("is no goal: {error}")))?;
        if goals.iter().any(|(other, _)| canonical(*other) == canonical(goal)) {
            return Err(field.error("comes twice in its list"));
        }
        goals.push((goal, probability(&share.required("p")?)?));
    }
    Ok(goals)
}

fn probability(field: &Field<'_>) -> Result<f64, FieldError> {
    let number = field.value().as_f64().filter(|number| (0.0..=1.0).contains(number));
    number.ok_or_else(|| field.must_be("a number from 0 to 1"))
}
