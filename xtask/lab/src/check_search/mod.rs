//! `check-search`: how near the decisions of short searches are to those of a long one, by the priors of
//! their root.
//!
//! Some decisions of each event are searched again by its own minds, on the beliefs that they had: once with
//! very many simulations, for reference, and with fewer, with every prior. The distance is the total
//! variation between the shares of visits; two long searches with different seeds show how much of it is
//! chance.

use crate::{
    error::LabError,
    fit_events::{FitEvents, KeptFigures},
};
use cpu_time::ThreadTime;
use phase_cli::{context::Context, interrupt, output::print_result};
use phase_event::{ActionEvaluation, MethodError, ProgressCallback, Recording, Thought};
use phase_minds::{MindParameters, PhaseParameters, Prior, mind};
use phase_model::{
    AGENT_COUNT, Action, AgentId,
    random::{self, Purpose},
};
use phase_runs::error::RunError;
use phase_sim::{SimulationSettings, belief_view};
use phase_statistics::{mean, standard_error};
use serde::{Deserialize, Serialize};

/// Simulations of the reference.
const REFERENCE: usize = 4000;
/// Simulations that are compared with it.
const SHORT: [usize; 6] = [25, 50, 100, 200, 400, 1000];
/// Decisions of an agent in an event.
const DECISIONS_OF_AGENT: usize = 4;

/// One way to decide.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Way {
    prior: Prior,
    simulations: usize,
    convergence: f64,
}

/// The reference.
const LONG: Way = Way { prior: Prior::Habits, simulations: REFERENCE, convergence: 0.0 };

/// A decision made in one way, beside the reference.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
struct Decided {
    /// Total variation between the shares of visits, 0 to 1.
    variation: f64,
    /// Whether the most visited action is the same.
    same: bool,
    /// CPU time (s).
    seconds: f64,
}

/// Every way, the shipped one first.
fn ways() -> Vec<Way> {
    let shipped = PhaseParameters::default();
    let way = |prior, simulations, convergence| Way { prior, simulations, convergence };
    let mut ways = vec![
        way(shipped.prior, shipped.simulations, shipped.convergence),
        LONG,
        way(Prior::NetworkAlone, REFERENCE, 0.0),
    ];
    for prior in [Prior::Habits, Prior::Network] {
        ways.extend(SHORT.map(|simulations| way(prior, simulations, 0.0)));
    }
    ways
}

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &FitEvents, context: &Context) -> Result<(), LabError> {
    arguments.check_out([])?;
    arguments.check_nothing_held_out()?;
    let events = arguments.read_all(&arguments.events, context)?;
    interrupt::listen();
    let ways = ways();
    let kept = KeptFigures::new("", arguments, context)?;
    let recordings: Vec<&Recording> = events.iter().collect();
    let found = kept.of("searching", &recordings, DECISIONS_OF_AGENT * AGENT_COUNT, |recording, tick| {
        let failed = |source| RunError::Method { id: recording.id.clone(), source };
        decisions(recording, &ways, arguments.seed, tick).map_err(failed)
    })?;
    let decisions: Vec<&Vec<Decided>> = found.iter().flatten().collect();
    let mut text = format!(
        "{} decisions of {} events beside a search of {REFERENCE} simulations\n\
         {:<14} {:>11} {:>11} {:>16} {:>16} {:>11}\n",
        decisions.len(),
        found.len(),
        "prior",
        "simulations",
        "convergence",
        "total variation",
        "same action",
        "CPU ms"
    );
    for (k, way) in ways.iter().enumerate() {
        let numbers =
            |number: fn(&Decided) -> f64| -> Vec<f64> { decisions.iter().map(|of| number(&of[k])).collect() };
        let shown = |numbers: &[f64]| {
            let error = standard_error(numbers).unwrap_or_default();
            format!("{:.3} ± {error:.3}", mean(numbers).unwrap_or_default())
        };
        let seconds = mean(&numbers(|it| it.seconds)).unwrap_or_default();
        text += &format!(
            "{:<14} {:>11} {:>11} {:>16} {:>16} {:>11.2}\n",
            way.prior.name(),
            way.simulations,
            way.convergence,
            shown(&numbers(|it| it.variation)),
            shown(&numbers(|it| f64::from(u8::from(it.same)))),
            1000.0 * seconds
        );
    }
    print_result(text.trim_end())?;
    Ok(())
}

/// Some decisions of an event, each in every way.
fn decisions(
    recording: &Recording,
    ways: &[Way],
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<Vec<Vec<Decided>>>, MethodError> {
    let simulation = recording.simulation.as_ref().ok_or_else(|| MethodError::new(NoThoughts))?;
    let settings = SimulationSettings::read(&simulation.settings, "settings").map_err(MethodError::new)?;
    let MindParameters::Phase(parameters) = settings.minds else { return Err(MethodError::new(NoThoughts)) };
    let event = &simulation.event;
    let mut found = Vec::new();
    for agent in AgentId::ALL {
        let beliefs = phase_sim::beliefs(event, agent, &settings.minds);
        // One mind makes all decisions in one way, as in an event: it remembers ways between rooms.
        let mut minds = Vec::with_capacity(1 + ways.len());
        for Way { prior, simulations, convergence } in core::iter::once(&LONG).chain(ways) {
            let parameters = PhaseParameters {
                prior: *prior,
                simulations: *simulations,
                convergence: *convergence,
                ..parameters
            };
            minds.push(mind(&event.scene, agent, &parameters.into()).map_err(MethodError::new)?);
        }
        for k in 0..DECISIONS_OF_AGENT {
            if tick().is_break() {
                return Ok(None);
            }
            let step = event.steps.len() * k / DECISIONS_OF_AGENT;
            let view = belief_view(event, agent, step, &beliefs);
            let mut decide = |of: usize| {
                let mut random = random::stream(seed, Purpose::Search, u64::from(of > 0));
                let start = ThreadTime::now();
                let decided = minds[of].decide(view, &mut random);
                let seconds = start.elapsed().as_secs_f64();
                Ok::<_, MethodError>((decided.map_err(MethodError::new)?.1, seconds))
            };
            let (reference, _) = decide(0)?;
            if reference.actions.is_empty() {
                continue;
            }
            let decided = (1..=ways.len()).map(|of| {
                let (thought, seconds) = decide(of)?;
                let (variation, same) = compare(&reference, &thought);
                Ok(Decided { variation, same, seconds })
            });
            found.push(decided.collect::<Result<_, MethodError>>()?);
        }
    }
    Ok(Some(found))
}

/// Total variation between the shares of visits, and whether the most visited action is the same.
fn compare(one: &Thought, other: &Thought) -> (f64, bool) {
    let shares = |thought: &Thought| {
        let sum: f64 = thought.actions.iter().map(|found| f64::from(found.visits)).sum();
        let share = |found: &ActionEvaluation| (found.action, f64::from(found.visits) / sum.max(1.0));
        thought.actions.iter().map(share).collect::<Vec<(Action, f64)>>()
    };
    let one = shares(one);
    let other = shares(other);
    let best = |shares: &[(Action, f64)]| {
        shares.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(action, _)| *action)
    };
    let variation = one.iter().zip(&other).map(|(a, b)| (a.1 - b.1).abs()).sum::<f64>() / 2.0;
    (variation, best(&one) == best(&other))
}

/// An event has no searches by our own minds.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error("the event must be simulated by phase minds")]
struct NoThoughts;
