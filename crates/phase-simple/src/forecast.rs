//! Task 2: future positions, predicted by the hypotheses that best explain what has been observed.

use crate::{Hypothesis, Inference, generative::PreparedEvent};
use core::ops::ControlFlow;
use phase_model::{
    Forecast, Vec2,
    random::{self, Purpose},
};
use phase_pomcp::PomcpError;

/// Iterations of Weiszfeld's algorithm.
const ROUNDS: usize = 30;

/// How futures are combined; the defaults were selected on the validation events of PHASE-500.
#[derive(Clone, Copy, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct ForecastSettings {
    /// Number of most likely hypotheses to simulate; at least 1.
    pub hypotheses: usize,
    /// Futures per hypothesis, each with its own random stream; at least 1.
    pub repeats: usize,
    /// Inverse temperature of the posterior weights: after 20 steps the posterior is overconfident.
    #[serde(rename = "temper")]
    pub inverse_temperature: f64,
}

impl Default for ForecastSettings {
    fn default() -> Self {
        Self { hypotheses: 5, repeats: 6, inverse_temperature: 0.4 }
    }
}

/// Simulates the most likely hypotheses, each by the minds that it is about, for the given number of further steps
/// and takes, for every entity and step, the geometric median of the resulting positions, weighted by probability,
/// which minimises the expected displacement. `None` if `tick` cancelled it.
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
    let mut futures: Vec<(Forecast, f64)> = Vec::new();
    for (prepared, hypothesis, weight) in likely.into_iter().take(settings.hypotheses.max(1)) {
        for repeat in 0..settings.repeats.max(1) {
            if tick().is_break() {
                return Ok(None);
            }
            let seed = random::derive_seed(seed, Purpose::Inference, repeat as u64);
            futures.push((
                prepared.predict(hypothesis, steps, seed)?,
                libm::pow(weight, settings.inverse_temperature),
            ));
        }
    }
    let place = |entity: usize, step: usize| {
        let places: Vec<(Vec2, f64)> = futures
            .iter()
            .filter_map(|(future, weight)| Some((*future.get(entity)?.get(step)?, *weight)))
            .collect();
        geometric_median(&places)
    };
    let entities = prepared.observed().entities().count();
    Ok(Some((0..entities).map(|entity| (0..steps).map(|step| place(entity, step)).collect()).collect()))
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
