//! SIMPLE and its variants as methods to be measured.

use phase_eval::{
    Forecaster, Recogniser,
    method::{Answered, MethodError, Tick},
};
use phase_event::ObservedEvent;
use phase_model::{Forecast, Judgement};
use phase_simple::{
    AnyStrength, ChainSettings, ForecastSettings, Inference, Proposal, Settings, Stage, StrengthRegressor,
    Update, forecast, infer,
};
use serde_json::{Value, json};

/// Hypotheses kept with an answer.
const KEPT: usize = 12;

/// SIMPLE with some settings.
#[derive(Clone, Copy, Debug)]
pub struct Simple {
    settings: Settings,
    forecast: ForecastSettings,
}

impl Simple {
    /// The variant of a name: `simple` is inverse planning, the default; `simple-initial`, `simple-global` and
    /// `simple-local` are Algorithm 2 of the paper and its ablation, over simulations that are put back to the event now
    /// and then; `simple-published` is Algorithm 2 with simulations that never are. `None` for other names.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let algorithm_2 = |update| Settings::chains(ChainSettings::anchored(update));
        let settings = match name {
            "simple" => Settings::default(),
            "simple-initial" => algorithm_2(Update::Initial),
            "simple-global" => algorithm_2(Update::Global),
            "simple-local" => algorithm_2(Update::Local),
            "simple-published" => Settings::published(),
            _ => return None,
        };
        Some(Self { settings, forecast: ForecastSettings::default() })
    }

    fn infer(&self, stage: &Stage<'_>, seed: u64, tick: Tick<'_>) -> Result<Option<Inference>, MethodError> {
        let strengths = StrengthRegressor::shipped().map_err(MethodError::new)?;
        infer(stage, &strengths, seed, &self.settings, tick).map_err(MethodError::new)
    }
}

impl Recogniser for Simple {
    fn settings(&self) -> Value {
        json!(self.settings)
    }

    fn ticks(&self) -> usize {
        self.settings.ticks()
    }

    fn judge(&self, observed: &ObservedEvent, seed: u64, tick: Tick<'_>) -> Answered<Judgement> {
        let stage = Stage::new(observed, self.settings.minds, seed);
        let inference = self.infer(&stage, seed, tick)?;
        Ok(inference.map(|inference| (inference.posterior.judgement(), details(&inference))))
    }
}

impl Forecaster for Simple {
    fn settings(&self) -> Value {
        json!({ "inference": self.settings, "forecast": self.forecast })
    }

    fn ticks(&self) -> usize {
        self.settings.ticks() + self.forecast.hypotheses * self.forecast.repeats
    }

    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        seed: u64,
        tick: Tick<'_>,
    ) -> Answered<Forecast> {
        let stage = Stage::new(observed, self.settings.minds, seed);
        let Some(inference) = self.infer(&stage, seed, &mut *tick)? else { return Ok(None) };
        let forecast =
            forecast(&stage, &inference, steps, seed, &self.forecast, tick).map_err(MethodError::new)?;
        Ok(forecast.map(|forecast| (forecast, details(&inference))))
    }
}

/// What motion alone suggests, without any simulation: the first proposals of SIMPLE, all of them.
#[derive(Clone, Copy, Debug)]
pub struct Cue;

impl Recogniser for Cue {
    fn judge(&self, observed: &ObservedEvent, _seed: u64, _tick: Tick<'_>) -> Answered<Judgement> {
        let whole = 0..=observed.steps();
        let proposal = Proposal::new(observed, whole, Settings::default().gamma, &AnyStrength);
        Ok(Some((proposal.posterior().judgement(), Value::Null)))
    }
}

fn details(inference: &Inference) -> Value {
    let hypothesis = |(hypothesis, weight): &(_, f64)| json!({ "hypothesis": hypothesis, "weight": weight });
    let hypotheses: Vec<Value> = inference.posterior.hypotheses.iter().take(KEPT).map(hypothesis).collect();
    json!({ "hypotheses": hypotheses, "accepted": inference.accepted, "simulated": inference.simulated })
}
