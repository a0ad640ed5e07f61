//! SIMPLE and its variants as methods to be evaluated.

use crate::effort::MindOptions;
use phase_eval::{
    Forecaster, Recogniser,
    method::{MethodError, MethodResult, ProgressCallback},
    trajectories::{Prediction, SAMPLES},
};
use phase_event::ObservedEvent;
use phase_model::Judgement;
use phase_simple::{
    ChainSettings, Cues, ForecastSettings, Guidance, Guide, ImaginedAgents, Inference, InferenceSettings,
    IntentNetwork, MindPosterior, PreparedEvent, Proposal, ReportModel, StrengthRegressor, StrengthSource,
    UniformStrength, Update, futures, infer,
};
use serde_json::{Value, json};

/// Hypotheses kept with an answer.
const REPORTED_HYPOTHESES: usize = 12;

/// SIMPLE with some settings.
#[derive(Clone, Copy, Debug)]
pub struct Simple {
    settings: InferenceSettings,
    forecast: ForecastSettings,
    /// How the bundled intent network guides it, if it does.
    guidance: Option<Guidance>,
}

impl Simple {
    /// The variant of a name: `simple` is inverse planning that averages over both kinds of minds and is guided by the intent
    /// network, `simple-unguided` the same without the network, `simple-points` that over minds that plan as if bodies passed
    /// through each other; `simple-initial`,
    /// `simple-global` and `simple-local` are Algorithm 2 of the paper and its ablation, over simulations by our own
    /// minds that are periodically resynchronised with the observed event; `simple-published` is Algorithm 2 whole,
    /// with published minds and simulations that are not resynchronised, and `simple-published-global` and
    /// `simple-published-initial` are its ablation; `simple-published-dynamics` has strengths from inverse dynamics in place of
    /// the network's. `None` for other names.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let algorithm_2 = |update| InferenceSettings::chains(ChainSettings::resynchronised(update));
        let published = |update| InferenceSettings::published(update, StrengthSource::Network);
        let settings = match name {
            "simple" | "simple-unguided" => InferenceSettings::averaged(),
            "simple-points" => InferenceSettings::averaged().without_collisions(),
            "simple-initial" => algorithm_2(Update::Initial),
            "simple-global" => algorithm_2(Update::Global),
            "simple-local" => algorithm_2(Update::Local),
            "simple-published" => published(Update::Local),
            "simple-published-global" => published(Update::Global),
            "simple-published-initial" => published(Update::Initial),
            "simple-published-dynamics" => {
                InferenceSettings::published(Update::Local, StrengthSource::InverseDynamics)
            }
            _ => return None,
        };
        let guidance = (name == "simple").then(Guidance::default);
        Some(Self { settings, forecast: ForecastSettings::default(), guidance })
    }

    /// The same with the minds that were chosen, if any, in all its simulations.
    #[must_use]
    pub fn with_minds(mut self, options: &MindOptions) -> Self {
        if let Some(kind) = options.minds {
            // The weights of an average over kinds are not those of one kind alone.
            let alone = InferenceSettings::default();
            let settings = if self.settings.alternative.is_some() { alone } else { self.settings };
            let one_way_turns = self.settings.agents.one_way_turns;
            let alone = ImaginedAgents { one_way_turns, ..ImaginedAgents::of(kind) };
            let foresees_collisions = self.settings.agents.minds.foresees_collisions();
            self.settings = settings.with_agents(alone);
            if !foresees_collisions {
                self.settings = self.settings.without_collisions();
            }
        }
        self.settings.agents.one_way_turns |= options.one_way_turns;
        self
    }

    fn infer(
        &self,
        prepared: &PreparedEvent,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<Inference>, MethodError> {
        let strengths = StrengthRegressor::bundled().map_err(MethodError::new)?;
        let network = IntentNetwork::bundled().map_err(MethodError::new)?;
        let guide = self.guidance.map(|guidance| Guide { network: &network, guidance });
        let cues = Cues { strengths: &strengths, guide };
        infer(prepared, &cues, seed, &self.settings, tick).map_err(MethodError::new)
    }
}

impl Recogniser for Simple {
    fn settings(&self) -> Value {
        let mut settings = json!(self.settings);
        if let Some(guidance) = self.guidance {
            settings["guidance"] = json!(guidance);
        }
        settings
    }

    fn ticks(&self) -> usize {
        self.settings.ticks()
    }

    fn judge(
        &self,
        observed: &ObservedEvent,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        let prepared = PreparedEvent::new(observed, self.settings.agents, seed);
        let inference = self.infer(&prepared, seed, tick)?;
        let model = ReportModel::bundled().map_err(MethodError::new)?;
        Ok(inference.map(|inference| (inference.judgement(&model), details(&inference))))
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
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Prediction> {
        let prepared = PreparedEvent::new(observed, self.settings.agents, seed);
        let Some(inference) = self.infer(&prepared, seed, &mut *tick)? else { return Ok(None) };
        let futures =
            futures(&prepared, &inference, steps, seed, &self.forecast, tick).map_err(MethodError::new)?;
        Ok(futures.map(|futures| {
            let prediction = Prediction { forecast: futures.median(), samples: futures.draw(SAMPLES, seed) };
            (prediction, details(&inference))
        }))
    }
}

/// The initial proposals of SIMPLE from motion alone, without any simulation: all of them.
#[derive(Clone, Copy, Debug)]
pub struct Cue;

impl Recogniser for Cue {
    fn judge(
        &self,
        observed: &ObservedEvent,
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        let whole = 0..=observed.steps();
        let proposal = Proposal::new(observed, whole, InferenceSettings::default().gamma, &UniformStrength);
        Ok(Some((proposal.posterior().judgement(), Value::Null)))
    }
}

fn details(inference: &Inference) -> Value {
    let hypothesis = |(hypothesis, weight): &(_, f64)| json!({ "hypothesis": hypothesis, "weight": weight });
    let hypotheses: Vec<Value> =
        inference.posterior.hypotheses.iter().take(REPORTED_HYPOTHESES).map(hypothesis).collect();
    let kind = |kind: &MindPosterior| json!({ "kind": kind.agents.minds.kind().name(), "probability": kind.probability });
    let minds: Vec<Value> = inference.minds.iter().map(kind).collect();
    json!({
        "hypotheses": hypotheses,
        "minds": minds,
        "impression": inference.impression,
        "accepted": inference.accepted,
        "simulated": inference.simulated,
    })
}
