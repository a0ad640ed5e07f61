//! Task 2: future positions, predicted by the hypotheses that best explain what has been observed.

use crate::{Hypothesis, Inference, generative::PreparedEvent};
use core::ops::ControlFlow;
use phase_model::{
    Forecast, Vec2,
    random::{self, Purpose},
};
use phase_pomcp::PomcpError;
use rand::RngExt;

/// Iterations of Weiszfeld's algorithm.
const ROUNDS: usize = 30;

/// How futures are combined; the inverse temperature was fitted by `cargo xtask fit-forecast`, the numbers were selected on the
/// validation events of PHASE-500.
#[derive(Clone, Copy, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct ForecastSettings {
    /// Number of most likely hypotheses to simulate; at least 1.
    pub hypotheses: usize,
    /// Futures per hypothesis, each with its own random stream; at least 1.
    pub repeats: usize,
    /// Inverse temperature of the posterior weights: 1 takes them as they are.
    #[serde(rename = "temper")]
    pub inverse_temperature: f64,
}

impl Default for ForecastSettings {
    fn default() -> Self {
        Self { hypotheses: 5, repeats: 6, inverse_temperature: 1.0 }
    }
}

/// Simulated futures of an event with their weights.
#[derive(Clone, PartialEq, Debug)]
pub struct Futures {
    /// Futures and their weights, above 0 and not normalised.
    pub paths: Vec<(Forecast, f64)>,
    entities: usize,
    steps: usize,
}

impl Futures {
    /// Futures of one shape with their weights. It is that of the first one.
    #[must_use]
    pub fn new(paths: Vec<(Forecast, f64)>) -> Self {
        let first = paths.first().map(|(path, _)| path);
        let (entities, steps) = first.map_or((0, 0), |path| (path.len(), path.first().map_or(0, Vec::len)));
        Self { paths, entities, steps }
    }

    /// For every entity and step, the weighted geometric median of its positions, which minimises the expected displacement.
    #[must_use]
    pub fn median(&self) -> Forecast {
        let place = |entity: usize, step: usize| {
            let places = self.paths.iter();
            let places = places.filter_map(|(path, weight)| Some((*path.get(entity)?.get(step)?, *weight)));
            geometric_median(&places.collect::<Vec<(Vec2, f64)>>())
        };
        (0..self.entities).map(|entity| (0..self.steps).map(|step| place(entity, step)).collect()).collect()
    }

    /// So many equally likely futures, drawn by their weights: systematic resampling, so that a future with a share p of the
    /// weight is drawn p · `count` times, rounded up or down.
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

/// Simulates the most likely hypotheses, each by the minds that it is about, for the given number of further steps. `None` if
/// `tick` cancelled it.
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
    let others: Vec<PreparedEvent> =
        inference.minds.iter().skip(1).map(|kind| prepared.with_minds(kind.minds)).collect();
    let by_kind = core::iter::once(prepared).chain(&others).zip(&inference.minds);
    let mut likely: Vec<(&PreparedEvent, &Hypothesis, f64)> = by_kind
        .flat_map(|(prepared, kind)| {
            let hypotheses = kind.posterior.hypotheses.iter();
            hypotheses.map(move |(hypothesis, weight)| (prepared, hypothesis, kind.probability * weight))
        })
        .collect();
    likely.sort_by(|a, b| b.2.total_cmp(&a.2));
    let mut paths: Vec<(Forecast, f64)> = Vec::new();
    for (prepared, hypothesis, weight) in likely.into_iter().take(settings.hypotheses.max(1)) {
        for repeat in 0..settings.repeats.max(1) {
            if tick().is_break() {
                return Ok(None);
            }
            let seed = random::derive_seed(seed, Purpose::Inference, repeat as u64);
            paths.push((
                prepared.predict(hypothesis, steps, seed)?,
                libm::pow(weight, settings.inverse_temperature),
            ));
        }
    }
    Ok(Some(Futures::new(paths)))
}

/// The geometric median of the [`futures`].
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub fn forecast(
    prepared: &PreparedEvent,
    inference: &Inference,
    steps: usize,
    seed: u64,
    settings: &ForecastSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Forecast>, PomcpError> {
    Ok(futures(prepared, inference, steps, seed, settings, tick)?.map(|futures| futures.median()))
}

/// The point with the minimum weighted sum of distances to some places (Weiszfeld's algorithm from their
/// mean); the origin if there are none.
#[must_use]
pub fn geometric_median(places: &[(Vec2, f64)]) -> Vec2 {
    /// Below this distance to a place the iteration has converged to it (u).
    const CONVERGENCE_TOLERANCE: f64 = 1e-4;
    let mean = |weights: &dyn Fn(&(Vec2, f64)) -> f64| {
        let (mut x, mut y, mut sum) = (0.0, 0.0, 0.0);
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
