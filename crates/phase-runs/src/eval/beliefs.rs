//! Places at which agents believe entities to be, compared with their particles.

use super::{Answers, answers::AnswerSource, input::Event, methods, task::Task};
use crate::error::RunError;
use phase_eval::beliefs::{BeliefEvent, asked_steps};
use phase_event::{
    BeliefReader, Beliefs, MethodError, ProgressCallback, Recording, SimulationRecord, others, whereabouts,
};
use phase_model::{AGENT_COUNT, AgentId, BodySet, Entity, State, json::FieldError, layout::room_of};
use phase_perception::observed_set;
use phase_sim::SimulationSettings;
use serde_json::{Value, json};
use std::path::Path;

/// The task.
pub(crate) struct BeliefTask {
    answers: AnswerSource<dyn BeliefReader, Vec<Beliefs>>,
}

impl BeliefTask {
    /// The task for the answers of a method.
    pub(crate) fn of(answers: &Answers) -> Result<Self, RunError> {
        let file = |_: &Path| Err(RunError::Usage("--predictions: not of beliefs; give a --method".into()));
        Ok(Self { answers: AnswerSource::of(answers, methods::belief_reader, file)? })
    }
}

impl Task for BeliefTask {
    type Method = dyn BeliefReader;
    type Answer = Vec<Beliefs>;
    type ScoredEvent = BeliefEvent;

    const NAME: &'static str = "beliefs";

    fn answers(&self) -> &AnswerSource<dyn BeliefReader, Vec<Beliefs>> {
        &self.answers
    }

    fn settings(&self) -> Value {
        self.answers.settings(|method| json!({ "method": method.settings() }))
    }

    fn ticks(&self) -> usize {
        self.answers.method().map_or(1, BeliefReader::ticks)
    }

    fn check(&self, event: &Event, file: &Path) -> Result<(), RunError> {
        if !event.simulated {
            let rule = "was not simulated, so nobody knows its agents' beliefs";
            return Err(RunError::Usage(format!("{}: event {}: {rule}", file.display(), event.id)));
        }
        if !asked_steps(event.steps).is_empty() {
            return Ok(());
        }
        let needed = "beliefs are asked about every four steps";
        Err(RunError::StartAlone { file: file.to_owned(), id: event.id.clone(), needed })
    }

    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<BeliefEvent>, MethodError> {
        let Some(simulation) = &recording.simulation else {
            return Err(MethodError::new("was not simulated, so nobody knows its agents' beliefs"));
        };
        let observed = recording.observed().map_err(MethodError::new)?;
        let steps = asked_steps(observed.steps());
        let asked =
            self.answers.answer(event, |method| method.read_beliefs(&observed, &steps, seed, tick))?;
        let Some((answers, details, cpu_seconds)) = asked else { return Ok(None) };
        let truth = Truth::of(simulation).map_err(MethodError::new)?;
        let moved =
            |step: usize, agent: AgentId, entity: usize| truth.was_moved(step, agent, Entity::ALL[entity]);
        let beliefs: Vec<Beliefs> = steps.iter().map(|&step| truth.beliefs(step)).collect();
        let questions = BeliefEvent::questions(&steps, truth.objects, &beliefs, &answers, moved);
        let questions = questions.map_err(MethodError::new)?;
        Ok(Some(BeliefEvent { id: event.id.clone(), questions, cpu_seconds, details }))
    }
}

/// The beliefs of the agents of a simulated event.
struct Truth {
    objects: usize,
    /// The state before the first step and after every one.
    states: Vec<State>,
    /// The bodies that each agent sees in them with its own eyes.
    seen: Vec<[BodySet; AGENT_COUNT]>,
    particles: [Vec<Vec<State>>; AGENT_COUNT],
}

impl Truth {
    fn of(simulation: &SimulationRecord) -> Result<Self, FieldError> {
        let event = &simulation.event;
        let minds = SimulationSettings::read(&simulation.settings, "settings")?.minds;
        let physics = event.scene.physics();
        let states = phase_questions::Inside::states_of(event);
        let seen = |state: &State| AgentId::ALL.map(|agent| observed_set(&physics, state, agent));
        let particles = AgentId::ALL.map(|agent| {
            phase_sim::beliefs(event, agent, &minds).into_iter().map(|snapshot| snapshot.particles).collect()
        });
        let seen = states.iter().map(seen).collect();
        Ok(Self { objects: event.scene.objects.len(), states, seen, particles })
    }

    fn beliefs(&self, step: usize) -> Beliefs {
        AgentId::ALL.map(|agent| {
            let of = |entity: Entity| {
                whereabouts(&self.particles[agent][step], entity, self.seen[step][agent].contains(entity))
            };
            others(agent, self.objects).map(of).collect()
        })
    }

    /// Whether an entity is in another room than when an agent could last see it, or at the start.
    fn was_moved(&self, step: usize, agent: AgentId, entity: Entity) -> bool {
        let then = (0..=step).rev().find(|&t| self.seen[t][agent].contains(entity)).unwrap_or(0);
        let room = |t: usize| room_of(self.states[t].position(entity));
        room(then) != room(step)
    }
}
