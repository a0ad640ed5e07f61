//! The tables of a fit.

use super::{
    case::{Explanation, Method},
    evaluations::Evaluations,
    means::{Difference, Means},
    parameter::Parameter,
    search::Fit,
};
use crate::error::LabError;
use phase_minds::PhaseParameters;

/// Heading of a column of means.
const HEADING: &str = "events log post     ll chance";

/// The results of fits, of which the last is on all events: how well each explains the events that it was
/// fitted to and those held out, and the parameters. `held_out` are the events of another file.
///
/// # Errors
/// As [`Evaluations::of`].
pub(super) fn of(
    fits: &[Fit],
    start: PhaseParameters,
    parameters: &[&Parameter],
    held_out: &[usize],
    method: Method,
    evaluations: &mut Evaluations<'_>,
) -> Result<String, LabError> {
    let mut text = format!("{}\n{:<9}  {:<29}  {:<29}", about(method), "fit", "training", "validation");
    for parameter in parameters {
        text += &format!("  {}", parameter.name);
    }
    text += &format!("\n{:<9}  {HEADING}  {HEADING}\n", "");
    let mut before = Vec::new();
    let mut after = Vec::new();
    for fit in fits {
        let training = Means::of(fit.parameters, &fit.training, evaluations, "training events")?;
        let mut figures = |parameters, activity| {
            evaluations.of(&fit.validation.iter().map(|&k| (parameters, k)).collect::<Vec<_>>(), activity)
        };
        before.extend(figures(start, "start, validation events")?);
        let validated = figures(fit.parameters, "validation events")?;
        let validation = Means::over(&validated);
        after.extend(validated);
        text += &format!("{:<9}  {}  {}", fit.name, means(&training), means(&validation));
        for parameter in parameters {
            let value = parameter.value(&fit.parameters).to_string();
            text += &format!("  {value:>width$}", width = parameter.name.len());
        }
        text += "\n";
    }
    text += &format!("{:<9}  {:<29}", "start", "");
    text += &format!("  {}", means(&Means::over(&before)));
    for parameter in parameters {
        let value = parameter.value(&start).to_string();
        text += &format!("  {value:>width$}", width = parameter.name.len());
    }
    text += &format!("\n\nheld out by folds, start to fitted: {}\n", gain(&before, &after));
    if let (false, Some(all)) = (held_out.is_empty(), fits.last()) {
        let mut figures = |parameters, activity| {
            evaluations.of(&held_out.iter().map(|&k| (parameters, k)).collect::<Vec<_>>(), activity)
        };
        let before = figures(start, "start, generated events")?;
        let after = figures(all.parameters, "generated events")?;
        text += &format!("generated, start:                  {}\n", means(&Means::over(&before)));
        text += &format!("generated, fitted to all events:   {}\n", means(&Means::over(&after)));
        text += &format!("generated, start to fitted:        {}\n", gain(&before, &after));
    }
    Ok(text)
}

/// Legend: the evaluation of events, and the meaning of the figures.
pub(super) fn about(method: Method) -> String {
    let Method { thin, simulations, exponent, lapse, .. } = method;
    format!(
        "every {thin}. observed state, {simulations} simulations a decision, exponent {exponent:.2}, lapse {lapse}\n\
         log post: ln of the posterior of the true goals and attitudes (nat an event); ll, chance: of what was done, under \
         the truth (nat a step)\n"
    )
}

/// Means in a row.
pub(super) fn means(it: &Means) -> String {
    if it.events == 0 {
        return format!("{:>6} {:>8} {:>6} {:>6}", 0, "-", "-", "-");
    }
    format!("{:>6} {:>8.3} {:>6.3} {:>6.3}", it.events, it.log_posterior, it.log_likelihood, it.chance)
}

/// Difference between figures of the same events, in words.
pub(super) fn gain(before: &[Explanation], after: &[Explanation]) -> String {
    let one = |get| {
        let Difference { mean, standard_error } = Difference::of(before, after, get);
        format!("{mean:+.3} ± {standard_error:.3}")
    };
    format!(
        "log post {}, ll {}, chance {}",
        one(|it: &Explanation| it.log_posterior),
        one(|it| it.log_likelihood),
        one(|it| it.chance)
    )
}
