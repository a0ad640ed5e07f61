//! The answers of somebody else's method to Task 1, from a file.

use crate::goals::{Answer, canonical};
use phase_dataset::{FieldError, Problem, json::Field};
use phase_model::{AGENT_COUNT, Goal, Judgement, RelationProbabilities};
use serde_json::Value;
use std::collections::BTreeMap;

/// Reads predictions by the ids of their events: `{"events": [{"id", "goals": [[{"goal", "p"}…], […]], "relation":
/// {"friendly", "adversarial", "neutral"}}…]}`. Other members are left to whoever put them there, so results of
/// ours are predictions too.
///
/// # Errors
/// If there is no event, one comes twice, a field is missing or of the wrong type, or a number is no probability.
pub fn parse(value: &Value) -> Result<BTreeMap<String, Answer>, Problem> {
    let of_file = |problem| Problem::Field { event: None, problem };
    let events = Field::root(value).required("events").map_err(of_file)?;
    let mut answers = BTreeMap::new();
    for (k, event) in events.array().map_err(of_file)?.iter().enumerate() {
        let event = Field::root(event);
        let id = event.required("id").and_then(|id| id.text().map(ToOwned::to_owned));
        let name = || id.clone().unwrap_or_else(|_| format!("number {}", k + 1));
        let of_event = |problem| Problem::Field { event: Some(name()), problem };
        let id = id.clone().map_err(of_event)?;
        let judgement = judgement(&event).map_err(of_event)?;
        let rule = |error: crate::goals::AnswerError| Problem::Scene {
            event: id.clone(),
            rule: format!("field {error}"),
        };
        let answer = Answer::of(&judgement).map_err(rule)?;
        if answers.insert(id.clone(), answer).is_some() {
            return Err(Problem::DuplicateId(id));
        }
    }
    if answers.is_empty() { Err(Problem::NoEvents) } else { Ok(answers) }
}

fn judgement(event: &Field<'_>) -> Result<Judgement, FieldError> {
    let goals = event.required("goals")?;
    let lists = goals.items()?;
    if lists.len() != AGENT_COUNT {
        return Err(goals.error(format!("must hold {AGENT_COUNT} lists, not {}", lists.len())));
    }
    let lists = lists.map(|list| ranked(&list)).collect::<Result<Vec<_>, _>>()?;
    let relation = event.required("relation")?;
    relation.only(&["friendly", "adversarial", "neutral"])?;
    let p = |name| probability(&relation.required(name)?);
    let relation = RelationProbabilities {
        friendly: p("friendly")?,
        adversarial: p("adversarial")?,
        neutral: p("neutral")?,
    };
    let mut lists = lists.into_iter();
    Ok(Judgement { goals: core::array::from_fn(|_| lists.next().unwrap_or_default()), relation })
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
