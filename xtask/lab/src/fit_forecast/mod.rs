//! `fit-forecast`: fits how SIMPLE combines simulated futures to events whose continuation is known.
//!
//! The likeliest hypotheses after the seconds watched are simulated once, from there and from earlier steps.
//! The inverse temperature of their weights, what they lose by the errors of their hindcasts, the least
//! weight, and the share of a learnt forecaster's future among them, even or weighed by the error of its own
//! hindcasts, are compared on a grid by the mean displacement error.

use crate::{
    error::LabError,
    fit_events::{FitEvents, KeptFigures},
    json_file,
};
use phase_cli::{
    context::Context,
    interrupt,
    output::{json_text, print_result},
};
use phase_eval::trajectories::{Errors, PREDICTED_STEPS, WATCHED_STEPS};
use phase_event::{Forecaster, MethodError, MethodResult, Prediction, ProgressCallback, Recording};
use phase_model::{Forecast, Vec2};
use phase_runs::{effort::MindChoice, error::RunError, eval::methods};
use phase_simple::{Continuation, ForecastSettings, Futures, Simple, continuations, hindcast_error};
use serde::{Deserialize, Serialize};

/// Inverse temperatures that are compared.
const INVERSE_TEMPERATURES: [f64; 3] = [0.6, 0.8, 1.0];
/// Losses by the errors of hindcasts that are compared (nat/u).
const HINDCAST_ERROR_RATES: [f64; 6] = [0.0, 0.5, 1.0, 1.5, 2.0, 3.0];
/// Least weights that are compared.
const LEAST_WEIGHTS: [f64; 4] = [0.0, 0.02, 0.05, 0.1];
/// Shares of the learnt forecaster that are compared.
const SHARES: [f64; 4] = [0.0, 0.1, 0.2, 0.3];
/// The learnt forecaster.
const LEARNT: &str = "social-lstm";

/// Combination of futures.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
struct Combination {
    #[serde(flatten)]
    settings: ForecastSettings,
    /// Share of the learnt forecaster's future.
    learnt: f64,
    /// Whether that share is weighed by the error of its hindcasts.
    weighed: bool,
}

/// The futures of one event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct KnownFutures {
    hypotheses: Vec<KnownHypothesis>,
    learnt: Places,
    learnt_hindcasts: Vec<f64>,
    truth: Places,
}

/// A hypothesis with its futures and the errors of its hindcasts.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct KnownHypothesis {
    weight: f64,
    futures: Vec<Places>,
    hindcasts: Vec<f64>,
}

/// Positions by entity and step (u).
type Places = Vec<Vec<[f32; 2]>>;

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitEvents, context: &Context) -> Result<(), LabError> {
    arguments.check_out([])?;
    let own = arguments.read_all(&arguments.events, context)?;
    let others = arguments.read_all(&arguments.held_out, context)?;
    interrupt::listen();
    let learnt = methods::forecaster(LEARNT, None, &MindChoice::default())?;
    let simple = Simple::bundled().map_err(RunError::from)?;
    let kept = KeptFigures::new("", arguments, context)?;
    let known = |recordings: &[Recording]| {
        let long: Vec<&Recording> =
            recordings.iter().filter(|it| it.trajectory.steps() > WATCHED_STEPS).collect();
        let ForecastSettings { hypotheses, repeats, .. } = ForecastSettings::default();
        let each = hypotheses * (1 + repeats);
        kept.of("simulating the futures", &long, each, |recording, tick| {
            let found = simulated(recording, &simple, &*learnt, arguments.seed, tick);
            found.map_err(|source| RunError::Method { id: recording.id.clone(), source })
        })
    };
    let own = known(&own)?;
    let others = known(&others)?;
    let mut ranked: Vec<(f64, Combination)> =
        combinations().into_iter().map(|it| (mean(&own, &it)[0], it)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = format!(
        "{:<34} {:>5} {:>8} {:>7} {:>8} {:>8} {:>8} {:>13} {:>13}\n",
        "", "1/T", "nat/u", "least", "learnt", "ADE", "FDE", "ADE held out", "FDE held out"
    );
    let mut line = |name: &str, combination: &Combination| {
        let [ade, fde] = mean(&own, combination);
        let [other_ade, other_fde] = mean(&others, combination);
        let Combination { settings, learnt, weighed } = combination;
        let learnt = format!("{learnt}{}", if *weighed { " w" } else { "" });
        let ForecastSettings { inverse_temperature, hindcast_error_rate, least_weight, .. } = settings;
        text += &format!(
            "{name:<34} {inverse_temperature:>5} {hindcast_error_rate:>8} {least_weight:>7} {learnt:>8} {ade:>8.3} {fde:>8.3} \
             {other_ade:>13.3} {other_fde:>13.3}\n"
        );
    };
    line("present", &Combination { settings: ForecastSettings::default(), learnt: 0.0, weighed: false });
    let best = |among: &dyn Fn(&Combination) -> bool| ranked.iter().map(|it| it.1).find(|it| among(it));
    for (name, found) in [
        ("fitted", best(&|_| true)),
        ("fitted, without the learnt", best(&|it| it.learnt == 0.0)),
        ("fitted, with the learnt weighed", best(&|it| it.learnt > 0.0 && it.weighed)),
        ("fitted, with the learnt even", best(&|it| it.learnt > 0.0 && !it.weighed)),
        ("fitted, without hindcasts", best(&|it| it.learnt == 0.0 && it.settings.hindcast_error_rate == 0.0)),
    ] {
        if let Some(found) = found {
            line(name, &found);
        }
    }
    line(
        "the learnt alone",
        &Combination { settings: ForecastSettings::default(), learnt: 1.0, weighed: false },
    );
    if let Some((_, fitted)) = ranked.first() {
        json_file::write(arguments.out.as_deref(), &json_text(fitted, "the settings")?)?;
    }
    print_result(text.trim_end())?;
    Ok(())
}

fn combinations() -> Vec<Combination> {
    let mut all = Vec::new();
    for inverse_temperature in INVERSE_TEMPERATURES {
        for hindcast_error_rate in HINDCAST_ERROR_RATES {
            for least_weight in LEAST_WEIGHTS {
                let settings = ForecastSettings {
                    inverse_temperature,
                    hindcast_error_rate,
                    least_weight,
                    ..ForecastSettings::default()
                };
                for learnt in SHARES {
                    all.push(Combination { settings, learnt, weighed: false });
                    if learnt > 0.0 && hindcast_error_rate > 0.0 {
                        all.push(Combination { settings, learnt, weighed: true });
                    }
                }
            }
        }
    }
    all
}

/// Mean ADE and FDE of a combination.
fn mean(events: &[KnownFutures], combination: &Combination) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for event in events {
        let errors = Errors::of(&event.combined(combination), &forecast_of(&event.truth));
        if let Ok([agents, _]) = errors {
            sums[0] += agents.ade;
            sums[1] += agents.fde;
        }
    }
    sums.map(|sum| sum / events.len().max(1) as f64)
}

impl KnownFutures {
    fn combined(&self, combination: &Combination) -> Forecast {
        let Combination { settings, learnt, weighed } = combination;
        if *learnt >= 1.0 {
            return forecast_of(&self.learnt);
        }
        let continuations: Vec<Continuation> =
            self.hypotheses.iter().map(KnownHypothesis::continuation).collect();
        let mut futures = Futures::of(&continuations, settings);
        if *learnt > 0.0 {
            let total: f64 = futures.paths.iter().map(|(_, weight)| weight).sum();
            let even = total * learnt / (1.0 - learnt);
            let weight = if *weighed { even * self.learnt_factor(&continuations, settings) } else { even };
            futures.paths.push((forecast_of(&self.learnt), weight));
        }
        futures.median()
    }

    /// Gain or loss of the learnt forecaster against the hypotheses by the error of its hindcasts.
    fn learnt_factor(&self, continuations: &[Continuation], settings: &ForecastSettings) -> f64 {
        let mean = |errors: &[f64]| phase_statistics::mean(errors).unwrap_or_default();
        let mut sum = 0.0;
        let mut total = 0.0;
        for continuation in continuations {
            let weight = libm::exp(continuation.log_weight(settings));
            sum += weight * mean(&continuation.hindcast_errors);
            total += weight;
        }
        libm::exp(settings.hindcast_error_rate * (sum / total - mean(&self.learnt_hindcasts)))
    }
}

impl KnownHypothesis {
    fn continuation(&self) -> Continuation {
        let futures = self.futures.iter().map(forecast_of).collect();
        Continuation { weight: self.weight, hindcast_errors: self.hindcasts.clone(), futures }
    }
}

fn forecast_of(places: &Places) -> Forecast {
    places.iter().map(|path| path.iter().map(|&place| Vec2::from_array(place)).collect()).collect()
}

fn places_of(forecast: &Forecast) -> Places {
    forecast.iter().map(|path| path.iter().map(|place| place.to_array()).collect()).collect()
}

fn simulated(
    recording: &Recording,
    simple: &Simple,
    learnt: &dyn Forecaster,
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<KnownFutures>, MethodError> {
    let whole = recording.observed().map_err(MethodError::new)?;
    let observed = whole.prefix(WATCHED_STEPS);
    let steps = (whole.steps() - WATCHED_STEPS).min(PREDICTED_STEPS);
    let prepared = simple.prepare(&observed, seed);
    let inference = simple.infer(&prepared, seed, tick).map_err(MethodError::new)?;
    let Some(inference) = inference else { return Ok(None) };
    // Every hypothesis is simulated further, whatever its weight.
    let settings = ForecastSettings { least_weight: 0.0, ..ForecastSettings::default() };
    let found =
        continuations(&prepared, &inference, steps, seed, &settings, tick).map_err(MethodError::new)?;
    let Some(found) = found else { return Ok(None) };
    let hypotheses = found.into_iter().map(|it| KnownHypothesis {
        weight: it.weight,
        futures: it.futures.iter().map(places_of).collect(),
        hindcasts: it.hindcast_errors,
    });
    let mut learnt_from = |start: usize, steps: usize| -> MethodResult<Forecast> {
        let found = learnt.forecast(&observed.prefix(start), steps, seed, tick)?;
        Ok(found.map(|(Prediction { forecast, .. }, details)| (forecast, details)))
    };
    let mut learnt_hindcasts = Vec::new();
    for start in settings.starts(WATCHED_STEPS) {
        let Some((hindcast, _)) = learnt_from(start, WATCHED_STEPS - start)? else { return Ok(None) };
        learnt_hindcasts.push(hindcast_error(&hindcast, &observed, start));
    }
    let Some((forecast, _)) = learnt_from(WATCHED_STEPS, steps)? else { return Ok(None) };
    let rows = || whole.rows().iter().skip(1 + WATCHED_STEPS).take(steps);
    let path = |entity: usize| rows().map(|row| row[entity].position.to_array()).collect();
    Ok(Some(KnownFutures {
        hypotheses: hypotheses.collect(),
        learnt: places_of(&forecast),
        learnt_hindcasts,
        truth: whole.entities().map(|entity| path(entity.index())).collect(),
    }))
}
