//! The table of a fit.

use super::grid::{Grid, Weights};
use crate::check_minds::recognition::Recognition;
use phase_statistics::mean;

/// Weights fitted without one fold.
pub(super) struct Fold {
    /// The fitted weights.
    pub(super) weights: Weights,
    /// The events held out.
    pub(super) validation: Vec<usize>,
}

/// Everything that is reported.
pub(super) struct Report<'a> {
    /// One fit without each fold.
    pub(super) folds: Vec<Fold>,
    /// Fitted to all events.
    pub(super) fitted: Weights,
    /// Those of the library.
    pub(super) present: Weights,
    /// The events.
    pub(super) grid: &'a Grid,
    /// Further events, to which nothing was fitted.
    pub(super) generated: &'a Grid,
}

impl Report<'_> {
    /// The table.
    pub(super) fn text(&self) -> String {
        let mut text = String::from(
            "log post: ln of the posterior of the true goals and attitudes (nat an event); log rel: ln of that of the true \
             relation;\nrelation, goals: share right; named: who helps or hinders; wrong: the wrong agent with more than 0.9\n\n",
        );
        text += &format!(
            "{:<26} {:>6} {:>6} {:>6} {:>7} {:>9} {:>8} {:>8} {:>6} {:>8} {:>6}\n",
            "fit", "κ", "β", "ε", "events", "log post", "log rel", "relation", "goals", "named", "wrong"
        );
        let of = |grid: &Grid, events: &[usize], weights: Weights| -> Vec<Recognition> {
            events.iter().filter_map(|&event| grid.answer(event, weights).copied()).collect()
        };
        let mut held_out = Vec::new();
        for (k, fold) in self.folds.iter().enumerate() {
            let answers = of(self.grid, &fold.validation, fold.weights);
            text += &row(&format!("without fold {}, on it", k + 1), Some(fold.weights), &answers);
            held_out.extend(answers);
        }
        let all: Vec<usize> = (0..self.grid.len()).collect();
        text += &row("held out, all folds", None, &held_out);
        text += &row("present, all events", Some(self.present), &of(self.grid, &all, self.present));
        text += &row("fitted to all, on them", Some(self.fitted), &of(self.grid, &all, self.fitted));
        if self.generated.len() > 0 {
            let all: Vec<usize> = (0..self.generated.len()).collect();
            let best = self.generated.fit(&all);
            text += &row("generated, present", Some(self.present), &of(self.generated, &all, self.present));
            text +=
                &row("generated, fitted to first", Some(self.fitted), &of(self.generated, &all, self.fitted));
            text += &row("generated, fitted to these", Some(best), &of(self.generated, &all, best));
        }
        text
    }
}

fn row(name: &str, weights: Option<Weights>, answers: &[Recognition]) -> String {
    let number = |get: &dyn Fn(&Recognition) -> f64| mean(&answers.iter().map(get).collect::<Vec<_>>());
    let show = |value: Option<f64>, width: usize| {
        value.map_or_else(|| format!("{:>width$}", "-"), |value| format!("{value:>width$.3}"))
    };
    let social: Vec<_> = answers.iter().filter_map(|it| it.social).collect();
    let named = social.iter().filter(|it| it.named).count();
    let wrong = social.iter().filter(|it| it.wrong > 0.9).count();
    let weights = weights.map_or_else(
        || format!("{:>6} {:>6} {:>6}", "", "", ""),
        |it| format!("{:>6} {:>6} {:>6}", it.inverse_temperature, it.beta, it.lapse_rate),
    );
    format!(
        "{name:<26} {weights} {:>7} {} {} {} {} {:>8} {wrong:>6}\n",
        answers.len(),
        show(number(&|it| it.log_posterior), 9),
        show(number(&|it| libm::log(it.relation.max(f64::MIN_POSITIVE))), 8),
        show(number(&|it| f64::from(u8::from(it.relation_right))), 8),
        show(number(&|it| 0.5 * it.goals_right as f64), 6),
        format!("{named} of {}", social.len()),
    )
}
