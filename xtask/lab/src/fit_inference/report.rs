//! The table of a fit.

use super::{case::Answer, grid::Grid, weights::Weights};
use phase_statistics::mean;

/// Weights fitted without one fold.
pub(super) struct Fold {
    /// The fitted weights.
    pub(super) weights: Weights,
    /// The events held out.
    pub(super) validation: Vec<usize>,
}

/// Everything that is reported.
pub(super) struct InferenceFitReport<'a> {
    /// One fit without each fold.
    pub(super) folds: Vec<Fold>,
    /// Fitted to all events.
    pub(super) fitted: Weights,
    /// Integrated autocorrelation time of the evidence (steps).
    pub(super) autocorrelation_time: Option<f64>,
    /// Those of the library.
    pub(super) present: Weights,
    /// The events.
    pub(super) grid: &'a Grid,
    /// Further events, to which nothing was fitted, by file.
    pub(super) held_out: &'a [(String, Grid)],
}

impl InferenceFitReport<'_> {
    /// The table.
    pub(super) fn text(&self) -> String {
        let mut text = String::from(
            "log post: ln of the posterior of the true goals and attitudes (nat an event); log rel: ln of that of the true \
             relation;\nrelation, goals: share right; named: who helps or hinders; wrong: the wrong agent with more than 0.9;\n\
             last: mean posterior of the last kind of minds (of two, the published ones)\n\n",
        );
        if let Some(steps) = self.autocorrelation_time {
            text += &format!(
                "integrated autocorrelation time of the log likelihood ratios: {steps:.2} steps, so κ = {:.3}\n\n",
                1.0 / steps
            );
        }
        text += &format!(
            "{:<26} {:>6} {:>6} {:>10} {:>7} {:>9} {:>8} {:>8} {:>6} {:>8} {:>6} {:>6}\n",
            "fit",
            "κ",
            "a",
            "ε",
            "events",
            "log post",
            "log rel",
            "relation",
            "goals",
            "named",
            "wrong",
            "last"
        );
        let of = |grid: &Grid, events: &[usize], weights: &Weights| -> Vec<Answer> {
            events.iter().filter_map(|&event| grid.answer(event, weights).copied()).collect()
        };
        let all = |grid: &Grid| -> Vec<usize> { (0..grid.len()).collect() };
        let mut held_out = Vec::new();
        for (k, fold) in self.folds.iter().enumerate() {
            let answers = of(self.grid, &fold.validation, &fold.weights);
            text += &row(&format!("without fold {}, on it", k + 1), Some(&fold.weights), &answers);
            held_out.extend(answers);
        }
        text += &row("held out, all folds", None, &held_out);
        let planning = self.grid.fit_among(&all(self.grid), Weights::is_planning_alone);
        let network = self.grid.fit_among(&all(self.grid), Weights::is_network_alone);
        for (name, weights) in [
            ("present, all events", &self.present),
            ("fitted to all, on them", &self.fitted),
            ("(planning alone)", &planning),
            ("(network alone)", &network),
        ] {
            text += &row(name, Some(weights), &of(self.grid, &all(self.grid), weights));
        }
        for (file, grid) in self.held_out {
            text += &format!("\n{file}, to which nothing is fitted\n");
            for (name, weights) in [
                ("present", &self.present),
                ("fitted", &self.fitted),
                ("(planning alone)", &planning),
                ("(network alone)", &network),
            ] {
                text += &row(name, Some(weights), &of(grid, &all(grid), weights));
            }
            let best = grid.fit(&all(grid));
            text += &row("(fitted to these)", Some(&best), &of(grid, &all(grid), &best));
        }
        text
    }
}

fn row(name: &str, weights: Option<&Weights>, answers: &[Answer]) -> String {
    let number = |get: &dyn Fn(&Answer) -> f64| mean(&answers.iter().map(get).collect::<Vec<_>>());
    let show = |value: Option<f64>, width: usize| {
        value.map_or_else(|| format!("{:>width$}", "-"), |value| format!("{value:>width$.3}"))
    };
    let social: Vec<_> = answers.iter().filter_map(|it| it.recognition.social).collect();
    let named = social.iter().filter(|it| it.named).count();
    let wrong = social.iter().filter(|it| it.wrong > 0.9).count();
    let rates =
        |weights: &Weights| weights.lapse_rates.iter().map(f64::to_string).collect::<Vec<_>>().join("/");
    let weights = weights.map_or_else(
        || format!("{:>6} {:>6} {:>10}", "", "", ""),
        |it| format!("{:>6} {:>6} {:>10}", it.inverse_temperature, it.exponent, rates(it)),
    );
    format!(
        "{name:<26} {weights} {:>7} {} {} {} {} {:>8} {wrong:>6} {}\n",
        answers.len(),
        show(number(&|it| it.recognition.log_posterior), 9),
        show(number(&|it| libm::log(it.recognition.relation.max(f64::MIN_POSITIVE))), 8),
        show(number(&|it| f64::from(u8::from(it.recognition.relation_right))), 8),
        show(number(&|it| 0.5 * it.recognition.goals_right as f64), 6),
        format!("{named} of {}", social.len()),
        show(number(&|it| it.last_kind), 6),
    )
}
