//! Physics engine, length of events and search effort of agents: options shared by several commands.

use clap::{
    Args,
    builder::{PossibleValuesParser, TypedValueParser},
    value_parser,
};
use phase_agent::{Foresight, MindKind, MindParameters};
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
    /// Sets in parameters what was given.
    pub fn apply(&self, parameters: &mut MindParameters) {
        parameters.kind = self.minds.unwrap_or(parameters.kind);
        parameters.one_way_turns |= self.one_way_turns;
    }

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
    /// bodies pass through each other [default: coarse]
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
    #[must_use]
    pub fn settings(&self) -> SimulationSettings {
        let mut settings =
            SimulationSettings { engine: self.engine.unwrap_or_default(), ..SimulationSettings::default() };
        self.minds.apply(&mut settings.minds);
        if let Some(foresight) = self.foresight {
            settings.minds.foresight = foresight;
        }
        if let Some(particles) = self.particles {
            settings.minds.particles = particles as usize;
        }
        if let Some(simulations) = self.simulations {
            settings.minds.simulations = simulations as usize;
        }
        if let Some(steps) = self.max_steps {
            settings.max_steps = steps as usize;
        }
        settings
    }

    /// The settings in words.
    #[must_use]
    pub fn description(&self) -> String {
        let SimulationSettings { engine, max_steps, minds, .. } = self.settings();
        let (engine, kind, foresight) = (engine.name(), minds.kind.name(), minds.foresight.name());
        let turns = if minds.one_way_turns { ", one-way turns" } else { "" };
        let (particles, simulations) = (minds.particles, minds.simulations);
        format!(
            "engine {engine}, {kind} minds{turns}, foresight {foresight}, {particles} particles, {simulations} simulations, at most \
             {max_steps} steps"
        )
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
