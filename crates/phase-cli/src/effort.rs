//! Physics engine, length of events and search effort of agents: options shared by several commands.

use clap::{
    Args,
    builder::{PossibleValuesParser, TypedValueParser},
    value_parser,
};
use phase_agent::Foresight;
use phase_sim::{Engine, SimulationSettings};

/// Physics engine, length of events and search effort of agents; the defaults are the paper's.
#[derive(Args, Debug)]
pub struct SimulationOptions {
    /// Physics engine of the events: `world` (rapier2d) or `forward` (the kernel that the agents' search
    /// uses, closest to the published simulator) [default: world]
    #[arg(long, value_name = "ENGINE", hide_possible_values = true, value_parser = engines())]
    pub engine: Option<Engine>,
    /// Fidelity of the dynamics in the agents' search: `coarse`, or `exact`, which takes several times as long
    /// [default: coarse]
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
        let (engine, foresight) = (engine.name(), minds.foresight.name());
        let (particles, simulations) = (minds.particles, minds.simulations);
        format!(
            "engine {engine}, foresight {foresight}, {particles} particles, {simulations} simulations, at most \
             {max_steps} steps"
        )
    }

    /// The options as given, to repeat the command.
    #[must_use]
    pub fn as_given(&self) -> String {
        let options =
            [("particles", self.particles), ("simulations", self.simulations), ("max-steps", self.max_steps)];
        let engine = self.engine.map(|engine| format!(" --engine {}", engine.name()));
        let foresight = self.foresight.map(|foresight| format!(" --foresight {}", foresight.name()));
        let given = options.into_iter().filter_map(|(name, value)| Some(format!(" --{name} {}", value?)));
        engine.into_iter().chain(foresight).chain(given).collect()
    }
}

/// Reads an engine by its name.
#[must_use]
pub fn engines() -> impl TypedValueParser<Value = Engine> {
    let names = PossibleValuesParser::new(Engine::ALL.map(Engine::name));
    names.try_map(|name| Engine::ALL.into_iter().find(|engine| engine.name() == name).ok_or("no such engine"))
}

/// Reads the fidelity of the search's dynamics by its name.
fn foresights() -> impl TypedValueParser<Value = Foresight> {
    let names = PossibleValuesParser::new(Foresight::ALL.map(Foresight::name));
    names.try_map(|name| {
        Foresight::ALL.into_iter().find(|foresight| foresight.name() == name).ok_or("no such foresight")
    })
}
