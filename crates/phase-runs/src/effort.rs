//! Physics engine, length of events and search effort of agents, as somebody asked for them.

use crate::error::RunError;
use phase_minds::{
    Foresight, MindKind, MindParameters, PhaseParameters, Prior, PublishedParameters, Recorder,
};
use phase_sim::{Engine, SimulationSettings};
use phase_simple::Simple;

/// Choice of the minds that agents have.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct MindChoice {
    /// The kind of minds; without one that of the method, or our own in simulations.
    pub kind: Option<MindKind>,
    /// Whether all turns go one way, as in the published recordings: left, and right in a reflected layout.
    pub one_way_turns: bool,
    /// Whether `stop` has no effect on agents of the greatest strength, as in the published recordings.
    pub strongest_coasts: bool,
    /// Whether published minds draw the random numbers of the original, which repeat in every search.
    pub original_random: bool,
    /// POMCP simulations a decision, in the range [`phase_minds::SIMULATIONS`].
    pub simulations: Option<u32>,
}

impl MindChoice {
    /// Whether nothing was chosen that differs from the default.
    #[must_use]
    pub(crate) fn is_default(&self) -> bool {
        *self == Self { kind: self.kind, ..Self::default() }
            && self.kind.unwrap_or_default() == MindKind::default()
    }

    /// The defects of the agents' bodies.
    #[must_use]
    pub const fn recorder(&self) -> Recorder {
        Recorder { one_way_turns: self.one_way_turns, strongest_coasts: self.strongest_coasts }
    }

    /// The name of a method that imagines such minds.
    #[must_use]
    pub fn name(&self, method: &str) -> String {
        let kind = self.kind.map(|kind| format!("-{}-minds", kind.name()));
        let random = self.original_random.then(|| "-original-random".to_owned());
        let simulations = self.simulations.map(|simulations| format!("-{simulations}-simulations"));
        [kind, random, simulations].into_iter().flatten().fold(method.into(), |name, part| name + &part)
    }

    /// SIMPLE that imagines such minds.
    #[must_use]
    pub fn imagined_by(&self, simple: Simple) -> Simple {
        let simple = simple.with_minds(self.kind, self.recorder(), self.original_random);
        match self.simulations {
            Some(simulations) => simple.with_simulations(simulations as usize),
            None => simple,
        }
    }
}

/// Physics engine, length of events and search effort of agents. What is `None` is as in the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Effort {
    /// Physics engine of the events.
    pub engine: Option<Engine>,
    /// Minds of the agents.
    pub minds: MindChoice,
    /// Dynamics in the agents' search.
    pub foresight: Option<Foresight>,
    /// Priors of the actions in the agents' search.
    pub prior: Option<Prior>,
    /// Belief particles of each agent, in the range [`phase_minds::PARTICLES`].
    pub particles: Option<u32>,
    /// Maximum length of an event (steps of 0.25 s), in the range [`phase_model::setting::EVENT_STEPS`].
    pub max_steps: Option<u32>,
}

impl Effort {
    /// The settings of the simulation.
    ///
    /// # Errors
    /// [`RunError::Usage`], if minds of this kind do not have a parameter that was given, or it is out of its
    /// range.
    pub fn settings(&self) -> Result<SimulationSettings, RunError> {
        self.settings_with(MindParameters::of(self.minds.kind.unwrap_or_default()))
    }

    /// The settings of the simulation, where minds have these parameters in place of the defaults.
    ///
    /// # Errors
    /// [`RunError::Usage`], if other minds were requested, minds of this kind do not have a parameter that
    /// was given or make no use of it, or it is out of its range.
    pub fn settings_with(&self, mut minds: MindParameters) -> Result<SimulationSettings, RunError> {
        if let Some(kind) = self.minds.kind.filter(|kind| *kind != minds.kind()) {
            let asked = kind.name();
            let given = minds.kind().name();
            return Err(RunError::Usage(format!(
                "--minds {asked}: the parameters are those of {given} minds"
            )));
        }
        if let Some(foresight) = self.foresight {
            minds = with_foresight(minds, foresight)?;
        }
        if let Some(simulations) = self.minds.simulations {
            minds = minds.with_simulations(simulations as usize);
        }
        if let Some(prior) = self.prior {
            minds = match (minds, prior) {
                (MindParameters::Phase(phase), _) => PhaseParameters { prior, ..phase }.into(),
                (MindParameters::Published(published), Prior::NetworkAlone) => {
                    PublishedParameters { network_alone: true, ..published }.into()
                }
                (MindParameters::Published(_), Prior::Habits | Prior::Network) => {
                    let rule = "published minds search without priors, or take `network-alone`";
                    return Err(RunError::Usage(format!("--prior {}: {rule}", prior.name())));
                }
            };
        }
        if self.minds.simulations.is_some() && minds.asks_network() {
            let rule = "minds with --prior network-alone do not search";
            return Err(RunError::Usage(format!("--simulations: {rule}")));
        }
        if let Some(particles) = self.particles {
            minds = minds.with_particles(particles as usize);
        }
        if self.minds.original_random && minds.kind() != MindKind::Published {
            return Err(RunError::Usage("--original-random: only published minds have them".into()));
        }
        let minds = minds.as_recorded(self.minds.original_random, self.minds.strongest_coasts);
        let defaults = SimulationSettings::default();
        let settings = SimulationSettings {
            engine: self.engine.unwrap_or_default(),
            max_steps: self.max_steps.map_or(defaults.max_steps, |steps| steps as usize),
            one_way_turns: self.minds.one_way_turns,
            strongest_coasts: self.minds.strongest_coasts,
            minds,
            ..defaults
        };
        settings.validate().map_err(|error| RunError::Usage(error.to_string()))?;
        Ok(settings)
    }

    /// The options of the command line that ask for it, each with a space before it.
    #[must_use]
    pub(crate) fn options(&self) -> String {
        let simulations = self.minds.simulations;
        let numbers =
            [("particles", self.particles), ("simulations", simulations), ("max-steps", self.max_steps)];
        let engine = self.engine.map(|engine| format!(" --engine {}", engine.name()));
        let minds = self.minds.kind.map(|minds| format!(" --minds {}", minds.name()));
        let switches = [
            (self.minds.one_way_turns, " --one-way-turns"),
            (self.minds.strongest_coasts, " --strongest-coasts"),
            (self.minds.original_random, " --original-random"),
        ];
        let switches = switches.into_iter().filter(|(on, _)| *on).map(|(_, option)| option.to_owned());
        let foresight = self.foresight.map(|foresight| format!(" --foresight {}", foresight.name()));
        let prior = self.prior.map(|prior| format!(" --prior {}", prior.name()));
        let given = numbers.into_iter().filter_map(|(name, value)| Some(format!(" --{name} {}", value?)));
        engine.into_iter().chain(minds).chain(switches).chain(foresight).chain(prior).chain(given).collect()
    }
}

/// Settings in words.
#[must_use]
pub fn description(settings: &SimulationSettings) -> String {
    let SimulationSettings { engine, max_steps, minds, one_way_turns, .. } = settings;
    let engine = engine.name();
    let kind = minds.kind().name();
    let search = match minds {
        MindParameters::Phase(phase) if phase.prior == Prior::Habits => {
            format!(", foresight {}", phase.foresight.name())
        }
        MindParameters::Phase(phase) => {
            format!(", foresight {}, prior {}", phase.foresight.name(), phase.prior.name())
        }
        MindParameters::Published(published) => {
            let bodies = if published.collisions { "" } else { ", without collisions" };
            let prior = if published.network_alone { ", prior network-alone" } else { "" };
            format!("{bodies}{prior}")
        }
    };
    let turns = if *one_way_turns { ", one-way turns" } else { "" };
    let stops = if settings.strongest_coasts { ", coasting strongest" } else { "" };
    let random = if minds.has_original_random() { ", original random numbers" } else { "" };
    let particles = minds.particles();
    let simulations = minds.simulations();
    format!(
        "engine {engine}, {kind} minds{turns}{stops}{random}{search}, {particles} particles, {simulations} simulations, at most \
         {max_steps} steps"
    )
}

/// Minds that search in these dynamics, if minds of their kind can.
fn with_foresight(minds: MindParameters, foresight: Foresight) -> Result<MindParameters, RunError> {
    match (minds, foresight) {
        (MindParameters::Phase(phase), _) => Ok(PhaseParameters { foresight, ..phase }.into()),
        (MindParameters::Published(_), Foresight::Points) => Ok(minds.without_collisions()),
        (MindParameters::Published(_), Foresight::Coarse | Foresight::Exact) => {
            let rule = "published minds search in dynamics of their own, which can only be `points` instead";
            Err(RunError::Usage(format!("--foresight {}: {rule}", foresight.name())))
        }
    }
}
