//! Physics engine, length of events and search effort of agents: options shared by several commands.

use crate::error::CliError;
use clap::{
    Args,
    builder::{PossibleValuesParser, TypedValueParser},
    value_parser,
};
use phase_minds::{Foresight, MindKind, MindParameters, PhaseParameters};
use phase_sim::{Engine, SimulationSettings};

/// Which minds agents have.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct MindOptions {
    /// Minds of the agents: `phase`, or `published`, those of the published simulator [default: phase]
    #[arg(long, value_name = "MINDS", hide_possible_values = true, value_parser = mind_kinds())]
    pub minds: Option<MindKind>,
    /// All turns go one way, as in the published recordings: left, and right in a reflected layout
    #[arg(long)]
    pub one_way_turns: bool,
}

impl MindOptions {
    /// Whether these are the minds without any of the options.
    #[must_use]
    pub fn are_default(&self) -> bool {
        self.minds.unwrap_or_default() == MindKind::default() && !self.one_way_turns
    }

    /// The name of a method that imagines such minds.
    #[must_use]
    pub fn name(&self, method: &str) -> String {
        self.minds.map_or_else(|| method.into(), |kind| format!("{method}-{}-minds", kind.name()))
    }
}

/// Physics engine, length of events and search effort of agents; the defaults are the paper's.
#[derive(Args, Debug)]
pub struct SimulationOptions {
    /// Physics engine of the events: `world` (rapier2d) or `forward` (the kernel that the agents' search
    /// uses, closest to the published simulator) [default: world]
    #[arg(long, value_name = "ENGINE", hide_possible_values = true, value_parser = engines())]
    pub engine: Option<Engine>,
    /// Which minds.
    #[command(flatten)]
    pub minds: MindOptions,
    /// Dynamics in the agents' search: `coarse`, or `exact`, which takes several times as long, or `points`, in which
    /// bodies pass through each other; published minds have dynamics of their own, or `points` [default: coarse]
    #[arg(long, value_name = "HOW", hide_possible_values = true, value_parser = foresights())]
    pub foresight: Option<Foresight>,
    /// Belief particles of each agent [default: 50]
    #[arg(long, value_name = "K", value_parser = value_parser!(u32).range(1..=100_000))]
    pub particles: Option<u32>,
    /// POMCP simulations a decision [default: 1000]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000_000))]
    pub simulations: Option<u32>,
    /// Maximum length of an event, in steps of 0.25 s [default: 100]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    pub max_steps: Option<u32>,
}

impl SimulationOptions {
    /// The requested settings.
    ///
    /// # Errors
    /// [`CliError::Usage`], if minds of this kind do not have a parameter that was given.
    pub fn settings(&self) -> Result<SimulationSettings, CliError> {
        self.settings_with(MindParameters::of(self.minds.minds.unwrap_or_default()))
    }

    /// The requested settings, where minds have these parameters in place of the defaults.
    ///
    /// # Errors
    /// [`CliError::Usage`], if other minds were requested, or minds of this kind do not have a parameter that was given.
    pub fn settings_with(&self, mut minds: MindParameters) -> Result<SimulationSettings, CliError> {
        if let Some(kind) = self.minds.minds.filter(|kind| *kind != minds.kind()) {
            let asked = kind.name();
            let given = minds.kind().name();
            return Err(CliError::Usage(format!(
                "--minds {asked}: the parameters are those of {given} minds"
            )));
        }
        if let Some(foresight) = self.foresight {
            minds = with_foresight(minds, foresight)?;
        }
        if let Some(particles) = self.particles {
            minds = minds.with_particles(particles as usize);
        }
        if let Some(simulations) = self.simulations {
            minds = minds.with_simulations(simulations as usize);
        }
        let defaults = SimulationSettings::default();
        Ok(SimulationSettings {
            engine: self.engine.unwrap_or_default(),
            max_steps: self.max_steps.map_or(defaults.max_steps, |steps| steps as usize),
            one_way_turns: self.minds.one_way_turns,
            minds,
            ..defaults
        })
    }

    /// The options as given, to repeat the command.
    #[must_use]
    pub fn as_given(&self) -> String {
        let options =
            [("particles", self.particles), ("simulations", self.simulations), ("max-steps", self.max_steps)];
        let engine = self.engine.map(|engine| format!(" --engine {}", engine.name()));
        let minds = self.minds.minds.map(|minds| format!(" --minds {}", minds.name()));
        let turns = self.minds.one_way_turns.then(|| " --one-way-turns".to_owned());
        let foresight = self.foresight.map(|foresight| format!(" --foresight {}", foresight.name()));
        let given = options.into_iter().filter_map(|(name, value)| Some(format!(" --{name} {}", value?)));
        engine.into_iter().chain(minds).chain(turns).chain(foresight).chain(given).collect()
    }
}

/// Settings in words.
#[must_use]
pub fn description(settings: &SimulationSettings) -> String {
    let SimulationSettings { engine, max_steps, minds, one_way_turns, .. } = settings;
    let engine = engine.name();
    let kind = minds.kind().name();
    let search = match minds {
        MindParameters::Phase(phase) => format!(", foresight {}", phase.foresight.name()),
        MindParameters::Published(_) if minds.foresees_collisions() => String::new(),
        MindParameters::Published(_) => ", without collisions".to_owned(),
    };
    let turns = if *one_way_turns { ", one-way turns" } else { "" };
    let particles = minds.particles();
    let simulations = minds.simulations();
    format!(
        "engine {engine}, {kind} minds{turns}{search}, {particles} particles, {simulations} simulations, at most \
         {max_steps} steps"
    )
}

/// Minds that search in these dynamics, if minds of their kind can.
fn with_foresight(minds: MindParameters, foresight: Foresight) -> Result<MindParameters, CliError> {
    match (minds, foresight) {
        (MindParameters::Phase(phase), _) => Ok(PhaseParameters { foresight, ..phase }.into()),
        (MindParameters::Published(_), Foresight::Points) => Ok(minds.without_collisions()),
        (MindParameters::Published(_), Foresight::Coarse | Foresight::Exact) => {
            let rule = "published minds search in dynamics of their own, which can only be `points` instead";
            Err(CliError::Usage(format!("--foresight {}: {rule}", foresight.name())))
        }
    }
}

/// Reads an engine by its name.
#[must_use]
pub fn engines() -> impl TypedValueParser<Value = Engine> {
    let names = PossibleValuesParser::new(Engine::ALL.map(Engine::name));
    names.try_map(|name| Engine::named(&name).ok_or("no such engine"))
}

/// Reads a kind of minds by its name.
#[must_use]
pub fn mind_kinds() -> impl TypedValueParser<Value = MindKind> {
    let names = PossibleValuesParser::new(MindKind::ALL.map(MindKind::name));
    names.try_map(|name| MindKind::ALL.into_iter().find(|kind| kind.name() == name).ok_or("no such minds"))
}

/// Reads the fidelity of the search's dynamics by its name.
fn foresights() -> impl TypedValueParser<Value = Foresight> {
    let names = PossibleValuesParser::new(Foresight::ALL.map(Foresight::name));
    names.try_map(|name| {
        Foresight::ALL.into_iter().find(|foresight| foresight.name() == name).ok_or("no such foresight")
    })
}
