//! The prediction of people's reports from an impression.

use crate::impression::{HAPPENINGS, Impression};
use phase_model::RelationProbabilities;
use phase_statistics::softmax;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The value of the field `format` of a file.
pub const REPORT_MODEL_FORMAT: &str = "phase-report-model/1";
/// Number of features of an impression.
pub const REPORT_FEATURES: usize = HAPPENINGS + 1;
/// Number of reports: friendly, adversarial, neutral.
pub const REPORTS: usize = 3;
/// Added to the probability of what goes on before its logarithm is taken: below it, people do not tell
/// apart.
const FLOOR: f64 = 0.02;

/// The features of an impression: the logarithm of how likely each happening was on the way, and the extent
/// to which the agents had to do with each other.
#[must_use]
pub fn report_features(impression: &Impression) -> [f64; REPORT_FEATURES] {
    let logs = impression.happenings.map(|share| libm::log(share + FLOOR));
    let mut features = logs.into_iter().chain([impression.interaction.involvement()]);
    core::array::from_fn(|_| features.next().unwrap_or_default())
}

/// P(report | impression): multinomial logistic regression on standardised [`report_features`], fitted to
/// people's reports by `cargo xtask fit-reports`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReportModel {
    /// [`REPORT_MODEL_FORMAT`].
    pub format: String,
    /// Mean of each feature.
    pub means: [f64; REPORT_FEATURES],
    /// Standard deviation of each feature, above 0.
    pub deviations: [f64; REPORT_FEATURES],
    /// Weight of each standardised feature for the reports friendly, adversarial and neutral.
    pub weights: [[f64; REPORT_FEATURES]; REPORTS],
    /// Intercepts of the same.
    pub intercepts: [f64; REPORTS],
}

/// Why a file of a model cannot be used.
#[derive(Debug, Error)]
pub enum ReportModelError {
    /// It is not JSON of this form.
    #[error("no {REPORT_MODEL_FORMAT}")]
    Json(#[from] serde_json::Error),
    /// Its format is another.
    #[error("`format` must be {REPORT_MODEL_FORMAT:?}")]
    Format,
    /// A number is not finite, or a deviation is not above 0.
    #[error("numbers must be finite, and `deviations` above 0")]
    Number,
}

impl ReportModel {
    /// The weights fitted to the raters of the shared recordings (docs/explanation/simple.md).
    pub const BUNDLED: &'static str = phase_data::REPORT_MODEL;

    /// The model that comes with the program.
    ///
    /// # Errors
    /// [`ReportModelError`] if the program was built with a damaged file.
    pub fn bundled() -> Result<Self, ReportModelError> {
        Self::from_json(Self::BUNDLED)
    }

    /// Reads a model.
    ///
    /// # Errors
    /// [`ReportModelError`].
    pub fn from_json(text: &str) -> Result<Self, ReportModelError> {
        let model: Self = phase_model::json::parse_as(text)?;
        if model.format != REPORT_MODEL_FORMAT {
            return Err(ReportModelError::Format);
        }
        let weights = model.weights.iter().flatten();
        let numbers = model.means.iter().chain(&model.deviations).chain(weights).chain(&model.intercepts);
        let sound = numbers.into_iter().all(|number| number.is_finite());
        if !sound || model.deviations.iter().any(|deviation| *deviation <= 0.0) {
            return Err(ReportModelError::Number);
        }
        Ok(model)
    }

    /// The share of people who would report each relation.
    #[must_use]
    pub fn reports(&self, impression: &Impression) -> RelationProbabilities {
        let features = report_features(impression);
        let standardised: [f64; REPORT_FEATURES] =
            core::array::from_fn(|k| (features[k] - self.means[k]) / self.deviations[k]);
        let logits: [f64; REPORTS] = core::array::from_fn(|report| {
            let weighted = self.weights[report].iter().zip(&standardised).map(|(weight, it)| weight * it);
            self.intercepts[report] + weighted.sum::<f64>()
        });
        let [friendly, adversarial, neutral] = softmax(logits);
        RelationProbabilities { friendly, adversarial, neutral }
    }
}
