//! Worth of each parameter: the figures with it at its neutral value.

use super::{
    case::{Explanation, Method},
    evaluations::Evaluations,
    means::{Difference, Means},
    parameter::Parameter,
    report::{self, means},
};
use crate::error::LabError;
use phase_minds::PhaseParameters;
use serde::Serialize;

/// Worth of the parameters on some events.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct Ablation {
    format: &'static str,
    method: Method,
    /// With all parameters.
    complete: Means,
    /// Without each of them.
    without: Vec<Without>,
}

/// The figures with one parameter at its neutral value, and by how much they exceed those with all
/// parameters.
#[derive(Clone, PartialEq, Debug, Serialize)]
struct Without {
    parameter: &'static str,
    value: f64,
    neutral: f64,
    means: Means,
    log_posterior: Difference,
    log_likelihood: Difference,
    chance: Difference,
}

impl Ablation {
    /// Evaluates these parameters on these events.
    ///
    /// # Errors
    /// As [`Evaluations::of`].
    pub(super) fn of(
        base: PhaseParameters,
        parameters: &[&Parameter],
        events: &[usize],
        method: Method,
        evaluations: &mut Evaluations<'_>,
    ) -> Result<Self, LabError> {
        let mut figures = |minds, activity: &str| {
            evaluations.of(&events.iter().map(|&event| (minds, event)).collect::<Vec<_>>(), activity)
        };
        let complete = figures(base, "all parameters")?;
        let mut without = Vec::with_capacity(parameters.len());
        for parameter in parameters {
            let minds = parameter.with(base, parameter.neutral);
            let after = figures(minds, &format!("without {}", parameter.name))?;
            let difference = |get: fn(&Explanation) -> f64| Difference::of(&complete, &after, get);
            without.push(Without {
                parameter: parameter.name,
                value: parameter.value(&base),
                neutral: parameter.neutral,
                means: Means::over(&after),
                log_posterior: difference(|it| it.log_posterior),
                log_likelihood: difference(|it| it.log_likelihood),
                chance: difference(|it| it.chance),
            });
        }
        let complete = Means::over(&complete);
        Ok(Self { format: "phase-minds-ablation/1", method, complete, without })
    }

    /// The table.
    pub(super) fn table(&self) -> String {
        let mut text = format!(
            "{}cpu: CPU time of a decision (ms); all but `complete`: difference to it, ± its standard error\n\n\
             {:<17} {:>7} {:>7}  {:>16}  {:>16}  {:>16}  {:>6}\n",
            report::about(self.method),
            "without",
            "value",
            "neutral",
            "log post",
            "ll",
            "chance",
            "cpu"
        );
        for it in &self.without {
            let one = |it: Difference| format!("{:+.3} ± {:.3}", it.mean, it.standard_error);
            text += &format!(
                "{:<17} {:>7} {:>7}  {:>16}  {:>16}  {:>16}  {:>6.3}\n",
                it.parameter,
                it.value,
                it.neutral,
                one(it.log_posterior),
                one(it.log_likelihood),
                one(it.chance),
                it.means.cpu_seconds * 1e3
            );
        }
        let cpu = self.complete.cpu_seconds * 1e3;
        text + &format!("\ncomplete: events, log post, ll, chance: {}; cpu {cpu:.3}\n", means(&self.complete))
    }
}
