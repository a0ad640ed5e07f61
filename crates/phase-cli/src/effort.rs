//! Physics engine, length of events and search effort of agents: options shared by several commands.

use crate::named::named;
use clap::{Args, value_parser};
use phase_minds::{Foresight, MindKind, PARTICLES, Prior, SIMULATIONS};
use phase_model::setting::EVENT_STEPS;
use phase_runs::{
    effort::{Effort, MindChoice},
    error::RunError,
};
use phase_sim::{Engine, SimulationSettings};

/// Choice of the minds that agents have, or that SIMPLE imagines.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct MindOptions {
    /// Minds of the agents, or the only ones that SIMPLE imagines: `phase`, or `published`, those of the
    /// published simulator [default: phase; `simple` averages over both, `simple-published` has published
    /// minds]
    #[arg(long, value_name = "MINDS", hide_possible_values = true,
        value_parser = named(MindKind::ALL, MindKind::name))]
    pub minds: Option<MindKind>,
    /// All turns of these minds go one way, as in the published recordings: left, and right in a reflected
    /// layout
    #[arg(long)]
    pub one_way_turns: bool,
    /// Agents of the greatest strength coast when they mean to stop, as in the published recordings
    #[arg(long)]
    pub strongest_coasts: bool,
    /// Published minds draw the random numbers of the original, which repeat in every search
    #[arg(long)]
    pub original_random: bool,
    /// POMCP simulations a decision, 1 to 1000000 [default: 1000, or the preset's; in SIMPLE 50 of our own
    /// minds, none of published ones, for which a network stands, and 100 in `simple-published`, without
    /// --original-random]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(SIMULATIONS.bounds()))]
    pub simulations: Option<u32>,
}

impl From<MindOptions> for MindChoice {
    fn from(options: MindOptions) -> Self {
        let MindOptions { minds, one_way_turns, strongest_coasts, original_random, simulations } = options;
        Self { kind: minds, one_way_turns, strongest_coasts, original_random, simulations }
    }
}

/// Physics engine, length of events and search effort of agents; the defaults are the paper's.
#[derive(Args, Debug)]
pub struct SimulationOptions {
    /// Physics engine of the events: `world` (rapier2d), `forward` (the kernel that the agents' search uses)
    /// or `original` (the published simulator's) [default: world]
    #[arg(long, value_name = "ENGINE", hide_possible_values = true,
        value_parser = named(Engine::ALL, Engine::name))]
    pub engine: Option<Engine>,
    /// Minds of the agents.
    #[command(flatten)]
    pub minds: MindOptions,
    /// Dynamics in the agents' search: `coarse`, or `exact`, which takes several times as long, or `points`,
    /// in which bodies pass through each other; published minds have dynamics of their own, or `points`
    /// [default: coarse]
    #[arg(long, value_name = "HOW", hide_possible_values = true,
        value_parser = named(Foresight::ALL, Foresight::name))]
    pub foresight: Option<Foresight>,
    /// Priors of the actions in a search by our own minds: `habits`, or `network`, the policy network, or
    /// `network-alone`, which takes what the network says and does not search; published minds have no
    /// priors, or `network-alone` [default: habits, or the preset's]
    #[arg(long, value_name = "PRIOR", hide_possible_values = true,
        value_parser = named(Prior::ALL, Prior::name))]
    pub prior: Option<Prior>,
    /// Belief particles of each agent, 1 to 100000 [default: 50]
    #[arg(long, value_name = "K", value_parser = value_parser!(u32).range(PARTICLES.bounds()))]
    pub particles: Option<u32>,
    /// Maximum length of an event, in steps of 0.25 s, 1 to 10000 [default: 100]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(EVENT_STEPS.bounds()))]
    pub max_steps: Option<u32>,
}

impl SimulationOptions {
    /// Effort that the options ask for.
    #[must_use]
    pub fn effort(&self) -> Effort {
        Effort {
            engine: self.engine,
            minds: self.minds.into(),
            foresight: self.foresight,
            prior: self.prior,
            particles: self.particles,
            max_steps: self.max_steps,
        }
    }

    /// The settings of the simulation.
    ///
    /// # Errors
    /// [`RunError::Usage`], if minds of this kind do not have a parameter that was given.
    pub fn settings(&self) -> Result<SimulationSettings, RunError> {
        self.effort().settings()
    }
}
