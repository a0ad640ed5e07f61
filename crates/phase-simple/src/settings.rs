//! Settings of an inference.

use crate::cue::GAMMA;
use phase_minds::{MindKind, MindParameters, PublishedParameters, Recorder};
use phase_model::{
    AGENT_COUNT,
    setting::{EVENT_STEPS, RangeError, Setting},
};
use serde::{Deserialize, Serialize};

/// The source of new proposals.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Update {
    /// None: the initial proposals are kept (SIMPLE (Initial) of the ablation).
    Initial,
    /// From the whole event (SIMPLE (Global)).
    Global,
    /// From a short time window in which simulation and observation disagree (SIMPLE (Full)).
    Local,
}

/// The source of proposals of strengths.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StrengthSource {
    /// The regression network, as in the paper.
    #[default]
    Network,
    /// Inverse dynamics.
    InverseDynamics,
}

/// The algorithm that finds and weighs hypotheses.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Algorithm {
    /// All hypotheses, by what each agent would do at every step under each intent. Not in the paper.
    InversePlanning(InversePlanningSettings),
    /// Some hypotheses, by simulations of whole events: the paper's Algorithm 2.
    Chains(ChainSettings),
}

/// Settings of an inference.
///
/// The default is inverse planning with our own minds alone. [`InferenceSettings::averaged`] considers the
/// published simulator's minds too and is what the method `simple` uses; [`InferenceSettings::published`] is
/// the paper's.
///
/// An answer depends on more numbers than these: on the weights of the [`Models`](crate::Models), and on the
/// constants of inverse dynamics, of impressions and of the intent network's features, which stand in their
/// modules because the models were fitted with them.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct InferenceSettings {
    /// The algorithm that finds and weighs hypotheses.
    pub algorithm: Algorithm,
    /// γ of the goal proposal (1/u), 0 to 1000.
    pub gamma: f64,
    /// The agents in a simulation.
    pub agents: ImaginedAgents,
    /// Agents of another kind that may have made the motion instead, with an even prior: the answer averages
    /// over both. Of inverse planning alone; the chains of Algorithm 2 imagine one kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alternative: Option<AlternativeAgents>,
    /// Whether agents with minds of our own kind that help or hinder may not know the other's goal, with an
    /// even prior: the answer averages over what they know. Of inverse planning alone.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub latent_knowledge: bool,
}

/// The agents that an inference imagines: their minds, and the bodies that carry out what the minds choose.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct ImaginedAgents {
    /// Whether bodies turn one way whichever way their minds choose, a defect of the published recorder: to
    /// the left, and to the right in a reflected layout.
    pub one_way_turns: bool,
    /// Whether `stop` has no effect on agents of the greatest strength, another defect of that recorder.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub strongest_coasts: bool,
    /// Parameters of both agents' minds.
    pub minds: MindParameters,
}

impl ImaginedAgents {
    /// The agents of a kind of minds for inverse planning: they ask the policy networks. Published ones have
    /// their recorder's defects.
    #[must_use]
    pub fn of(kind: MindKind) -> Self {
        let agents = Self::searching(kind);
        agents.with_minds(agents.minds.asking_network())
    }

    /// The agents of a kind of minds for an inference in which they all search, though less than agents that
    /// act; published ones with their recorder's defects.
    #[must_use]
    pub fn searching(kind: MindKind) -> Self {
        match kind {
            MindKind::Phase => MindParameters::of(kind).with_simulations(SIMULATIONS).into(),
            MindKind::Published => {
                let minds = PublishedParameters {
                    simulations: PUBLISHED_SIMULATIONS,
                    searches: PUBLISHED_SEARCHES,
                    strongest_coasts: true,
                    older_actions: true,
                    ..PublishedParameters::default()
                };
                Self { one_way_turns: true, strongest_coasts: true, minds: minds.into() }
            }
        }
    }

    /// The defects of their bodies.
    #[must_use]
    pub const fn recorder(&self) -> Recorder {
        Recorder { one_way_turns: self.one_way_turns, strongest_coasts: self.strongest_coasts }
    }

    /// These agents with other minds.
    #[must_use]
    pub const fn with_minds(self, minds: MindParameters) -> Self {
        Self { minds, ..self }
    }
}

impl From<MindParameters> for ImaginedAgents {
    /// Agents whose bodies turn as their minds choose.
    fn from(minds: MindParameters) -> Self {
        Self { one_way_turns: false, strongest_coasts: false, minds }
    }
}

/// Another kind of agents that an inference considers.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct AlternativeAgents {
    /// The agents.
    pub agents: ImaginedAgents,
    /// ε of their actions, in place of that of [`InversePlanningSettings`], 0 to 1.
    pub lapse_rate: f64,
    /// ε at which the two kinds are compared, 0 to 1: of two kinds that explain an event alike, the one with
    /// the smaller ε would seem likelier.
    pub comparison_lapse_rate: f64,
}

/// ε of published minds where both kinds are considered, fitted to recordings and generated events together.
/// That of our own minds is the default ε, which stands for what other minds do and ours do not.
const LAPSE_RATE_OF_PUBLISHED: f64 = 0.1;
/// ε at which the kinds are compared: that of events by such minds, for which the likelihood of the true
/// intents is greatest near no lapse at all; a search that did not try an action must not rule an intent out.
const COMPARISON_LAPSE_RATE: f64 = 0.05;

/// Parameters of inverse planning. ε is fitted by `cargo xtask fit-inference` and κ measured by it
/// (docs/explanation/simple.md), σ was selected on the validation events of PHASE-500.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct InversePlanningSettings {
    /// ε, the lapse rate: probability of a uniformly random action instead of the policy's, 0 to 1.
    #[serde(rename = "slips")]
    pub lapse_rate: f64,
    /// σ, scale of the residuals (u), above 0 and at most 100: a residual larger by σ divides an action's
    /// likelihood by e.
    pub tolerance: f64,
    /// κ, inverse temperature of the action likelihood of a step, 0 to 1: one over the integrated
    /// autocorrelation time of the log likelihood ratio of two intents (steps), because what a decision tells
    /// is correlated over steps.
    #[serde(rename = "temper")]
    pub inverse_temperature: f64,
    /// Steps from one decision that is looked at to the next; at least 1. What lies between them is taken to
    /// be alike.
    pub interval: usize,
    /// Change of the posterior (total variation, 0 to 1) that may be left unmade: an intent is looked at
    /// every 24 steps at first (eight intervals), and twice as often while one standard error more or less
    /// of its log likelihood would change the posterior by more. With 0 all decisions are looked at.
    #[serde(default)]
    pub tolerated_change: f64,
}

impl InversePlanningSettings {
    /// Weight of the log likelihood of a decision that stands for an interval.
    #[must_use]
    pub fn weight_of_decision(&self) -> f64 {
        self.inverse_temperature * self.interval.max(1) as f64
    }
}

/// Parameters of Algorithm 2.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct ChainSettings {
    /// The source of proposals after the initial ones.
    pub update: Update,
    /// L, iterations after the initial proposals; 0 to 10000.
    pub iterations: usize,
    /// M, particles, each a separate chain; 1 to 10000.
    pub particles: usize,
    /// β of the likelihood (1/u), 0 to 1000.
    pub beta: f64,
    /// η of the choice of a window (1/u), 0 to 1000.
    pub eta: f64,
    /// ΔT, length of a window (steps), at least 1.
    pub window: usize,
    /// Steps between resynchronisations with the observed state, at least 1; `None` (the paper) for none.
    #[serde(rename = "anchor")]
    pub resync_interval: Option<usize>,
    /// The source of proposals of strengths. Absent in older files, which means the network.
    #[serde(default)]
    pub strengths: StrengthSource,
}

/// Change of the posterior that may be left unmade.
const TOLERATED: f64 = 0.01;
/// POMCP simulations a decision within an inference.
const SIMULATIONS: usize = 50;
/// Those of published minds, whose searches branch on more and are shared by many intents.
const PUBLISHED_SIMULATIONS: usize = 100;
/// Searches of published minds at an observed state. What one settles on is to some degree chance.
const PUBLISHED_SEARCHES: usize = 2;
/// Number of intents of an agent in an event with two objects.
const INTENTS: usize = 42;

impl InferenceSettings {
    /// The paper's: Algorithm 2 with M = 15, L = 6, β = 0.05, η = 0.1 and ΔT = 10, over simulations by the
    /// published simulator's minds that run freely from the start; [`Update::Local`] is the paper's method,
    /// the others are its ablation. Its strengths come from a network. Only γ is not the printed one (see
    /// [`GAMMA`]), and agents search with fewer simulations.
    #[must_use]
    pub fn published(update: Update, strengths: StrengthSource) -> Self {
        Self::chains(ChainSettings {
            beta: 0.05,
            resync_interval: None,
            strengths,
            ..ChainSettings::resynchronised(update)
        })
        .with_agents(ImaginedAgents::searching(MindKind::Published))
    }

    /// Inverse planning that averages over our own minds and the published simulator's.
    #[must_use]
    pub fn averaged() -> Self {
        let alternative = Some(AlternativeAgents {
            agents: ImaginedAgents::of(MindKind::Published),
            lapse_rate: LAPSE_RATE_OF_PUBLISHED,
            comparison_lapse_rate: COMPARISON_LAPSE_RATE,
        });
        Self { alternative, ..Self::default() }
    }

    /// As [`averaged`](Self::averaged), and over what helpers and hinderers know of the other's goal.
    #[must_use]
    pub fn averaged_over_knowledge() -> Self {
        Self { latent_knowledge: true, ..Self::averaged() }
    }

    /// These settings with minds, of every kind that they consider, that search.
    #[must_use]
    pub const fn searching(mut self) -> Self {
        self.agents.minds = self.agents.minds.searching();
        if let Some(alternative) = &mut self.alternative {
            alternative.agents.minds = alternative.agents.minds.searching();
        }
        self
    }

    /// These settings with these agents and no others.
    #[must_use]
    pub const fn with_agents(self, agents: ImaginedAgents) -> Self {
        Self { agents, alternative: None, ..self }
    }

    /// These settings with minds, of every kind that they consider, that search, and in whose search bodies
    /// pass through each other.
    #[must_use]
    pub const fn without_collisions(mut self) -> Self {
        self = self.searching();
        self.agents.minds = self.agents.minds.without_collisions();
        if let Some(alternative) = &mut self.alternative {
            alternative.agents.minds = alternative.agents.minds.without_collisions();
        }
        self
    }

    /// Algorithm 2.
    #[must_use]
    pub fn chains(chains: ChainSettings) -> Self {
        Self { algorithm: Algorithm::Chains(chains), ..Self::default().searching() }
    }

    /// Approximate number of ticks of an inference.
    #[must_use]
    pub const fn ticks(&self) -> usize {
        let kinds = if self.alternative.is_some() { 2 } else { 1 };
        match self.algorithm {
            Algorithm::InversePlanning(_) => kinds * INTENTS * AGENT_COUNT,
            Algorithm::Chains(ChainSettings { update: Update::Initial, particles, .. }) => particles,
            Algorithm::Chains(ChainSettings { iterations, particles, .. }) => particles * (iterations + 1),
        }
    }
}

/// ε, a probability.
const fn lapses(name: &'static str) -> Setting {
    Setting::real(name, "", 0.0, 1.0)
}

/// A number of steps of an event, at least one.
const fn steps(name: &'static str) -> Setting {
    Setting::whole(name, "steps", 1, EVENT_STEPS.high as u32)
}

/// A scale by which a distance is multiplied.
const fn per_length(name: &'static str) -> Setting {
    Setting::real(name, "1/u", 0.0, 1000.0)
}

impl InferenceSettings {
    /// Checks that everything is in its range. [`infer`](crate::infer) and [`Observer`](crate::Observer) do
    /// so themselves.
    ///
    /// # Errors
    /// [`RangeError`], which names the setting, as in JSON, and its range.
    pub fn validate(&self) -> Result<(), RangeError> {
        let checked = |path: &str, values: &[(Setting, f64)]| {
            values.iter().try_for_each(|(setting, value)| setting.check(*value)).map_err(|it| it.within(path))
        };
        checked("", &[(per_length("gamma"), self.gamma)])?;
        let minds = |agents: &ImaginedAgents| agents.minds.validate().map_err(|error| error.within("minds"));
        minds(&self.agents).map_err(|error| error.within("agents"))?;
        if let Some(AlternativeAgents { agents, lapse_rate, comparison_lapse_rate }) = &self.alternative {
            minds(agents).map_err(|error| error.within("alternative.agents"))?;
            let rates = [
                (lapses("lapse_rate"), *lapse_rate),
                (lapses("comparison_lapse_rate"), *comparison_lapse_rate),
            ];
            checked("alternative", &rates)?;
        }
        match &self.algorithm {
            Algorithm::InversePlanning(it) => checked(
                "algorithm.inverse_planning",
                &[
                    (lapses("slips"), it.lapse_rate),
                    (Setting::positive("tolerance", "u", 100.0), it.tolerance),
                    (lapses("temper"), it.inverse_temperature),
                    (steps("interval"), it.interval as f64),
                    (Setting::real("tolerated_change", "", 0.0, 1.0), it.tolerated_change),
                ],
            ),
            Algorithm::Chains(it) => checked(
                "algorithm.chains",
                &[
                    (Setting::whole("iterations", "", 0, 10_000), it.iterations as f64),
                    (Setting::whole("particles", "", 1, 10_000), it.particles as f64),
                    (per_length("beta"), it.beta),
                    (per_length("eta"), it.eta),
                    (steps("window"), it.window as f64),
                    (steps("anchor"), it.resync_interval.unwrap_or(1) as f64),
                ],
            ),
        }
    }
}

impl ChainSettings {
    /// The paper's parameters with simulations that are resynchronised with the observed event.
    #[must_use]
    pub const fn resynchronised(update: Update) -> Self {
        Self {
            update,
            iterations: 6,
            particles: 15,
            beta: 0.2,
            eta: 0.1,
            window: 10,
            resync_interval: Some(10),
            strengths: StrengthSource::Network,
        }
    }
}

impl Default for InversePlanningSettings {
    fn default() -> Self {
        Self {
            lapse_rate: 0.5,
            tolerance: 0.03,
            inverse_temperature: 1.0 / 6.0,
            interval: 3,
            tolerated_change: TOLERATED,
        }
    }
}

impl Default for InferenceSettings {
    fn default() -> Self {
        Self {
            algorithm: Algorithm::InversePlanning(InversePlanningSettings::default()),
            gamma: GAMMA,
            agents: ImaginedAgents::of(MindKind::Phase),
            alternative: None,
            latent_knowledge: false,
        }
    }
}
