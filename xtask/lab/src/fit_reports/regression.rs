//! Multinomial logistic regression of reports on impressions, one row for each rater.

use phase_eval::ratings::RatingCounts;
use phase_simple::{
    Impression, ReportModel,
    report_model::{REPORT_FEATURES, REPORT_MODEL_FORMAT, REPORTS, report_features},
};
use phase_statistics::{mean, population_variance};
use smartcore::{
    error::Failed,
    linalg::basic::{arrays::Array, matrix::DenseMatrix},
    linear::logistic_regression::{LogisticRegression, LogisticRegressionParameters},
};

/// An event: what it looked like, and how people reported it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rated {
    pub(super) impression: Impression,
    pub(super) counts: RatingCounts,
}

/// Fits the model to some events. `ridge` is the weight of the sum of squared weights beside the log
/// likelihood of all raters.
pub(super) fn fit(events: &[Rated], ridge: f64) -> Result<ReportModel, Failed> {
    let features: Vec<[f64; REPORT_FEATURES]> =
        events.iter().map(|event| report_features(&event.impression)).collect();
    let column = |k: usize| features.iter().map(|it| it[k]).collect::<Vec<f64>>();
    let means: [f64; REPORT_FEATURES] = core::array::from_fn(|k| mean(&column(k)).unwrap_or_default());
    let deviations: [f64; REPORT_FEATURES] = core::array::from_fn(|k| {
        let variance = population_variance(&column(k)).unwrap_or_default();
        // A feature that is the same everywhere tells nothing, whatever its scale.
        if variance > 0.0 { libm::sqrt(variance) } else { 1.0 }
    });
    let mut rows = Vec::new();
    let mut reports = Vec::new();
    for (event, features) in events.iter().zip(&features) {
        let row: Vec<f64> = (0..REPORT_FEATURES).map(|k| (features[k] - means[k]) / deviations[k]).collect();
        for (report, raters) in event.counts.counts().into_iter().enumerate() {
            for _ in 0..raters {
                rows.push(row.clone());
                reports.push(report as u32);
            }
        }
    }
    let rows = DenseMatrix::from_2d_vec(&rows)?;
    let parameters = LogisticRegressionParameters::default().with_alpha(ridge);
    let fitted = LogisticRegression::fit(&rows, &reports, parameters)?;
    if fitted.classes().len() != REPORTS {
        return Err(Failed::fit("every relation must have been reported by somebody"));
    }
    let weights = fitted.coefficients();
    let intercepts = fitted.intercept();
    Ok(ReportModel {
        format: REPORT_MODEL_FORMAT.into(),
        means,
        deviations,
        weights: core::array::from_fn(|report| core::array::from_fn(|k| *weights.get((report, k)))),
        intercepts: core::array::from_fn(|report| *intercepts.get((report, 0))),
    })
}

#[cfg(test)]
mod tests {
    use super::{Rated, fit};
    use phase_eval::ratings::RatingCounts;
    use phase_simple::{Impression, Interaction};

    /// Reports that follow what goes on are predicted; with a great ridge only their frequencies are.
    #[test]
    fn what_reports_follow_is_found() {
        let rated = |k: usize| {
            let mut happenings = [0.01; 6];
            happenings[[0, 1, 5][k % 3]] = 0.95;
            let mut counts = [1; 3];
            counts[k % 3] = 8;
            let [friendly, adversarial, neutral] = counts;
            let counts = RatingCounts { friendly, adversarial, neutral };
            Rated { impression: Impression { happenings, interaction: Interaction::default() }, counts }
        };
        let events: Vec<Rated> = (0..30).map(rated).collect();
        let said = |ridge, k: usize| fit(&events, ridge).expect("a fit").reports(&events[k].impression);
        assert!((said(1e-3, 0).friendly - 0.8).abs() < 0.01, "{:?}", said(1e-3, 0));
        assert!((said(1e-3, 1).adversarial - 0.8).abs() < 0.01);
        assert!((said(1e-3, 2).neutral - 0.8).abs() < 0.01);
        assert!((said(1e6, 0).friendly - 1.0 / 3.0).abs() < 0.01);
    }
}
