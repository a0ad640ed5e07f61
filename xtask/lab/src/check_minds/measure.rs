//! Everything that is measured about one event.

use super::{motion::Motion, truth};
use core::ops::ControlFlow;
use cpu_time::ThreadTime;
use phase_cli::progress::Progress;
use phase_event::{MethodError, ProgressCallback, Recording};
use phase_evidence::Track;
use phase_model::{AGENT_COUNT, AgentId, EventKind, State};
use phase_runs::{engine, error::RunError, interrupt::requested};
use phase_sim::{Engine, SimulationSettings};
use phase_simple::{
    ImaginedAgents, InversePlanningSettings, PreparedEvent,
    choice::{self, Chance},
};

/// Distance of a body from where it was recorded beyond which a simulation has parted from the recording (u):
/// less than the smallest body's diameter, and more than a step's motion.
const PARTED: f32 = 1.0;

/// Steps after which a simulation whose straying is measured is set to the observed state.
const RESYNC_INTERVAL: usize = 10;

/// Measurements that are wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measurement {
    /// The minds that decide at observed states.
    pub(super) observed: ImaginedAgents,
    /// The minds of the open loop.
    pub(super) open_loop: ImaginedAgents,
    /// Simulations of every scene in the open loop.
    pub(super) open_loop_seeds: u64,
    /// The seed; simulations in the open loop use those that follow, too.
    pub(super) seed: u64,
}

/// One event, measured.
#[derive(Clone, Debug)]
pub(super) struct MeasuredEvent {
    /// Its id.
    pub(super) id: String,
    /// Its kind.
    pub(super) kind: EventKind,
    /// The chance of what each agent did, by step.
    pub(super) chances: [Vec<Chance>; AGENT_COUNT],
    /// Whether inverse dynamics explains each step, so that it is known what was done.
    pub(super) explained: Vec<bool>,
    /// Deviation of simulations in which this agent decides and the other does what was inferred, by step
    /// (u).
    pub(super) deviations: [Vec<f64>; AGENT_COUNT],
    /// Deviation of simulations in which both decide, by step (u).
    pub(super) joint_deviations: Vec<f64>,
    /// Motion of the agents, as recorded.
    pub(super) recorded: Motion,
    /// Simulations in the open loop, by seed.
    pub(super) simulated: Vec<Simulated>,
}

/// One simulation in the open loop.
#[derive(Clone, Debug)]
pub(super) struct Simulated {
    /// Motion of the agents.
    pub(super) motion: Motion,
    /// Steps before the first in which it has parted from the recording.
    pub(super) together: usize,
    /// Distance of a body from where it was recorded, mean over bodies and steps (u).
    pub(super) distance: f64,
    /// CPU time of 100 steps (s).
    pub(super) cpu_seconds: f64,
}

impl Measurement {
    /// Approximate number of units of progress of an event of so many steps.
    pub(super) fn units(&self, steps: usize) -> usize {
        self.open_loop_seeds as usize * steps
    }

    /// Measures an event; `None` if it was interrupted.
    pub(super) fn measure(
        &self,
        recording: &Recording,
        progress: &Progress,
    ) -> Result<Option<MeasuredEvent>, RunError> {
        let id = &recording.id;
        let failed = |error: MethodError| RunError::Method { id: id.clone(), source: error };
        let mut units = 0;
        let mut tick = || {
            units += 1;
            progress.step();
            if requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let scene = &recording.scene;
        let truth = truth(scene);
        let observed = recording.observed().map_err(|error| failed(MethodError::new(error)))?;
        let prepared = PreparedEvent::new(&observed, self.observed, self.seed);
        let likelihoods = choice::action_likelihoods(&prepared, InversePlanningSettings::default().tolerance);
        let chances = |agent| {
            let chances = choice::chances(&prepared, &likelihoods, &truth, agent);
            chances.map_err(|error| failed(MethodError::new(error)))
        };
        let chances = [chances(AgentId::ZERO)?, chances(AgentId::ONE)?];
        let deviations = |agent| -> Result<Vec<f64>, RunError> {
            let decisions = prepared.simulate_agent(&truth, agent, RESYNC_INTERVAL);
            let decisions = decisions.map_err(|error| failed(MethodError::new(error)))?;
            Ok(decisions.iter().map(|decided| decided.deviation).collect())
        };
        let deviations = [deviations(AgentId::ZERO)?, deviations(AgentId::ONE)?];
        let joint_deviations = prepared
            .simulate(&truth, Some(RESYNC_INTERVAL), f64::INFINITY)
            .map_err(|error| failed(MethodError::new(error)))?;
        let recorded_track = Track { physics: scene.physics(), states: recording.trajectory.states() };
        let mut simulated = Vec::new();
        for seed in (0..self.open_loop_seeds).map(|k| self.seed.wrapping_add(k)) {
            let Some(run) = self.open_loop(recording, seed, &mut tick)? else { return Ok(None) };
            simulated.push(run);
        }
        progress.event(units, id);
        Ok(Some(MeasuredEvent {
            id: id.clone(),
            kind: scene.kind,
            chances,
            explained: prepared.motion().explained().collect(),
            deviations,
            joint_deviations,
            recorded: Motion::of(scene, &recorded_track),
            simulated,
        }))
    }

    /// Simulates the scene of a recording for as many steps as were recorded; `None` if it was interrupted.
    fn open_loop(
        &self,
        recording: &Recording,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<Simulated>, RunError> {
        let steps = recording.trajectory.steps();
        // The world that made recordings has the recorder's defects.
        let as_recorded = self.open_loop.one_way_turns && self.open_loop.strongest_coasts;
        let settings = SimulationSettings {
            engine: if as_recorded { Engine::Original } else { Engine::World },
            max_steps: steps,
            min_steps: steps,
            one_way_turns: self.open_loop.one_way_turns,
            strongest_coasts: self.open_loop.strongest_coasts,
            minds: self.open_loop.minds,
            ..SimulationSettings::default()
        };
        let begun = ThreadTime::now();
        let event = engine::simulate(&recording.id, &recording.scene, seed, &settings, &mut |_| tick())?;
        let cpu_seconds = begun.elapsed().as_secs_f64() * 100.0 / steps as f64;
        Ok(event.map(|event| {
            let track = Track::of_event(&event);
            let distances = distances(recording, &track);
            let farthest = |row: &Vec<f32>| row.iter().copied().fold(0.0, f32::max);
            let together = distances.iter().position(|row| farthest(row) > PARTED);
            let all: Vec<f64> = distances.iter().flatten().copied().map(f64::from).collect();
            Simulated {
                motion: Motion::of(&recording.scene, &track),
                together: together.unwrap_or(distances.len()),
                distance: phase_statistics::mean(&all).unwrap_or(0.0),
                cpu_seconds,
            }
        }))
    }
}

/// Distance of each body from where it was recorded, after each step (u).
fn distances(recording: &Recording, track: &Track) -> Vec<Vec<f32>> {
    let recorded = recording.trajectory.states();
    let bodies = AGENT_COUNT + recording.scene.objects.len();
    let of = |(ours, theirs): (&State, State)| {
        let both = ours.bodies.iter().zip(&theirs.bodies).take(bodies);
        both.map(|(own, other)| own.position.distance(other.position)).collect()
    };
    track.states.iter().zip(recorded).skip(1).map(of).collect()
}
