//! The fitted models that SIMPLE comes with.

use crate::{
    IntentNetwork, ReportModel, ReportModelError, StrengthRegressor, intent_network::IntentNetworkError,
    strength::WeightsError,
};
use std::sync::Arc;
use thiserror::Error;

/// The reason why the models that come with the program cannot be used.
#[derive(Debug, Error)]
pub enum ModelsError {
    /// The strength regressor's file is damaged.
    #[error("data/strength.safetensors")]
    Strengths(#[from] WeightsError),
    /// The intent network's file is damaged.
    #[error("data/intent-network.safetensors")]
    Intents(#[from] IntentNetworkError),
    /// The report model's file is damaged.
    #[error("data/report-model.json")]
    Reports(#[from] ReportModelError),
}

/// The fitted models that SIMPLE uses.
///
/// Their files are parsed when this is made, and never again: methods and observers share one instance
/// behind an [`Arc`].
///
/// ```
/// use phase_simple::{Models, Simple};
/// use std::sync::Arc;
///
/// let models = Arc::new(Models::bundled()?);
/// assert!(Simple::named("simple", &models).is_some());
/// # Ok::<(), phase_simple::ModelsError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Models {
    /// The proposal of strengths, for Algorithm 2.
    pub strengths: StrengthRegressor,
    /// The guide of inverse planning.
    pub intents: Arc<IntentNetwork>,
    /// The prediction of people's reports.
    pub reports: ReportModel,
}

impl Models {
    /// Parses the models that come with the program.
    ///
    /// # Errors
    /// [`ModelsError`] if the program was built with a damaged file.
    pub fn bundled() -> Result<Self, ModelsError> {
        Ok(Self {
            strengths: StrengthRegressor::bundled()?,
            intents: Arc::new(IntentNetwork::bundled()?),
            reports: ReportModel::bundled()?,
        })
    }
}
