//! Results for programs: the members that every evaluation of PHASE has, and ours beside them.

use crate::{
    Estimate,
    goals::{self, RecognisedEvent},
    trajectories::{self, ForecastEvent},
};
use serde::Serialize;
use serde_json::{Value, json};

/// The value of the field `format` of results of Task 1.
pub const GOALS_FORMAT: &str = "phase-eval-goals/1";
/// The value of the field `format` of results of Task 2.
pub const TRAJECTORIES_FORMAT: &str = "phase-eval-trajectories/1";

/// Results of Task 1. `run` is what was run, with its `method` and `seed`.
#[must_use]
pub fn goals(run: &Value, summary: &goals::Summary, events: &[RecognisedEvent]) -> Value {
    let all = &summary.all;
    let human = all.relation_human;
    json!({
        "format": GOALS_FORMAT, "run": run, "method": run["method"], "seed": run["seed"],
        "n_events": all.n,
        "goal": { "top1": all.top1.value, "top2": all.top2.value, "top3": all.top3.value },
        "relation": {
            "accuracy": all.relation.value, "human_accuracy": human.map(|estimate| estimate.value),
        },
        "cpu_seconds_per_event": summary.cpu_seconds_per_event,
        "intervals": {
            "goal": {
                "top1": all.top1.interval(), "top2": all.top2.interval(), "top3": all.top3.interval(),
            },
            "relation": {
                "accuracy": all.relation.interval(),
                "human_accuracy": human.map(|estimate| estimate.interval()),
            },
        },
        "kinds": plain(&summary.kinds), "layouts": plain(&summary.layouts), "watched": plain(&summary.watched),
        "confusion": { "order": plain(&goals::RELATIONS), "right_by_said": summary.confusion },
        "calibration": {
            "goal": plain(&summary.goal_calibration), "relation": plain(&summary.relation_calibration),
        },
        "events": plain(&events),
    })
}

/// Results of Task 2. `run` is what was run, with its `method` and `seed`.
#[must_use]
pub fn trajectories(run: &Value, summary: &trajectories::Summary, events: &[ForecastEvent]) -> Value {
    let (independent, social) = (summary.independent.as_ref(), summary.social.as_ref());
    let parts = |of: fn(&trajectories::Scores) -> Estimate| {
        let (independent, social) = (independent.map(of), social.map(of));
        let all = of(&summary.all);
        let (value, interval) = (|it: Estimate| it.value, |it: Estimate| it.interval());
        [
            json!({ "independent": independent.map(value), "social": social.map(value), "all": all.value }),
            json!({
                "independent": independent.map(interval), "social": social.map(interval),
                "all": all.interval(),
            }),
        ]
    };
    let ([ade, ade_interval], [fde, fde_interval]) = (parts(|it| it.ade), parts(|it| it.fde));
    let ([ade_entities, ade_entities_interval], [fde_entities, fde_entities_interval]) =
        (parts(|it| it.ade_entities), parts(|it| it.fde_entities));
    json!({
        "format": TRAJECTORIES_FORMAT, "run": run, "method": run["method"], "seed": run["seed"],
        "n_events": summary.all.n, "ade": ade, "fde": fde,
        "ade_entities": ade_entities, "fde_entities": fde_entities,
        "intervals": {
            "ade": ade_interval, "fde": fde_interval,
            "ade_entities": ade_entities_interval, "fde_entities": fde_entities_interval,
        },
        "cpu_seconds_per_event": summary.cpu_seconds_per_event,
        "watched_steps": trajectories::WATCHED_STEPS, "predicted_steps": trajectories::PREDICTED_STEPS,
        "shorter": summary.shorter, "by_step": summary.by_step, "kinds": plain(&summary.kinds),
        "events": plain(&events),
    })
}

/// Plain data of ours, which always has a JSON form.
fn plain(data: &impl Serialize) -> Value {
    serde_json::to_value(data).unwrap_or_default()
}
