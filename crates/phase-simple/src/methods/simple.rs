//! SIMPLE and its variants as methods.

use super::variants::{VARIANTS, Variant};
use crate::{
    Algorithm, AlternativeAgents, BeliefEvidence, Cues, ForecastSettings, Guidance, Guide, ImaginedAgents,
    Inference, InferenceError, InferenceSettings, IntentBeliefEvidence, InversePlanningSettings,
    KnowledgeOfGoal, KnowledgeSettings, MindPosterior, Models, ModelsError, NeutralKnowledge, Observer,
    ObserverError, PreparedEvent, believed, futures, infer, knowledge,
};
use core::ops::ControlFlow;
use phase_event::{
    BeliefOrder, BeliefReader, Beliefs, Forecaster, MethodError, MethodResult, ObservedEvent, Prediction,
    ProgressCallback, Recogniser, SAMPLES,
};
use phase_minds::{MindKind, Recorder};
use phase_model::{AGENT_COUNT, AgentId, Intent, Judgement};
use serde_json::{Value, json};
use std::{collections::BTreeMap, sync::Arc};

/// Hypotheses kept with an answer.
const REPORTED_HYPOTHESES: usize = 12;

/// SIMPLE with some settings, as a method for both tasks and as the maker of observers.
///
/// The command line, Python and the browser all ask this type, so that `simple` names one method everywhere.
///
/// ```
/// use phase_simple::{Models, Simple};
/// use std::sync::Arc;
///
/// let models = Arc::new(Models::bundled()?);
/// assert_eq!(Simple::NAMES[0], "simple");
/// assert!(Simple::NAMES.iter().all(|name| Simple::named(name, &models).is_some()));
/// # Ok::<(), phase_simple::ModelsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Simple {
    settings: InferenceSettings,
    forecast: ForecastSettings,
    knowledge: KnowledgeSettings,
    /// The weight of the intent network's guess, if it guides.
    guidance: Option<Guidance>,
    models: Arc<Models>,
}

impl Simple {
    /// The names of all variants; `docs/explanation/simple.md` describes them.
    pub const NAMES: [&str; VARIANTS.len()] = {
        let mut names = [""; VARIANTS.len()];
        let mut place = 0;
        while place < names.len() {
            names[place] = VARIANTS[place].name;
            place += 1;
        }
        names
    };

    /// SIMPLE with these settings. With a guidance, the intent network of the models guides inverse planning.
    #[must_use]
    pub fn new(settings: InferenceSettings, guidance: Option<Guidance>, models: &Arc<Models>) -> Self {
        let (forecast, knowledge) = (ForecastSettings::default(), KnowledgeSettings::default());
        Self { settings, forecast, knowledge, guidance, models: Arc::clone(models) }
    }

    /// The method `simple`, the first of [`Simple::NAMES`], with the models that come with the program.
    ///
    /// # Errors
    /// [`ModelsError`] if the program was built with a damaged file.
    pub fn bundled() -> Result<Self, ModelsError> {
        Ok(Self::of(&VARIANTS[0], &Arc::new(Models::bundled()?)))
    }

    /// The variant of a name.
    ///
    /// - `simple` is inverse planning that averages over both kinds of minds, guided by the intent network;
    ///   `simple-knowledge` also averages over whether helpers and hinderers know the other's goal;
    ///   `simple-unguided` lacks the network, and in `simple-points` the minds plan as if bodies passed
    ///   through each other.
    /// - `simple-initial`, `simple-global` and `simple-local` are Algorithm 2 of the paper and its ablation,
    ///   over simulations by our own minds that are periodically resynchronised with the observed event.
    /// - `simple-published` is Algorithm 2 whole, with the published simulator's minds and simulations that
    ///   are not resynchronised; `simple-published-global` and `simple-published-initial` are its ablation,
    ///   and `simple-published-dynamics` has strengths from inverse dynamics in place of the network's.
    ///
    /// `None` for a name that is not among [`Simple::NAMES`].
    #[must_use]
    pub fn named(name: &str, models: &Arc<Models>) -> Option<Self> {
        let variant = VARIANTS.iter().find(|variant| variant.name == name)?;
        Some(Self::of(variant, models))
    }

    /// SIMPLE with minds of one kind in all its simulations, or the kind that it has if none is given.
    /// `recorder` adds defects to their bodies, and `original_random` gives published minds the random
    /// numbers of the original, and its number of simulations.
    #[must_use]
    pub fn with_minds(mut self, kind: Option<MindKind>, recorder: Recorder, original_random: bool) -> Self {
        if let Some(kind) = kind {
            // The weights of an average over kinds are not those of one kind alone.
            let latent_knowledge = self.settings.latent_knowledge;
            let alone = InferenceSettings { latent_knowledge, ..InferenceSettings::default() };
            let settings = if self.settings.alternative.is_some() { alone } else { self.settings };
            let agents = self.settings.agents;
            let imagined = if agents.minds.asks_network() {
                ImaginedAgents::of(kind)
            } else {
                ImaginedAgents::searching(kind)
            };
            let one_kind = agents.with_minds(imagined.minds);
            self.settings = settings.with_agents(one_kind);
            if !agents.minds.foresees_collisions() {
                self.settings = self.settings.without_collisions();
            }
        }
        let record = |agents: &mut ImaginedAgents| {
            agents.minds = agents.minds.as_recorded(original_random, agents.strongest_coasts);
            if original_random {
                agents.minds = agents.minds.searching_as_original();
            }
        };
        let agents = &mut self.settings.agents;
        agents.one_way_turns |= recorder.one_way_turns;
        agents.strongest_coasts |= recorder.strongest_coasts;
        record(agents);
        if let Some(AlternativeAgents { agents, .. }) = &mut self.settings.alternative {
            record(agents);
        }
        self
    }

    /// SIMPLE whose imagined minds all search, and make so many simulations a decision, in the range
    /// [`phase_minds::SIMULATIONS`].
    #[must_use]
    pub const fn with_simulations(mut self, simulations: usize) -> Self {
        let agents = &mut self.settings.agents;
        agents.minds = agents.minds.with_simulations(simulations);
        if let Some(AlternativeAgents { agents, .. }) = &mut self.settings.alternative {
            agents.minds = agents.minds.with_simulations(simulations);
        }
        self
    }

    /// Begins to watch an event row by row; `observed` has the rows seen so far, at least one.
    ///
    /// # Errors
    /// [`ObserverError::Chains`] for a variant of Algorithm 2, which simulates whole events.
    pub fn observer(&self, observed: &ObservedEvent, seed: u64) -> Result<Observer, ObserverError> {
        Observer::new(observed, self.guide().as_ref(), seed, &self.settings)
    }

    /// Prepares an event for [`Simple::infer`] and [`futures`]: infers its actions, and the observations and
    /// beliefs that each agent can have had.
    #[must_use]
    pub fn prepare(&self, observed: &ObservedEvent, seed: u64) -> PreparedEvent {
        PreparedEvent::new(observed, self.settings.agents, seed)
    }

    /// Infers what explains a prepared event; `None` if `tick` cancelled it.
    ///
    /// # Errors
    /// [`InferenceError`].
    pub fn infer(
        &self,
        prepared: &PreparedEvent,
        seed: u64,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Inference>, InferenceError> {
        let cues = Cues { strengths: &self.models.strengths, guide: self.guide() };
        infer(prepared, &cues, seed, &self.settings, tick)
    }

    /// The answer to Task 1 that an inference gives, with people's predicted reports.
    #[must_use]
    pub fn judgement(&self, inference: &Inference) -> Judgement {
        inference.judgement(&self.models.reports)
    }

    fn of(variant: &Variant, models: &Arc<Models>) -> Self {
        Self::new((variant.settings)(), variant.guided.then(Guidance::default), models)
    }

    fn guide(&self) -> Option<Guide> {
        self.guidance.map(|guidance| Guide { network: Arc::clone(&self.models.intents), guidance })
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
        let prepared = self.prepare(observed, seed);
        let inference = self.infer(&prepared, seed, tick).map_err(MethodError::new)?;
        Ok(inference.map(|inference| (self.judgement(&inference), details(&prepared, &inference))))
    }
}

impl Simple {
    /// The evidence that the motion of an event gives about its agents' beliefs of an order after some steps,
    /// with details of the inference; `None` if `tick` cancelled it. Goals are those of the likeliest
    /// hypothesis.
    ///
    /// # Errors
    /// [`MethodError`] if nothing explains the event.
    pub fn belief_evidence(
        &self,
        observed: &ObservedEvent,
        order: BeliefOrder,
        steps: &[usize],
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<BeliefEvidence> {
        let prepared = self.prepare(observed, seed);
        let inference = self.infer(&prepared, seed, &mut *tick).map_err(MethodError::new)?;
        let Some(inference) = inference else { return Ok(None) };
        let Some((likeliest, _)) = inference.posterior.hypotheses.first() else {
            return Err(MethodError::new("has no explanation"));
        };
        let prepared = with_our_minds(prepared);
        let planning = match self.settings.algorithm {
            Algorithm::InversePlanning(planning) => planning,
            Algorithm::Chains(_) => InversePlanningSettings::default(),
        };
        let evidence = knowledge::evidence(&prepared, likeliest, (order, steps), &planning, &mut *tick);
        let evidence = evidence.map_err(MethodError::new)?;
        Ok(evidence.map(|evidence| (evidence, details(&prepared, &inference))))
    }

    /// The evidence that the motion of an event gives about the intents that each agent takes the other to
    /// have after some steps; `None` if `tick` cancelled it. A variant without latent knowledge takes every
    /// agent to know what the other wants.
    ///
    /// # Errors
    /// [`MethodError`] if the inference fails.
    pub fn intent_belief_evidence(
        &self,
        observed: &ObservedEvent,
        steps: &[usize],
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<IntentBeliefEvidence> {
        let prepared = self.prepare(observed, seed);
        let inference = self.infer(&prepared, seed, tick).map_err(MethodError::new)?;
        Ok(inference.map(|inference| {
            let prepared = with_our_minds(prepared);
            (believed::evidence(&prepared, &inference, steps), details(&prepared, &inference))
        }))
    }

    /// The intents that each agent takes the other to have after some steps of an event, with their
    /// probabilities; `None` if `tick` cancelled it.
    ///
    /// # Errors
    /// [`MethodError`] if the inference fails.
    pub fn believed_intents(
        &self,
        observed: &ObservedEvent,
        steps: &[usize],
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Vec<[BTreeMap<Intent, f64>; AGENT_COUNT]>> {
        let found = self.intent_belief_evidence(observed, steps, seed, tick)?;
        Ok(found.map(|(evidence, details)| (evidence.intents(&NeutralKnowledge::default()), details)))
    }
}

/// An event with our own minds in place of published ones, which have no other senses than their own and
/// infer no intents.
fn with_our_minds(prepared: PreparedEvent) -> PreparedEvent {
    match prepared.agents().minds.kind() {
        MindKind::Phase => prepared,
        MindKind::Published => prepared.with_agents(ImaginedAgents::of(MindKind::Phase)),
    }
}

impl BeliefReader for Simple {
    fn settings(&self) -> Value {
        json!({ "inference": Recogniser::settings(self), "knowledge": self.knowledge })
    }

    fn ticks(&self) -> usize {
        self.settings.ticks()
    }

    /// The particles of minds that explain the motion, averaged over what each agent may know of objects
    /// beside what it sees.
    fn read_beliefs(
        &self,
        observed: &ObservedEvent,
        order: BeliefOrder,
        steps: &[usize],
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Vec<Beliefs>> {
        let found = self.belief_evidence(observed, order, steps, seed, tick)?;
        Ok(found.map(|(evidence, mut details)| {
            let knows = AgentId::ALL.map(|agent| {
                let [own, start, objects] = evidence.knowledge(agent, &self.knowledge);
                json!({ "own": own, "start": start, "objects": objects })
            });
            details["sees"] = json!(knows);
            (evidence.beliefs(&self.knowledge), details)
        }))
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
        let prepared = self.prepare(observed, seed);
        let inference = self.infer(&prepared, seed, &mut *tick).map_err(MethodError::new)?;
        let Some(inference) = inference else { return Ok(None) };
        let futures =
            futures(&prepared, &inference, steps, seed, &self.forecast, tick).map_err(MethodError::new)?;
        Ok(futures.map(|futures| {
            let prediction = Prediction { forecast: futures.median(), samples: futures.draw(SAMPLES, seed) };
            (prediction, details(&prepared, &inference))
        }))
    }
}

/// An agent's knowledge of the other's goal, with the likeliest of what it takes the other to want.
fn described(KnowledgeOfGoal { social, knows, levels, believed }: &KnowledgeOfGoal) -> Value {
    let mut intents: Vec<(&Intent, &f64)> = believed.iter().collect();
    intents.sort_by(|a, b| b.1.total_cmp(a.1));
    let intent = |(intent, probability): (&Intent, &f64)| {
        let words = intent.to_string();
        json!({
            "alpha": intent.attitude.alpha(), "goal": intent.goal, "words": words, "probability": probability,
        })
    };
    let intents: Vec<Value> = intents.into_iter().map(intent).collect();
    json!({ "social": social, "knows": knows, "levels": levels, "believed": intents })
}

fn details(prepared: &PreparedEvent, inference: &Inference) -> Value {
    let hypothesis = |(hypothesis, weight): &(_, f64)| json!({ "hypothesis": hypothesis, "weight": weight });
    let hypotheses: Vec<Value> =
        inference.posterior.hypotheses.iter().take(REPORTED_HYPOTHESES).map(hypothesis).collect();
    let kind = |kind: &MindPosterior| {
        let name = kind.agents.minds.kind().name();
        json!({ "kind": name, "probability": kind.probability })
    };
    let minds: Vec<Value> = inference.minds.iter().map(kind).collect();
    let mut details = json!({
        "hypotheses": hypotheses,
        "minds": minds,
        "impression": inference.impression,
        "accepted": inference.accepted,
        "simulated": inference.simulated,
    });
    if let Some(knowledge) = &inference.knowledge {
        details["knowledge"] = knowledge.iter().map(described).collect();
    }
    if prepared.observed().noise().is_some() {
        let motion = prepared.motion();
        let steps = motion.residuals.len();
        let explained = motion.explained().filter(|explained| *explained).count();
        details["motion"] = json!({
            "error": motion.error_up_to(steps),
            "explained": explained as f64 / steps.max(1) as f64,
            "foreign": inference.foreign,
        });
    }
    details
}
