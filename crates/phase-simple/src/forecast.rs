//! Task 2: future positions, predicted by the hypotheses that best explain what has been observed.

use crate::{Hypothesis, Inference, generative::PreparedEvent};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::{
    AGENT_COUNT, Forecast, Vec2,
    random::{self, Purpose},
};
use phase_pomcp::PomcpError;
use phase_statistics::mean;
use rand::RngExt;

/// Iterations of Weiszfeld's algorithm.
const ROUNDS: usize = 30;

/// Settings of the combination of futures into a forecast.
///
/// The inverse temperature, the error rate and the least weight were fitted by `cargo xtask-networks
/// fit-forecast`; the defaults are the fitted values.
#[derive(Clone, Copy, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct ForecastSettings {
    /// Number of most likely hypotheses to simulate; at least 1.
    pub hypotheses: usize,
    /// Futures per hypothesis, each with its own random stream; at least 1.
    pub repeats: usize,
    /// Inverse temperature of the posterior weights: 1 takes them as they are.
    #[serde(rename = "temper")]
    pub inverse_temperature: f64,
    /// Hindcasts of each hypothesis, from evenly spaced earlier steps to the last observed one. With 0 there
    /// are none.
    pub hindcasts: usize,
    /// Loss of a hypothesis for each unit of the mean displacement error of its hindcasts (nat/u); at least
    /// 0.
    pub hindcast_error_rate: f64,
    /// Hypotheses with less than this share of the weight of the best one are not simulated further, 0 to 1.
    pub least_weight: f64,
}

impl Default for ForecastSettings {
    fn default() -> Self {
        Self {
            hypotheses: 12,
            repeats: 6,
            inverse_temperature: 1.0,
            hindcasts: 3,
            hindcast_error_rate: 0.5,
            least_weight: 0.1,
        }
    }
}

impl ForecastSettings {
    /// The steps after which hindcasts begin if so many have been watched: evenly spaced, each before the
    /// last.
    #[must_use]
    pub fn starts(&self, watched: usize) -> Vec<usize> {
        let start = |k: usize| watched * k / (self.hindcasts + 1);
        let mut starts: Vec<usize> =
            (1..=self.hindcasts).map(start).filter(|&start| start < watched).collect();
        starts.dedup();
        starts
    }
}

/// Simulated futures of an event with their weights.
///
/// ```
/// use phase_model::Vec2;
/// use phase_simple::Futures;
///
/// // One entity, one step: it goes to the right three times as likely as to the left.
/// let to = |x| vec![vec![Vec2::new(x, 0.0)]];
/// let futures = Futures::new(vec![(to(1.0), 3.0), (to(-1.0), 1.0)]);
/// assert!(futures.median()[0][0].x > 0.9);
/// assert_eq!(futures.draw(4, 1).iter().filter(|future| future[0][0].x > 0.0).count(), 3);
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Futures {
    /// Futures and their weights, above 0 and not normalised.
    pub paths: Vec<(Forecast, f64)>,
    entities: usize,
    steps: usize,
}

impl Futures {
    /// Futures with their weights, above 0. All have the shape of the first one: entities × steps.
    #[must_use]
    pub fn new(paths: Vec<(Forecast, f64)>) -> Self {
        let first = paths.first().map(|(path, _)| path);
        let (entities, steps) = first.map_or((0, 0), |path| (path.len(), path.first().map_or(0, Vec::len)));
        Self { paths, entities, steps }
    }

    /// The futures of hypotheses, those with enough weight; a hypothesis shares its weight among its futures.
    #[must_use]
    pub fn of(continuations: &[Continuation], settings: &ForecastSettings) -> Self {
        let greatest = greatest_log_weight(continuations, settings);
        let weight = |it: &Continuation| libm::exp(it.log_weight(settings) - greatest);
        let kept = continuations.iter().map(|it| (it, weight(it))).filter(|it| it.1 >= settings.least_weight);
        let weighted = kept.flat_map(|(continuation, weight)| {
            let each = weight / continuation.futures.len().max(1) as f64;
            continuation.futures.iter().map(move |future| (future.clone(), each))
        });
        Self::new(weighted.collect())
    }

    /// For every entity and step, the weighted geometric median of its positions, which minimises the
    /// expected displacement.
    #[must_use]
    pub fn median(&self) -> Forecast {
        let place = |entity: usize, step: usize| {
            let places = self.paths.iter();
            let places = places.filter_map(|(path, weight)| Some((*path.get(entity)?.get(step)?, *weight)));
            geometric_median(&places.collect::<Vec<(Vec2, f64)>>())
        };
        (0..self.entities).map(|entity| (0..self.steps).map(|step| place(entity, step)).collect()).collect()
    }

    /// So many equally likely futures, drawn by their weights: systematic resampling, so that a future with a
    /// share p of the weight is drawn p · `count` times, rounded up or down.
    #[must_use]
    pub fn draw(&self, count: usize, seed: u64) -> Vec<Forecast> {
        let total: f64 = self.paths.iter().map(|(_, weight)| weight).sum();
        let first: f64 = random::stream(seed, Purpose::Inference, u64::MAX).random();
        let mut drawn = Vec::with_capacity(count);
        let mut sum = 0.0;
        for (path, weight) in &self.paths {
            sum += weight / total;
            while drawn.len() < count && drawn.len() as f64 + first < sum * count as f64 {
                drawn.push(path.clone());
            }
        }
        // The sum of the shares may be less than 1 by a rounding error.
        let last = self.paths.last().map(|(path, _)| path);
        drawn.extend(last.into_iter().cycle().take(count - drawn.len()).cloned());
        drawn
    }
}

/// The predictions of one hypothesis: of steps that were observed, which tell how good they are, and of those
/// that were not.
#[derive(Clone, PartialEq, Debug)]
pub struct Continuation {
    /// Posterior probability of the hypothesis, 0 to 1.
    pub weight: f64,
    /// Displacement errors of its hindcasts (u), in the order of [`ForecastSettings::starts`].
    pub hindcast_errors: Vec<f64>,
    /// Simulated futures, each with its own random stream; none if it has too little weight.
    pub futures: Vec<Forecast>,
}

impl Continuation {
    /// The weight of its futures together, on a logarithmic scale (nat) and not normalised: the posterior
    /// times the evidence of the hindcasts.
    #[must_use]
    pub fn log_weight(&self, settings: &ForecastSettings) -> f64 {
        let error = mean(&self.hindcast_errors).unwrap_or_default();
        settings.inverse_temperature * libm::log(self.weight) - settings.hindcast_error_rate * error
    }
}

/// Simulates the most likely hypotheses, each by the minds that it is about: from earlier steps to the last
/// observed one, and those with enough weight for the given number of further steps. `None` if `tick`
/// cancelled it.
///
/// A hypothesis explains each decision by itself; a hindcast says whether it also explains where many
/// decisions in a row lead.
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub fn continuations(
    prepared: &PreparedEvent,
    inference: &Inference,
    steps: usize,
    seed: u64,
    settings: &ForecastSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Vec<Continuation>>, PomcpError> {
    let others: Vec<PreparedEvent> =
        inference.minds.iter().skip(1).map(|kind| prepared.with_agents(kind.agents)).collect();
    let by_kind = core::iter::once(prepared).chain(&others).zip(&inference.minds);
    let mut likely: Vec<(&PreparedEvent, &Hypothesis, f64)> = by_kind
        .flat_map(|(prepared, kind)| {
            let hypotheses = kind.posterior.hypotheses.iter();
            hypotheses.map(move |(hypothesis, weight)| (prepared, hypothesis, kind.probability * weight))
        })
        .collect();
    likely.sort_by(|a, b| b.2.total_cmp(&a.2));
    likely.truncate(settings.hypotheses.max(1));
    let observed = prepared.observed();
    let last = observed.steps();
    let starts = settings.starts(observed.steps());
    let seeds = |repeat: usize| random::derive_seed(seed, Purpose::Inference, repeat as u64);
    let mut found = Vec::with_capacity(likely.len());
    for &(prepared, hypothesis, weight) in &likely {
        if tick().is_break() {
            return Ok(None);
        }
        let error = |&start: &usize| {
            let hindcast = prepared.predict(hypothesis, start, last - start, seeds(0))?;
            Ok(hindcast_error(&hindcast, observed, start))
        };
        let hindcast_errors = starts.iter().map(error).collect::<Result<_, PomcpError>>()?;
        found.push(Continuation { weight, hindcast_errors, futures: Vec::new() });
    }
    let least = greatest_log_weight(&found, settings) + libm::log(settings.least_weight);
    for (&(prepared, hypothesis, _), continuation) in likely.iter().zip(&mut found) {
        if continuation.log_weight(settings) < least {
            continue;
        }
        for repeat in 0..settings.repeats.max(1) {
            if tick().is_break() {
                return Ok(None);
            }
            continuation.futures.push(prepared.predict(hypothesis, last, steps, seeds(repeat))?);
        }
    }
    Ok(Some(found))
}

/// The weight of the best hypothesis, on a logarithmic scale.
fn greatest_log_weight(found: &[Continuation], settings: &ForecastSettings) -> f64 {
    let weights = found.iter().map(|continuation| continuation.log_weight(settings));
    weights.fold(f64::NEG_INFINITY, f64::max)
}

/// Mean distance of the agents from where they were observed, in a forecast from an earlier step (u).
#[must_use]
pub fn hindcast_error(forecast: &Forecast, observed: &ObservedEvent, start: usize) -> f64 {
    let rows = || observed.rows().iter().skip(1 + start);
    let agents = forecast.iter().take(AGENT_COUNT).enumerate();
    let distances = agents.flat_map(|(agent, path)| {
        path.iter().zip(rows()).map(move |(place, row)| f64::from(place.distance(row[agent].position)))
    });
    let (sum, count) = distances.fold((0.0, 0_usize), |(sum, count), distance| (sum + distance, count + 1));
    sum / count.max(1) as f64
}

/// The futures of the most likely hypotheses of a posterior, for `steps` steps after the last one observed;
/// `None` if `tick` cancelled it.
///
/// [`Simple`](crate::Simple) forecasts with [`Futures::median`] and [`Futures::draw`] of them.
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub fn futures(
    prepared: &PreparedEvent,
    inference: &Inference,
    steps: usize,
    seed: u64,
    settings: &ForecastSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Futures>, PomcpError> {
    let found = continuations(prepared, inference, steps, seed, settings, tick)?;
    Ok(found.map(|found| Futures::of(&found, settings)))
}

/// The point with the minimum weighted sum of distances to some places (Weiszfeld's algorithm from their
/// mean); the origin if there are none.
#[must_use]
pub fn geometric_median(places: &[(Vec2, f64)]) -> Vec2 {
    /// Below this distance to a place the iteration has converged to it (u).
    const CONVERGENCE_TOLERANCE: f64 = 1e-4;
    let mean = |weights: &dyn Fn(&(Vec2, f64)) -> f64| {
        let mut x = 0.0;
        let mut y = 0.0;
        let mut sum = 0.0;
        for place in places {
            let weight = weights(place);
            x += weight * f64::from(place.0.x);
            y += weight * f64::from(place.0.y);
            sum += weight;
        }
        if sum > 0.0 { Vec2::new((x / sum) as f32, (y / sum) as f32) } else { Vec2::ZERO }
    };
    let mut median = mean(&|place| place.1);
    for _ in 0..ROUNDS {
        median = mean(&|place| place.1 / f64::from(place.0.distance(median)).max(CONVERGENCE_TOLERANCE));
    }
    median
}
