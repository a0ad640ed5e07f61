//! The results of a check: rates, medians, and a table.

use super::{
    judge::Verdict,
    rows::{BehaviourTest, Criterion, PARTS},
};
use phase_evidence::GoalOutcome;
use phase_model::Flip;
use phase_statistics::{Interval, fisher_exact_greater, median, wilson_interval};
use serde_json::{Value, json};

/// The value of the field `format` of reports.
pub(super) const FORMAT: &str = "phase-behaviour/1";

/// One event and its judgement.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    /// The seed of the event.
    pub seed: u64,
    /// The reflection of the scene.
    pub flip: Option<Flip>,
    /// Length of the event (steps).
    pub steps: usize,
    /// The judgement.
    pub verdict: Verdict,
}

/// All events of one scene.
#[derive(Clone, Debug)]
pub(super) struct SceneResult {
    /// The part of the table it belongs to, an index into [`PARTS`].
    pub part: usize,
    /// The scene's id.
    pub id: String,
    /// Its events, by seed.
    pub trials: Vec<Trial>,
}

/// Rates and medians over some events.
#[derive(Clone, Debug)]
struct Rates {
    trials: usize,
    successes: usize,
    shown: Option<usize>,
    with: Reached,
    without: Option<Reached>,
}

/// Number of times that the judged goal was reached, and steps that it took.
#[derive(Clone, Debug)]
struct Reached {
    count: usize,
    median: Option<f64>,
}

impl Rates {
    fn of<'a>(trials: impl Iterator<Item = &'a Trial>) -> Self {
        let verdicts: Vec<&Verdict> = trials.map(|trial| &trial.verdict).collect();
        let shown: Option<Vec<bool>> = verdicts.iter().map(|verdict| verdict.shown).collect();
        let without: Option<Vec<GoalOutcome>> = verdicts.iter().map(|verdict| verdict.without).collect();
        Self {
            trials: verdicts.len(),
            successes: verdicts.iter().filter(|verdict| verdict.success).count(),
            shown: shown.map(|shown| shown.into_iter().filter(|&shown| shown).count()),
            with: Reached::of(verdicts.iter().map(|verdict| verdict.with)),
            without: without.map(|without| Reached::of(without.into_iter())),
        }
    }

    fn to_json(&self) -> Value {
        let Interval { low, high } = wilson_interval(self.successes, self.trials);
        let reached = |it: &Reached| json!({ "reached": it.count, "median_steps": it.median });
        json!({
            "events": self.trials, "successes": self.successes, "wilson_95": [low, high], "shown": self.shown,
            "with": reached(&self.with), "without": self.without.as_ref().map(reached),
        })
    }

    /// Columns of the table.
    fn cells(&self) -> String {
        let Interval { low, high } = wilson_interval(self.successes, self.trials);
        let rate = format!("{}/{}", self.successes, self.trials);
        let interval = format!("{:.0}-{:.0} %", 100.0 * low, 100.0 * high);
        let shown = self.shown.map_or_else(|| "-".into(), |shown| format!("{shown}/{}", self.trials));
        let reached = |it: &Reached| {
            let median = it.median.map_or_else(|| "-".into(), |steps| format!("{steps:.1}"));
            format!("{}/{} {median:>5}", it.count, self.trials)
        };
        let without = self.without.as_ref().map_or_else(|| "-".into(), reached);
        format!("{rate:>7} {interval:>10} {shown:>7} {:>13} {without:>13}", reached(&self.with))
    }
}

impl Reached {
    fn of(outcomes: impl Iterator<Item = GoalOutcome>) -> Self {
        let reached: Vec<GoalOutcome> = outcomes.filter(|outcome| outcome.reached).collect();
        let steps: Vec<usize> = reached.iter().filter_map(|outcome| outcome.steps).collect();
        Self { count: reached.len(), median: median(&steps) }
    }
}

/// The whole report as JSON; `run` describes how it was made.
#[must_use]
pub(super) fn to_json(run: &Value, scenes: &[SceneResult]) -> Value {
    let row = |(index, part): (usize, &BehaviourTest)| {
        let own: Vec<&SceneResult> = scenes.iter().filter(|scene| scene.part == index).collect();
        (!own.is_empty()).then(|| {
            json!({
                "row": part.row, "name": part.name, "title": part.title,
                "success": part.criterion.description(), "lambda": part.lambda,
                "result": Rates::of(trials(&own)).to_json(),
                "scenes": own.iter().map(|scene| scene_value(scene)).collect::<Vec<_>>(),
            })
        })
    };
    let rows: Vec<Value> = PARTS.iter().enumerate().filter_map(row).collect();
    json!({ "format": FORMAT, "run": run, "rows": rows, "search_p": search_p(scenes) })
}

/// The report as a table for people.
#[must_use]
pub(super) fn table(scenes: &[SceneResult]) -> String {
    let mut text = format!(
        "{:<54} {:>7} {:>10} {:>7} {:>13} {:>13}\n",
        "row, scene", "success", "95 %", "shown", "goal, median", "without"
    );
    for (index, part) in PARTS.iter().enumerate() {
        let own: Vec<&SceneResult> = scenes.iter().filter(|scene| scene.part == index).collect();
        if own.is_empty() {
            continue;
        }
        let title = format!("{} {}", part.name.split('-').next().unwrap_or_default(), part.title);
        text += &format!("{title:<54} {}\n", Rates::of(trials(&own)).cells());
        for scene in own {
            let name = format!("    {}", scene.id);
            text += &format!("{name:<54} {}\n", Rates::of(scene.trials.iter()).cells());
        }
    }
    for scene in scenes {
        let failures: Vec<&Trial> = scene.trials.iter().filter(|trial| !trial.verdict.success).collect();
        if let Some(first) = failures.first() {
            let part = PARTS[scene.part].name;
            let id = &scene.id;
            let count = failures.len();
            let seed = first.seed;
            let notes = &first.verdict.notes;
            text += &format!("{part} {id} failed {count} times, first with seed {seed}: {notes}\n");
        }
    }
    if let Some(p) = search_p(scenes) {
        text += &format!("lambda decides where is searched first: p = {p:.2e} (Fisher, one-sided)\n");
    }
    text
}

fn trials<'a>(scenes: &[&'a SceneResult]) -> impl Iterator<Item = &'a Trial> {
    scenes.iter().flat_map(|scene| &scene.trials).collect::<Vec<_>>().into_iter()
}

fn scene_value(scene: &SceneResult) -> Value {
    let outcome = |outcome: GoalOutcome| json!({ "reached": outcome.reached, "steps": outcome.steps });
    let events: Vec<Value> = scene
        .trials
        .iter()
        .map(|Trial { seed, flip, steps, verdict }| {
            json!({
                "seed": seed, "flip": flip.map(u8::from), "steps": steps, "success": verdict.success,
                "shown": verdict.shown, "with": outcome(verdict.with),
                "without": verdict.without.map(outcome), "notes": verdict.notes,
            })
        })
        .collect();
    json!({ "id": scene.id, "result": Rates::of(scene.trials.iter()).to_json(), "events": events })
}

/// Probability that the near region is searched first more often at the usual λ by at least the observed
/// difference, if λ made no difference. `None` unless both were simulated.
fn search_p(scenes: &[SceneResult]) -> Option<f64> {
    let searches = |wanted: usize| {
        let own = scenes.iter().filter(|it| PARTS[it.part].criterion == Criterion::SearchFirst(wanted));
        let own: Vec<&SceneResult> = own.collect();
        (!own.is_empty()).then(|| Rates::of(trials(&own)))
    };
    let near = searches(0)?;
    let larger = searches(1)?;
    Some(fisher_exact_greater(
        (near.successes, near.trials),
        (larger.trials - larger.successes, larger.trials),
    ))
}
