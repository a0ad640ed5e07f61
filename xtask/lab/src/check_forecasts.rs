//! `check-forecasts`: how much of SIMPLE's error in forecasts is inference, how much the minds, and how much
//! chance.
//!
//! SIMPLE, which infers goals, attitudes and strengths, is compared with forecasts that are told them. What
//! SIMPLE loses against these is the price of inference. One of the told futures is then forecast by the
//! others, as if it were the event: what remains is chance, which no forecaster can know in advance. The rest
//! is what the minds do otherwise than those of the events.
//!
//! SIMPLE's own futures are forecast by one another, too. That is the error that SIMPLE expects: if its
//! probabilities are right, the error that it makes is no greater on average.

use crate::{
    error::LabError,
    fit_events::{FitEvents, KeptFigures},
    fit_forecast::watched_and_rest,
};
use phase_cli::{context::Context, interrupt, output::print_result};
use phase_eval::{
    Estimate,
    trajectories::{Errors, WATCHED_STEPS},
};
use phase_event::{MethodError, ProgressCallback, Recording};
use phase_model::{
    AgentId, Forecast,
    random::{Purpose, derive_seed},
};
use phase_runs::error::RunError;
use phase_simple::{ForecastSettings, Futures, Hypothesis, PreparedEvent, Simple, futures};
use serde::{Deserialize, Serialize};

/// Futures of a kind of minds that are told goals, attitudes and strengths.
const TOLD: usize = 12;
/// A kind of minds that is less probable, given the motion watched, is not simulated.
const LEAST_PROBABILITY: f64 = 0.1;

/// Errors (ADE and FDE, u) of the forecasts of one event, in the order of [`ROWS`].
type EventErrors = [[f64; 2]; ROWS.len()];

/// The forecasts that are compared.
const ROWS: [&str; 5] =
    ["simple", "told", "told, one future", "told, of its own future", "simple, of its own future"];

/// Errors of one event, kept in a file.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Found {
    errors: EventErrors,
}

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitEvents, context: &Context) -> Result<(), LabError> {
    arguments.check_out([])?;
    arguments.check_nothing_held_out()?;
    let recordings = arguments.read_all(&arguments.events, context)?;
    interrupt::listen();
    let simple = Simple::bundled().map_err(RunError::from)?;
    let kept = KeptFigures::new("", arguments, context)?;
    let long: Vec<&Recording> =
        recordings.iter().filter(|it| it.trajectory.steps() > WATCHED_STEPS).collect();
    let ForecastSettings { hypotheses, repeats, .. } = ForecastSettings::default();
    let found = kept.of("forecasting", &long, hypotheses * (1 + repeats) + TOLD, |recording, tick| {
        let errors = errors(recording, &simple, arguments.seed, tick);
        errors.map_err(|source| RunError::Method { id: recording.id.clone(), source })
    })?;
    let found: Vec<EventErrors> = found.into_iter().map(|Found { errors }| errors).collect();
    arguments.write(&found)?;
    print_result(table(&found, arguments.seed))?;
    Ok(())
}

/// The errors of each forecast, and the parts of SIMPLE's.
fn table(found: &[EventErrors], seed: u64) -> String {
    let cell = |values: Vec<f64>| {
        Estimate::of(&values, seed).map_or_else(
            || "-".to_owned(),
            |Estimate { value, low, high }| format!("{value:.2} [{low:.2}, {high:.2}]"),
        )
    };
    let mut text = format!("{:<26} {:>22} {:>22}", format!("{} events", found.len()), "ADE (u)", "FDE (u)");
    let mut line = |name: &str, of: &dyn Fn(&EventErrors, usize) -> f64| {
        let [ade, fde] = [0, 1].map(|k| cell(found.iter().map(|errors| of(errors, k)).collect()));
        text += &format!("\n{name:<26} {ade:>22} {fde:>22}");
    };
    for (row, name) in ROWS.into_iter().enumerate() {
        line(name, &|errors, k| errors[row][k]);
    }
    line("inference", &|errors, k| errors[0][k] - errors[1][k]);
    line("minds", &|errors, k| errors[1][k] - errors[3][k]);
    line("chance", &|errors, k| errors[3][k]);
    line("simple less its own", &|errors, k| errors[0][k] - errors[4][k]);
    text
}

fn errors(
    recording: &Recording,
    simple: &Simple,
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<Found>, MethodError> {
    let (observed, truth) = watched_and_rest(recording)?;
    let steps = truth.first().map_or(0, Vec::len);
    let prepared = simple.prepare(&observed, seed);
    let inference = simple.infer(&prepared, seed, tick).map_err(MethodError::new)?;
    let Some(inference) = inference else { return Ok(None) };
    let settings = ForecastSettings::default();
    let inferred = futures(&prepared, &inference, steps, seed, &settings, tick).map_err(MethodError::new)?;
    let Some(inferred) = inferred else { return Ok(None) };
    let scene = &recording.scene;
    let told = Hypothesis {
        goals: AgentId::ALL.map(|agent| scene.agents[agent].goal),
        attitudes: AgentId::ALL.map(|agent| scene.agents[agent].attitude),
        strengths: AgentId::ALL.map(|agent| scene.agents[agent].strength),
    };
    let mut by_kind: Vec<(Vec<Forecast>, f64)> = Vec::new();
    for kind in inference.minds.iter().filter(|kind| kind.probability >= LEAST_PROBABILITY) {
        let prepared: PreparedEvent = prepared.with_agents(kind.agents);
        let mut told_futures = Vec::with_capacity(TOLD);
        for repeat in 0..TOLD as u64 {
            if tick().is_break() {
                return Ok(None);
            }
            // Not the random numbers of SIMPLE's own futures.
            let seed = derive_seed(seed, Purpose::Evaluation, repeat);
            let future = prepared.predict(&told, WATCHED_STEPS, steps, seed).map_err(MethodError::new)?;
            told_futures.push(future);
        }
        by_kind.push((told_futures, kind.probability));
    }
    by_kind.sort_by(|a, b| b.1.total_cmp(&a.1));
    let weighted =
        by_kind.iter().flat_map(|(paths, weight)| paths.iter().map(|path| (path.clone(), *weight)));
    let told = Futures::new(weighted.collect());
    let Some((likely, _)) = by_kind.first() else { return Ok(None) };
    let one = mean(likely.iter().map(|future| error(future, &truth)))?;
    let own = of_own_future(&Futures::new(likely.iter().map(|path| (path.clone(), 1.0)).collect()))?;
    let expected = of_own_future(&inferred)?;
    let errors = [error(&inferred.median(), &truth)?, error(&told.median(), &truth)?, one, own, expected];
    Ok(Some(Found { errors }))
}

/// The expected error of the forecast of one of these futures by the others.
fn of_own_future(futures: &Futures) -> Result<[f64; 2], MethodError> {
    let mut sum = [0.0; 2];
    let mut total = 0.0;
    for (left_out, (path, weight)) in futures.paths.iter().enumerate() {
        let others = futures.paths.iter().enumerate().filter(|(k, _)| *k != left_out);
        let others = Futures::new(others.map(|(_, other)| other.clone()).collect());
        let errors = error(&others.median(), path)?;
        sum = [0, 1].map(|k| sum[k] + weight * errors[k]);
        total += weight;
    }
    Ok(sum.map(|sum| sum / total))
}

/// ADE and FDE of the agents.
fn error(forecast: &Forecast, truth: &Forecast) -> Result<[f64; 2], MethodError> {
    let [agents, _] = Errors::of(forecast, truth).map_err(MethodError::new)?;
    Ok([agents.ade, agents.fde])
}

fn mean(errors: impl Iterator<Item = Result<[f64; 2], MethodError>>) -> Result<[f64; 2], MethodError> {
    let errors = errors.collect::<Result<Vec<_>, _>>()?;
    let count = errors.len().max(1) as f64;
    Ok([0, 1].map(|k| errors.iter().map(|it| it[k]).sum::<f64>() / count))
}

#[cfg(test)]
mod tests {
    use super::table;

    /// The three parts add up to the error of SIMPLE.
    #[test]
    fn the_parts_add_up() {
        let found = [
            [[3.0, 5.0], [2.0, 4.0], [2.5, 4.5], [0.5, 1.5], [2.0, 3.0]],
            [[1.0, 1.0], [1.0, 2.0], [1.5, 2.5], [0.5, 0.5], [2.0, 2.0]],
        ];
        let text = table(&found, 1);
        let value = |name: &str, column: usize| -> f64 {
            let line = text.lines().find(|line| line.starts_with(name)).expect("a row");
            let cells: Vec<&str> = line[26..].split(']').map(str::trim).collect();
            cells[column].split_whitespace().next().expect("a value").parse().expect("a number")
        };
        for column in 0..2 {
            let parts: f64 = ["inference", "minds", "chance"].map(|name| value(name, column)).iter().sum();
            assert!((parts - value("simple", column)).abs() < 0.02, "{text}");
        }
        assert!(
            (value("inference", 0) - 0.5).abs() < 1e-9 && (value("minds", 1) - 2.0).abs() < 1e-9,
            "{text}"
        );
    }
}
