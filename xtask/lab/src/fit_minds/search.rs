//! Coordinate search: one parameter after another, in all fits at the same time.

use super::{
    evaluations::Evaluations,
    means::Means,
    parameter::{Parameter, Step},
};
use crate::error::LabError;
use phase_cli::context::Context;
use phase_minds::PhaseParameters;

/// Least gain in mean log posterior for which a change is kept (nat an event). Less is chance.
const MINIMUM_GAIN: f64 = 0.01;

/// Parameters that are being fitted to some events.
pub(super) struct Fit {
    /// Its name in tables.
    pub(super) name: String,
    /// The parameters, as far as fitted.
    pub(super) parameters: PhaseParameters,
    /// The events to which they are fitted.
    pub(super) training: Vec<usize>,
    /// The events held out.
    pub(super) validation: Vec<usize>,
    step: Option<Step>,
    changed: bool,
}

impl Fit {
    /// A fit that has not begun.
    pub(super) fn new(
        name: String,
        start: PhaseParameters,
        training: Vec<usize>,
        validation: Vec<usize>,
    ) -> Self {
        Self { name, parameters: start, training, validation, step: Some(Step::Coarse), changed: false }
    }

    /// The values of a parameter to be compared: its own first. None once the fit has converged.
    fn values(&self, parameter: &Parameter) -> Vec<f64> {
        let own = parameter.value(&self.parameters);
        let others = self.step.map(|step| parameter.neighbours(own, step));
        others.map_or_else(Vec::new, |others| [vec![own], others].concat())
    }

    /// Ends a round: with smaller steps, or none, if nothing has changed.
    fn end_round(&mut self) {
        if !self.changed {
            self.step = match self.step {
                Some(Step::Coarse) => Some(Step::Fine),
                Some(Step::Fine) | None => None,
            };
        }
        self.changed = false;
    }
}

/// Fits these parameters by the mean log posterior of the truth, in at most so many rounds. Fits go side by
/// side, since they share most evaluations.
///
/// # Errors
/// As [`Evaluations::of`].
pub(super) fn run(
    fits: &mut [Fit],
    parameters: &[&Parameter],
    rounds: usize,
    evaluations: &mut Evaluations<'_>,
    context: &Context,
) -> Result<(), LabError> {
    for round in 1..=rounds {
        for parameter in parameters {
            improve(fits, parameter, &format!("round {round}, {}", parameter.name), evaluations)?;
            context.note(row(round, parameter, fits, evaluations)?);
        }
        fits.iter_mut().for_each(Fit::end_round);
        if fits.iter().all(|fit| fit.step.is_none()) {
            context.note(format!("converged after {round} rounds"));
            break;
        }
    }
    Ok(())
}

/// Gives every fit its best value of one parameter.
fn improve(
    fits: &mut [Fit],
    parameter: &Parameter,
    activity: &str,
    evaluations: &mut Evaluations<'_>,
) -> Result<(), LabError> {
    let tried: Vec<Vec<PhaseParameters>> = fits
        .iter()
        .map(|fit| fit.values(parameter).into_iter().map(|it| parameter.with(fit.parameters, it)).collect())
        .collect();
    let pairs = fits.iter().zip(&tried).flat_map(|(fit, tried)| {
        tried.iter().flat_map(|&parameters| fit.training.iter().map(move |&event| (parameters, event)))
    });
    // All at once, so that no core waits.
    evaluations.of(&pairs.collect::<Vec<_>>(), activity)?;
    for (fit, tried) in fits.iter_mut().zip(tried) {
        let mut best: Option<(PhaseParameters, f64)> = None;
        for parameters in tried {
            let score = Means::of(parameters, &fit.training, evaluations, activity)?.log_posterior;
            // The present value comes first, and only a gain replaces it; of two that gain, the better one
            // wins.
            let least = match best {
                None => f64::NEG_INFINITY,
                Some((kept, score)) if kept == fit.parameters => score + MINIMUM_GAIN,
                Some((_, score)) => score,
            };
            if score > least {
                best = Some((parameters, score));
            }
        }
        if let Some((parameters, _)) = best.filter(|(parameters, _)| *parameters != fit.parameters) {
            (fit.parameters, fit.changed) = (parameters, true);
        }
    }
    Ok(())
}

/// A row of the running table: the value of a parameter and the mean log posterior of the training events, by
/// fit.
fn row(
    round: usize,
    parameter: &Parameter,
    fits: &[Fit],
    evaluations: &mut Evaluations<'_>,
) -> Result<String, LabError> {
    let mut row = format!("round {round}  {:<18}", parameter.name);
    for fit in fits {
        let means = Means::of(fit.parameters, &fit.training, evaluations, &fit.name)?;
        row += &format!("  {:>7} {:>7.3}", parameter.value(&fit.parameters), means.log_posterior);
    }
    Ok(row)
}
