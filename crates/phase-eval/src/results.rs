//! Results for programs: the members common to all PHASE evaluations, with additional ones.

use crate::{
    Estimate,
    beliefs::{BeliefEvent, BeliefSummary},
    goals::{self, RecognisedEvent},
    intents::{IntentEvent, IntentSummary},
    trajectories::{self, ForecastEvent},
};
use serde_json::{Value, json, to_value};

/// The value of the field `format` of results of Task 1.
pub const GOALS_FORMAT: &str = "phase-eval-goals/1";
/// The value of the field `format` of results of Task 2.
pub const TRAJECTORIES_FORMAT: &str = "phase-eval-trajectories/1";

/// The value of the field `format` of results about beliefs.
pub const BELIEFS_FORMAT: &str = "phase-eval-beliefs/1";

/// Results about beliefs. `run` describes the run, with its `method` and `seed`.
///
/// # Errors
/// If a part of them cannot be written as JSON.
pub fn beliefs(run: &Value, summary: &BeliefSummary, events: &[BeliefEvent]) -> serde_json::Result<Value> {
    Ok(json!({
        "format": BELIEFS_FORMAT, "run": run, "method": run["method"], "seed": run["seed"],
        "n_events": summary.n,
        "all": to_value(&summary.all)?, "unseen": to_value(&summary.unseen)?,
        "moved": to_value(&summary.moved)?,
        "events": to_value(events)?,
    }))
}

/// The value of the field `format` of results about believed intents.
pub const INTENTS_FORMAT: &str = "phase-eval-intents/1";

/// Results about believed intents. `run` describes the run, with its `method` and `seed`.
///
/// # Errors
/// If a part of them cannot be written as JSON.
pub fn intents(run: &Value, summary: &IntentSummary, events: &[IntentEvent]) -> serde_json::Result<Value> {
    Ok(json!({
        "format": INTENTS_FORMAT, "run": run, "method": run["method"], "seed": run["seed"],
        "n_events": summary.n,
        "all": to_value(&summary.all)?, "mistaken": to_value(&summary.mistaken)?,
        "by_step": to_value(&summary.by_step)?,
        "events": to_value(events)?,
    }))
}

/// Results of Task 1. `run` describes the run, with its `method` and `seed`.
///
/// # Errors
/// If a part of them cannot be written as JSON.
pub fn goals(
    run: &Value,
    summary: &goals::RecognitionSummary,
    events: &[RecognisedEvent],
) -> serde_json::Result<Value> {
    let all = &summary.all;
    let human = all.relation_human;
    Ok(json!({
        "format": GOALS_FORMAT, "run": run, "method": run["method"], "seed": run["seed"],
        "n_events": all.n,
        "goal": { "top1": all.top1.value, "top2": all.top2.value, "top3": all.top3.value },
        "relation": {
            "accuracy": all.relation.value, "human_accuracy": human.map(|estimate| estimate.value),
        },
        "intervals": {
            "goal": {
                "top1": all.top1.interval(), "top2": all.top2.interval(), "top3": all.top3.interval(),
            },
            "relation": {
                "accuracy": all.relation.interval(),
                "human_accuracy": human.map(|estimate| estimate.interval()),
            },
        },
        "kinds": to_value(&summary.kinds)?, "layouts": to_value(&summary.layouts)?,
        "watched": to_value(&summary.watched)?,
        "sets": to_value(&summary.sets)?,
        "roles": to_value(&summary.roles)?, "role_kinds": to_value(&summary.role_kinds)?,
        "agreement": to_value(&summary.agreement)?,
        "relation_agreement": to_value(&summary.relation_agreement)?,
        "confusion": { "order": to_value(goals::RELATIONS)?, "right_by_said": summary.confusion },
        "calibration": {
            "goal": to_value(&summary.goal_calibration)?,
            "relation": to_value(&summary.relation_calibration)?,
        },
        "events": to_value(events)?,
    }))
}

/// Results of Task 2. `run` describes the run, with its `method` and `seed`.
///
/// # Errors
/// If a part of them cannot be written as JSON.
pub fn trajectories(
    run: &Value,
    summary: &trajectories::ForecastSummary,
    events: &[ForecastEvent],
) -> serde_json::Result<Value> {
    let independent = summary.independent.as_ref();
    let social = summary.social.as_ref();
    let parts = |of: fn(&trajectories::ForecastScores) -> Estimate| {
        let independent = independent.map(of);
        let social = social.map(of);
        let all = of(&summary.all);
        let value = |it: Estimate| it.value;
        let interval = |it: Estimate| it.interval();
        [
            json!({ "independent": independent.map(value), "social": social.map(value), "all": all.value }),
            json!({
                "independent": independent.map(interval), "social": social.map(interval),
                "all": all.interval(),
            }),
        ]
    };
    let [ade, ade_interval] = parts(|it| it.ade);
    let [fde, fde_interval] = parts(|it| it.fde);
    let [ade_entities, ade_entities_interval] = parts(|it| it.ade_entities);
    let [fde_entities, fde_entities_interval] = parts(|it| it.fde_entities);
    Ok(json!({
        "format": TRAJECTORIES_FORMAT, "run": run, "method": run["method"], "seed": run["seed"],
        "n_events": summary.all.n, "ade": ade, "fde": fde,
        "ade_entities": ade_entities, "fde_entities": fde_entities,
        "samples": to_value(&summary.all.samples)?,
        "intervals": {
            "ade": ade_interval, "fde": fde_interval,
            "ade_entities": ade_entities_interval, "fde_entities": fde_entities_interval,
        },
        "watched_steps": trajectories::WATCHED_STEPS, "predicted_steps": trajectories::PREDICTED_STEPS,
        "shorter": summary.shorter, "by_step": summary.by_step, "kinds": to_value(&summary.kinds)?,
        "events": to_value(events)?,
    }))
}
