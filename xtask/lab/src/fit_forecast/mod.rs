//! `fit-forecast`: fits how SIMPLE combines simulated futures to events whose continuation is known.
//!
//! The likeliest hypotheses after the seconds watched are simulated once, from there and from earlier steps.
//! The inverse temperature of their weights, what they lose by the errors of their hindcasts, and the least
//! weight are compared on a grid by the mean displacement error.

use crate::{
    error::LabError,
    fit_events::{FitEvents, KeptFigures},
};
use phase_cli::{context::Context, interrupt, output::print_result};
use phase_eval::trajectories::{Errors, PREDICTED_STEPS, WATCHED_STEPS};
use phase_event::{MethodError, ObservedEvent, ProgressCallback, Recording};
use phase_model::{Forecast, Vec2};
use phase_runs::error::RunError;
use phase_simple::{Continuation, ForecastSettings, Futures, Simple, continuations};
use serde::{Deserialize, Serialize};

/// Inverse temperatures that are compared.
const INVERSE_TEMPERATURES: [f64; 3] = [0.6, 0.8, 1.0];
/// Losses by the errors of hindcasts that are compared (nat/u).
const HINDCAST_ERROR_RATES: [f64; 6] = [0.0, 0.5, 1.0, 1.5, 2.0, 3.0];
/// Least weights that are compared.
const LEAST_WEIGHTS: [f64; 4] = [0.0, 0.02, 0.05, 0.1];

/// The futures of one event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct KnownFutures {
    hypotheses: Vec<KnownHypothesis>,
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
    let simple = Simple::bundled().map_err(RunError::from)?;
    let kept = KeptFigures::new("", arguments, context)?;
    let known = |recordings: &[Recording]| {
        let long: Vec<&Recording> =
            recordings.iter().filter(|it| it.trajectory.steps() > WATCHED_STEPS).collect();
        let ForecastSettings { hypotheses, repeats, .. } = ForecastSettings::default();
        let each = hypotheses * (1 + repeats);
        kept.of("simulating the futures", &long, each, |recording, tick| {
            let found = simulated(recording, &simple, arguments.seed, tick);
            found.map_err(|source| RunError::Method { id: recording.id.clone(), source })
        })
    };
    let own = known(&own)?;
    let others = known(&others)?;
    let mut ranked: Vec<(f64, ForecastSettings)> =
        combinations().into_iter().map(|it| (mean(&own, &it)[0], it)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = format!(
        "{:<26} {:>5} {:>8} {:>7} {:>8} {:>8} {:>13} {:>13}\n",
        "", "1/T", "nat/u", "least", "ADE", "FDE", "ADE held out", "FDE held out"
    );
    let mut line = |name: &str, settings: &ForecastSettings| {
        let [ade, fde] = mean(&own, settings);
        let [other_ade, other_fde] = mean(&others, settings);
        let ForecastSettings { inverse_temperature, hindcast_error_rate, least_weight, .. } = settings;
        text += &format!(
            "{name:<26} {inverse_temperature:>5} {hindcast_error_rate:>8} {least_weight:>7} {ade:>8.3} {fde:>8.3} \
             {other_ade:>13.3} {other_fde:>13.3}\n"
        );
    };
    line("present", &ForecastSettings::default());
    if let Some((_, fitted)) = ranked.first() {
        line("fitted", fitted);
        arguments.write(fitted)?;
    }
    if let Some((_, blind)) = ranked.iter().find(|(_, it)| it.hindcast_error_rate == 0.0) {
        line("fitted, without hindcasts", blind);
    }
    print_result(text.trim_end())?;
    Ok(())
}

fn combinations() -> Vec<ForecastSettings> {
    let mut all = Vec::new();
    for inverse_temperature in INVERSE_TEMPERATURES {
        for hindcast_error_rate in HINDCAST_ERROR_RATES {
            all.extend(LEAST_WEIGHTS.map(|least_weight| ForecastSettings {
                inverse_temperature,
                hindcast_error_rate,
                least_weight,
                ..ForecastSettings::default()
            }));
        }
    }
    all
}

/// Mean ADE and FDE with some settings.
fn mean(events: &[KnownFutures], settings: &ForecastSettings) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for event in events {
        let continuations: Vec<Continuation> =
            event.hypotheses.iter().map(KnownHypothesis::continuation).collect();
        let forecast = Futures::of(&continuations, settings).median();
        if let Ok([agents, _]) = Errors::of(&forecast, &forecast_of(&event.truth)) {
            sums[0] += agents.ade;
            sums[1] += agents.fde;
        }
    }
    sums.map(|sum| sum / events.len().max(1) as f64)
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
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<KnownFutures>, MethodError> {
    let (observed, truth) = watched_and_rest(recording)?;
    let steps = truth.first().map_or(0, Vec::len);
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
    Ok(Some(KnownFutures { hypotheses: hypotheses.collect(), truth: places_of(&truth) }))
}

/// The part of an event that is watched, and where its entities are in the steps that are forecast.
pub(crate) fn watched_and_rest(recording: &Recording) -> Result<(ObservedEvent, Forecast), MethodError> {
    let whole = recording.observed().map_err(MethodError::new)?;
    let rows = || whole.rows().iter().skip(1 + WATCHED_STEPS).take(PREDICTED_STEPS);
    let path = |entity: usize| rows().map(|row| row[entity].position).collect();
    let rest = whole.entities().map(|entity| path(entity.index())).collect();
    Ok((whole.prefix(WATCHED_STEPS), rest))
}
