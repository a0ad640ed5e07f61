//! Scores of a distribution of futures.

use super::{Errors, ForecastError};
use phase_model::{AGENT_COUNT, Forecast};
use phase_statistics::mean;
use serde::{Deserialize, Serialize};

/// Scores of equally likely futures of the two agents (u).
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampleErrors {
    /// Number of futures.
    pub count: usize,
    /// minADE: the average displacement error of the future in which it is least, chosen for each agent.
    pub min_ade: f64,
    /// minFDE: the final displacement error of the future in which it is least, chosen for each agent.
    pub min_fde: f64,
    /// Energy score, a proper score of distributions (Gneiting and Raftery 2007): the mean over agents and
    /// steps of E‖X − y‖ − ½ E‖X − X′‖, where X and X′ are predicted positions, drawn independently, and y is
    /// the true one. Of a single future it is the ADE.
    pub energy: f64,
}

impl SampleErrors {
    /// Scores some futures; `None` without any.
    ///
    /// # Errors
    /// [`ForecastError`] if there is no step, a shape differs or a number is not finite.
    pub fn of(samples: &[Forecast], truth: &Forecast) -> Result<Option<Self>, ForecastError> {
        for sample in samples {
            Errors::of(sample, truth)?;
        }
        if samples.is_empty() {
            return Ok(None);
        }
        let count = samples.len() as f64;
        let steps = truth[0].len() as f64;
        let mut min_ade = 0.0;
        let mut min_fde = 0.0;
        let mut energy = 0.0;
        for (agent, truth) in truth.iter().enumerate().take(AGENT_COUNT) {
            let place = |sample: &Forecast, step: usize| sample[agent][step].as_dvec2();
            let errors = samples.iter().map(|sample| {
                let by_step = truth.iter().enumerate();
                by_step
                    .map(|(step, place_then)| place(sample, step).distance(place_then.as_dvec2()))
                    .collect()
            });
            let errors: Vec<Vec<f64>> = errors.collect();
            let ades = || errors.iter().filter_map(|by_step| mean(by_step));
            let fdes = || errors.iter().filter_map(|by_step| by_step.last().copied());
            min_ade += ades().fold(f64::INFINITY, f64::min);
            min_fde += fdes().fold(f64::INFINITY, f64::min);
            let mut spread = 0.0;
            for step in 0..truth.len() {
                for (k, one) in samples.iter().enumerate() {
                    // Each pair occurs twice.
                    let others = samples[..k].iter();
                    spread +=
                        2.0 * others.map(|other| place(one, step).distance(place(other, step))).sum::<f64>();
                }
            }
            energy += ades().sum::<f64>() / count - 0.5 * spread / (count * count * steps);
        }
        let agents = AGENT_COUNT as f64;
        Ok(Some(Self {
            count: samples.len(),
            min_ade: min_ade / agents,
            min_fde: min_fde / agents,
            energy: energy / agents,
        }))
    }
}
