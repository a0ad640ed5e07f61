//! Decisions of minds with the searches that were made for them.

use super::ACTIONS;
use phase_agent::{Mind, PhaseParameters, Prior};
use phase_event::{Event, ObservedEvent, Thought};
use phase_forward::Forward;
use phase_minds::{BeliefView, MindParameters, PublishedParameters};
use phase_model::{
    Action, AgentId, Scene,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_pomcp::PomcpError;
use phase_sim::belief_view;
use phase_simple::{Hypothesis, Intent};
use rand::{RngExt, seq::IndexedRandom};

/// Added to the logits of actions that are not searched.
pub(super) const MASKED_LOGIT: f32 = -1e9;
/// Decisions of the agents of an event, and of agents with other intents, that are learnt of it.
const LEARNT: [usize; 2] = [40, 40];

/// The minds whose searches a network learns.
pub trait Searchers: Clone + PartialEq + core::fmt::Debug + Default + Send + Sync {
    /// The network's name in files.
    const NAME: &'static str;
    /// Features of a decision that its actions have in common.
    const SHARED: usize;
    /// Features of each action.
    const OF_ACTION: usize;
    /// The names of the scores: the cross-entropy of the network's policy to the shares of visits, those of
    /// other policies, the total variation of the network's, and the error of its value.
    const METRICS: &'static [&'static str];
    /// Weight of the squared error of the value (1 over the square of the reward's unit) beside the
    /// cross-entropy (nat).
    const VALUE_WEIGHT: f64;
    /// The weights that come with the program, and the record of their training.
    const BUNDLED: phase_data::Trained;

    /// The minds' parameters for whole searches, in an event whose agents have these; `None` if the event has
    /// others than these minds can be learnt from.
    fn parameters(of_event: &MindParameters) -> Option<MindParameters>;

    /// A decision of a mind of a scene on a belief, and the search that was made for it; `None` if there is
    /// nothing to choose.
    ///
    /// # Errors
    /// [`PomcpError`], if the search fails.
    fn decide(
        scene: &Scene,
        agent: AgentId,
        parameters: &MindParameters,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> core::result::Result<Option<Decision>, PomcpError>;
}

/// A decision that was searched.
#[derive(Clone, PartialEq, Debug)]
pub struct Decision {
    /// Features that all actions have in common.
    shared: Vec<f32>,
    /// The features of all fourteen actions, one after the other.
    actions: Vec<f32>,
    /// The search.
    thought: Thought,
    /// Weights that other policies give to each action that was searched, in the search's order; the uniform
    /// one is not among them.
    others: Vec<Vec<f64>>,
}

/// Our own minds.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct OurMinds;

impl Searchers for OurMinds {
    const NAME: &'static str = "policy";
    const SHARED: usize = phase_agent::policy::SHARED;
    const OF_ACTION: usize = phase_agent::policy::OF_ACTION;
    const METRICS: &'static [&'static str] = &["policy", "uniform", "heuristic", "habits", "tv", "value"];
    const VALUE_WEIGHT: f64 = 0.02;
    const BUNDLED: phase_data::Trained = phase_data::POLICY;

    /// With the event's other parameters.
    fn parameters(of_event: &MindParameters) -> Option<MindParameters> {
        let MindParameters::Phase(parameters) = *of_event else { return None };
        let parameters = PhaseParameters { prior: Prior::Habits, convergence: 0.0, ..parameters };
        Some(parameters.into())
    }

    fn decide(
        scene: &Scene,
        agent: AgentId,
        parameters: &MindParameters,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> core::result::Result<Option<Decision>, PomcpError> {
        let MindParameters::Phase(parameters) = *parameters else { return Ok(None) };
        let mut mind = Mind::new(scene, agent, Forward::new(&scene.physics()), parameters)?;
        let Some(considered) = mind.consider(belief) else { return Ok(None) };
        let (_, thought) = mind.decide(belief, random)?;
        let count = considered.actions.len() as f64;
        let heuristic =
            |action: &Action| 0.5 / count + 0.5 * f64::from(u8::from(*action == considered.heuristic));
        Ok(Some(Decision {
            shared: considered.features.shared.to_vec(),
            actions: considered.features.actions.as_flattened().to_vec(),
            thought,
            others: vec![considered.actions.iter().map(heuristic).collect(), considered.habits],
        }))
    }
}

/// Published minds with the defects of their recorder, as inference imagines them.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PublishedMinds;

impl Searchers for PublishedMinds {
    const NAME: &'static str = "published-policy";
    const SHARED: usize = phase_published::policy::SHARED;
    const OF_ACTION: usize = phase_published::policy::OF_ACTION;
    const METRICS: &'static [&'static str] = &["policy", "uniform", "tv", "value"];
    /// Returns are ten times those of our minds where a room earns a bonus.
    const VALUE_WEIGHT: f64 = 0.0002;
    const BUNDLED: phase_data::Trained = phase_data::PUBLISHED_POLICY;

    /// One search of 1000 simulations, as in the recordings, whoever made the event.
    fn parameters(_: &MindParameters) -> Option<MindParameters> {
        let recorded = PublishedParameters::default();
        Some(PublishedParameters { older_actions: true, strongest_coasts: true, ..recorded }.into())
    }

    fn decide(
        scene: &Scene,
        agent: AgentId,
        parameters: &MindParameters,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> core::result::Result<Option<Decision>, PomcpError> {
        let MindParameters::Published(parameters) = *parameters else { return Ok(None) };
        let mut mind = phase_published::Mind::new(scene, agent, parameters)?;
        let Some(considered) = mind.consider(belief.particles) else { return Ok(None) };
        let (_, thought) = mind.decide(belief.particles, random)?;
        Ok(Some(Decision {
            shared: considered.features.shared.to_vec(),
            actions: considered.features.actions.as_flattened().to_vec(),
            thought,
            others: Vec::new(),
        }))
    }
}

/// The decisions of an event that were searched.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Decisions {
    /// The shared features of each.
    pub(super) shared: Vec<f32>,
    /// The features of each action of each.
    pub(super) actions: Vec<f32>,
    /// 0 for each action that was searched, [`MASKED_LOGIT`] for the others.
    pub(super) masks: Vec<f32>,
    /// The share of visits of each action.
    pub(super) shares: Vec<f32>,
    /// The mean return of the most visited action.
    pub(super) values: Vec<f32>,
    /// Cross-entropies of the uniform policy and the others to the shares, summed (nat).
    pub(super) others: Vec<f64>,
}

impl Decisions {
    /// Decisions by minds with these parameters ([`Searchers::parameters`]) in the states of an event, on the
    /// beliefs that they would have there.
    ///
    /// # Errors
    /// [`PomcpError`], if a search fails.
    pub fn of<M: Searchers>(
        event: &Event,
        observed: &ObservedEvent,
        parameters: &MindParameters,
    ) -> core::result::Result<Self, PomcpError> {
        let beliefs = AgentId::ALL.map(|agent| phase_sim::beliefs(event, agent, parameters));
        let strengths = event.scene.agents.each_ref().map(|agent| agent.strength);
        let mut decisions = Self::default();
        let mut random = random::stream(event.seed, Purpose::Training, 0);
        let [own, others] = LEARNT.map(|count| count.min(event.steps.len()));
        for k in 0..own + others {
            let agent = AgentId::ALL[k % AgentId::ALL.len()];
            let step = random.random_range(0..event.steps.len());
            let intents = Intent::all(agent, observed.object_sizes().len());
            let intent = intents.choose(&mut random).filter(|_| k >= own);
            let scene = intent.map_or_else(
                || event.scene.clone(),
                |it| {
                    Hypothesis::of_intent(*it, agent, event.scene.goals()[agent.other()], strengths)
                        .scene(observed)
                },
            );
            let view = belief_view(event, agent, step, &beliefs[agent]);
            if let Some(decision) = M::decide(&scene, agent, parameters, view, &mut random)? {
                decisions.push(&decision);
            }
        }
        Ok(decisions)
    }

    /// Adds a decision and the search that was made for it.
    fn push(&mut self, decision: &Decision) {
        let Decision { shared, actions, thought, others } = decision;
        let visits: u32 = thought.actions.iter().map(|found| found.visits).sum();
        let Some(best) = thought.actions.iter().max_by_key(|found| found.visits) else { return };
        if visits == 0 || others.iter().any(|weights| weights.len() != thought.actions.len()) {
            return;
        }
        let mut masks = [MASKED_LOGIT; ACTIONS];
        let mut shares = [0.0; ACTIONS];
        self.others.resize(1 + others.len(), 0.0);
        for (place, found) in thought.actions.iter().enumerate() {
            let share = f64::from(found.visits) / f64::from(visits);
            masks[found.action.index()] = 0.0;
            shares[found.action.index()] = share as f32;
            let policies = others.iter().map(|weights| weights[place] / weights.iter().sum::<f64>());
            let uniform = 1.0 / thought.actions.len() as f64;
            for (sum, policy) in self.others.iter_mut().zip(core::iter::once(uniform).chain(policies)) {
                *sum -= share * libm::log(policy);
            }
        }
        self.shared.extend(shared);
        self.actions.extend(actions);
        self.masks.extend(masks);
        self.shares.extend(shares);
        self.values.push(best.value as f32);
    }
}
