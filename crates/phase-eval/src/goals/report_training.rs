//! The record of how a model of people's reports was fitted.

use super::{Agreement, RecognitionSummary};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The value of the field `format` of a record.
pub const REPORT_TRAINING_FORMAT: &str = "phase-report-training/1";

/// Relation of reports that a method predicts to the ratings that they are compared with.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Protocol {
    /// Nothing was fitted to these ratings.
    #[default]
    Unfitted,
    /// The model was fitted to these very ratings.
    InSample,
    /// The ratings of each event were left out of the fit of the model that predicts them.
    HeldOut {
        /// Number of parts into which the events were divided, each left out of one fit.
        folds: usize,
    },
}

/// Events to whose ratings a model of reports was fitted, and how closely its reports agree with them.
///
/// It comes with the model, so that an evaluation of these events can say that the model knows their ratings,
/// and show the agreement of models that did not know them.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReportTraining {
    /// Always [`REPORT_TRAINING_FORMAT`].
    pub format: String,
    /// Digest of the events, as `run.events_sha256` of an evaluation.
    pub events_sha256: String,
    /// Seed of the division into folds and of the intervals.
    pub seed: u64,
    /// Agreement of the model, with [`Protocol::InSample`].
    pub in_sample: Agreement,
    /// Agreement of models that did not see the event, with [`Protocol::HeldOut`].
    pub held_out: Agreement,
}

/// Disagreement of an evaluation with the record of the model that predicted its reports.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum ProtocolError {
    /// Figures of the model itself have another label than in-sample.
    #[error("agreement of a model with the ratings that it was fitted to must be labelled in-sample")]
    InSample,
    /// Figures in the place of those held out are labelled otherwise, or are not those of the record.
    #[error("`held_out_agreement` must be that of the record of the fit, labelled held-out")]
    HeldOut,
}

impl ReportTraining {
    /// Labels the agreement of the model's reports with the ratings that it was fitted to, and adds that of
    /// folds held out if all of the events were evaluated. `events_sha256` is the digest of the events of the
    /// summary.
    pub fn label(&self, summary: &mut RecognitionSummary, events_sha256: &str) {
        // Only where reports are predicted beside the posterior is there one for itself.
        if events_sha256 != self.events_sha256 || summary.relation_agreement.is_none() {
            return;
        }
        let Some(agreement) = &mut summary.agreement else { return };
        agreement.protocol = Protocol::InSample;
        let whole = (agreement.n, agreement.ratings) == (self.held_out.n, self.held_out.ratings);
        summary.held_out_agreement = whole.then(|| self.held_out.clone());
    }

    /// Checks that no agreement in a summary is labelled as something else than it is.
    ///
    /// # Errors
    /// [`ProtocolError`] for the first that is.
    pub fn check(&self, summary: &RecognitionSummary) -> Result<(), ProtocolError> {
        let same = |one: &Agreement, other: &Agreement| {
            let of = |it: &Agreement| Agreement { protocol: Protocol::default(), ..it.clone() };
            of(one) == of(other)
        };
        if let Some(held_out) = &summary.held_out_agreement {
            let labelled = matches!(held_out.protocol, Protocol::HeldOut { .. });
            let own = summary.agreement.as_ref().is_some_and(|own| same(own, held_out));
            if !labelled || own || *held_out != self.held_out {
                return Err(ProtocolError::HeldOut);
            }
        }
        // Figures held out stand beside those of the model itself, even where these differ a little from the
        // record's, since answers have changed.
        let fitted_here = summary.held_out_agreement.is_some();
        let own = summary.agreement.iter().map(|it| (it, fitted_here));
        let mut others = own.chain(summary.relation_agreement.iter().map(|it| (it, false)));
        let wrong = |(it, fitted): (&Agreement, bool)| match it.protocol {
            Protocol::InSample => false,
            Protocol::HeldOut { .. } => true,
            Protocol::Unfitted => fitted || same(it, &self.in_sample),
        };
        if others.any(wrong) { Err(ProtocolError::InSample) } else { Ok(()) }
    }
}
