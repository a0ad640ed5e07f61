//! The initial proposals of SIMPLE as a method of their own.

use crate::{InferenceSettings, Proposal, UniformStrength};
use phase_event::{MethodResult, ObservedEvent, ProgressCallback, Recogniser};
use phase_model::Judgement;
use serde_json::Value;

/// The initial proposals of SIMPLE from motion alone, all of them, without any simulation.
#[derive(Clone, Copy, Debug)]
pub struct MotionCue;

impl Recogniser for MotionCue {
    fn judge(
        &self,
        observed: &ObservedEvent,
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        let whole = 0..=observed.steps();
        let proposal = Proposal::new(observed, whole, InferenceSettings::default().gamma, &UniformStrength);
        Ok(Some((proposal.posterior().judged(observed).judgement(), Value::Null)))
    }
}
