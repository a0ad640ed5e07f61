//! `check-minds`: how minds compare with the agents of recordings or of other events whose labels are known.

mod figures;
mod measure;
mod motion;
pub mod options;
pub(crate) mod parameters;
mod report;
mod table;

use crate::error::LabError;
use measure::Measurement;
use options::CheckMinds;
use phase_cli::{context::Context, interrupt};
use phase_eval::goals::canonical;
use phase_event::Recording;
use phase_minds::{MindKind, MindParameters, PublishedParameters};
use phase_model::{AgentId, Attitude, EventKind, Goal, Scene};
use phase_runs::{engine::GENERATOR, error::RunError, parallel::make_all, source::EventInput, words};
use phase_simple::{Hypothesis, ImaginedAgents, Intent};
use report::MindsReport;
use serde_json::{Value, json};
use std::{borrow::Cow, path::Path};

/// Simulations a decision at observed states by our own minds.
const SIMULATIONS: u32 = 50;
/// Simulations a decision at observed states by published minds, which need more, and whose searches settle
/// early on what is partly chance.
const PUBLISHED_SIMULATIONS: u32 = 200;
/// Searches a decision at observed states by published minds.
const PUBLISHED_SEARCHES: u32 = 5;

/// Runs the command.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &CheckMinds, context: &Context) -> Result<(), LabError> {
    arguments.json.check([&arguments.events].into_iter().chain(&arguments.parameters))?;
    let parameters = arguments.parameters.as_deref().map(parameters::read).transpose()?;
    let recordings = recordings(&arguments.events, &arguments.ids, arguments.only, context)?;
    let plan = plan(arguments, agents(arguments, parameters, &recordings)?)?;
    interrupt::listen();
    let units = recordings.iter().map(|recording| plan.units(recording.trajectory.steps())).max();
    let activity = format!("measuring {}", words::events(recordings.len()));
    let progress = context.progress(&activity, recordings.len(), units.unwrap_or(0));
    let events =
        make_all(arguments.jobs.threads(), recordings.len(), |k| plan.measure(&recordings[k], &progress))?;
    drop(progress);
    let Some(events) = events else { return Err(LabError::Interrupted) };
    let report = MindsReport::of(&events, description(arguments, &plan));
    Ok(arguments.json.print(&report, table::print(&report))?)
}

/// The agents that were asked for. Those of recordings with published minds have bodies that turn one way and
/// coast when the strongest mean to stop, as those of the recorder did; events that were simulated here had
/// others.
fn agents(
    arguments: &CheckMinds,
    given: Option<MindParameters>,
    recordings: &[Recording],
) -> Result<ImaginedAgents, RunError> {
    let minds = given.unwrap_or_else(|| MindParameters::of(arguments.minds.unwrap_or_default()));
    if let Some(kind) = arguments.minds.filter(|kind| *kind != minds.kind()) {
        let asked = kind.name();
        let found = minds.kind().name();
        return Err(RunError::Usage(format!("--minds {asked}: the parameters are those of {found} minds")));
    }
    let recorded = recordings.iter().all(|recording| recording.simulation.is_none());
    let as_recorded = minds.kind() == MindKind::Published && recorded;
    let minds = minds.as_recorded(arguments.original_random, as_recorded);
    Ok(ImaginedAgents { one_way_turns: as_recorded, strongest_coasts: as_recorded, minds })
}

/// The measurement of such agents.
fn plan(arguments: &CheckMinds, agents: ImaginedAgents) -> Result<Measurement, RunError> {
    let simulations = match agents.minds.kind() {
        MindKind::Phase => SIMULATIONS,
        MindKind::Published => PUBLISHED_SIMULATIONS,
    };
    let at_states = match agents.minds.with_simulations(arguments.simulations.unwrap_or(simulations) as usize)
    {
        MindParameters::Published(parameters) => {
            let searches = arguments.searches.unwrap_or(PUBLISHED_SEARCHES) as usize;
            PublishedParameters { searches, ..parameters }.into()
        }
        minds if arguments.searches.is_none() => minds,
        minds => {
            let rule = format!("{} minds search once a decision", minds.kind().name());
            return Err(RunError::Usage(format!("--searches: {rule}")));
        }
    };
    let open_loop = agents.minds.with_simulations(arguments.simulations_open_loop as usize);
    Ok(Measurement {
        observed: agents.with_minds(at_states),
        open_loop: agents.with_minds(open_loop),
        open_loop_seeds: arguments.open_loop_seeds.into(),
        seed: arguments.seed,
    })
}

/// The events of a file or folder with these ids, if there are any, and of one kind only if one is given: at
/// least one event, and each with a step.
pub(crate) fn recordings(
    file: &Path,
    ids: &[String],
    only: Option<EventKind>,
    context: &Context,
) -> Result<Vec<Recording>, RunError> {
    let source = EventInput::open(file, ids, context)?;
    let mut recordings =
        (0..source.len()).map(|k| source.load(k).map(Cow::into_owned)).collect::<Result<Vec<_>, _>>()?;
    if let Some(kind) = only {
        recordings.retain(|recording| recording.scene.kind == kind);
    }
    if recordings.is_empty() {
        let what = only.map_or_else(String::new, |kind| format!(" of the kind {}", kind.name()));
        return Err(RunError::Usage(format!("{}: has no events{what}", file.display())));
    }
    match recordings.iter().find(|recording| recording.trajectory.steps() == 0) {
        Some(recording) => Err(RunError::StartAlone {
            file: file.to_owned(),
            id: recording.id.clone(),
            needed: "to compare minds with it, at least one step is needed",
        }),
        None => Ok(recordings),
    }
}

/// The hypothesis that the labels of a scene state.
pub(crate) fn truth(scene: &Scene) -> Hypothesis {
    let attitudes = scene.agents.map(|agent| agent.attitude);
    let strengths = scene.agents.map(|agent| agent.strength);
    Hypothesis::new(scene.goals(), attitudes, strengths)
}

/// Whether an intent of an agent is its part of a hypothesis.
pub(crate) fn is_true(intent: &Intent, truth: &Hypothesis, agent: AgentId) -> bool {
    let goal: Goal = match truth.attitudes[agent] {
        Attitude::Neutral => truth.goals[agent],
        Attitude::Help | Attitude::Hinder => truth.goals[agent.other()],
    };
    intent.attitude == truth.attitudes[agent] && canonical(intent.goal) == canonical(goal)
}

/// Settings of the report, as in its file.
fn description(arguments: &CheckMinds, plan: &Measurement) -> Value {
    json!({
        "command": "check-minds", "generator": GENERATOR, "seed": plan.seed,
        "only": arguments.only.map(EventKind::name), "ids": arguments.ids,
        "minds": plan.open_loop.minds.kind().name(), "observed": plan.observed, "open_loop": plan.open_loop,
        "open_loop_seeds": plan.open_loop_seeds,
    })
}
