//! Places at which agents believe entities to be, compared with their particles.

use super::{Answers, answers::AnswerSource, input::Event, methods, networks, task::Task};
use crate::{error::RunError, source};
use phase_belief::{AscribedBelief, Glance};
use phase_eval::beliefs::{BeliefEvent, BeliefQuestion, asked_steps};
use phase_event::{
    BeliefOrder, BeliefReader, Beliefs, MethodError, ProgressCallback, Recording, SimulationRecord, others,
    whereabouts,
};
use phase_model::{
    AGENT_COUNT, AgentId, BodySet, Entity, Knowledge, Scene, Sight, State, json::FieldError, layout::room_of,
};
use phase_perception::observed_sets;
use phase_sim::SimulationSettings;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::Path;

/// The task.
pub(crate) struct BeliefTask {
    answers: AnswerSource<dyn BeliefReader, Vec<Beliefs>>,
    order: BeliefOrder,
}

impl BeliefTask {
    /// The task for the answers of a method about beliefs of an order.
    pub(crate) fn of(answers: &Answers, order: BeliefOrder) -> Result<Self, RunError> {
        let file = |_: &Path| Err(RunError::Usage("--predictions: not of beliefs; give a --method".into()));
        if let Answers::Method { name, .. } = answers
            && order == BeliefOrder::Second
            && networks::is_network(name)
        {
            let rule = "tells where agents believe entities to be, not what they ascribe to each other";
            return Err(RunError::Usage(format!("--order 2: method {name:?} {rule}")));
        }
        Ok(Self { answers: AnswerSource::of(answers, methods::belief_reader, file)?, order })
    }
}

impl Task for BeliefTask {
    type Method = dyn BeliefReader;
    type Answer = Vec<Beliefs>;
    type ScoredEvent = BeliefEvent;

    const NAME: &'static str = "beliefs";

    fn label(&self) -> &'static str {
        match self.order {
            BeliefOrder::First => Self::NAME,
            BeliefOrder::Second => "beliefs-about-beliefs",
        }
    }

    fn answers(&self) -> &AnswerSource<dyn BeliefReader, Vec<Beliefs>> {
        &self.answers
    }

    fn settings(&self) -> Value {
        self.answers.settings(|method| json!({ "method": method.settings(), "order": self.order }))
    }

    fn ticks(&self) -> usize {
        self.answers.method().map_or(1, BeliefReader::ticks)
    }

    fn check(&self, event: &Event, file: &Path) -> Result<(), RunError> {
        check_simulated(event, file)
    }

    fn check_contents(&self, recording: &Recording, file: &Path) -> Result<(), RunError> {
        check_settings(recording, file)
    }

    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<BeliefEvent>, MethodError> {
        let observed = recording.observed().map_err(MethodError::new)?;
        let steps = asked_steps(observed.steps());
        let asked = self
            .answers
            .answer(event, |method| method.read_beliefs(&observed, self.order, &steps, seed, tick))?;
        let Some((answers, details, cpu_seconds)) = asked else { return Ok(None) };
        let questions =
            TrueBeliefs::of(recording, self.order, &steps)?.questions(&answers).map_err(MethodError::new)?;
        Ok(Some(BeliefEvent { id: event.id.clone(), order: self.order, questions, cpu_seconds, details }))
    }
}

/// Checks that the settings of a simulated event can be read, which tell what its agents believe.
pub(super) fn check_settings(recording: &Recording, file: &Path) -> Result<(), RunError> {
    let Some(simulation) = &recording.simulation else { return Ok(()) };
    source::settings(file, &recording.id, simulation).map(drop)
}

/// Checks that an event was simulated and is long enough to ask about.
pub(super) fn check_simulated(event: &Event, file: &Path) -> Result<(), RunError> {
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

/// The beliefs of the agents of a simulated event after some steps.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct TrueBeliefs {
    order: BeliefOrder,
    steps: Vec<usize>,
    objects: usize,
    beliefs: Vec<Beliefs>,
    /// After each step and for each agent the entities that were moved since the agent could last see them.
    moved: Vec<[Vec<Entity>; AGENT_COUNT]>,
}

impl TrueBeliefs {
    /// The beliefs of an order after some steps of an event.
    ///
    /// # Errors
    /// [`MethodError`] if the event was not simulated, or its settings are not those of a simulation.
    pub fn of(recording: &Recording, order: BeliefOrder, steps: &[usize]) -> Result<Self, MethodError> {
        let Some(simulation) = &recording.simulation else {
            return Err(MethodError::new("was not simulated, so nobody knows its agents' beliefs"));
        };
        let truth = Truth::of(simulation).map_err(MethodError::new)?;
        let moved = |&step: &usize| {
            AgentId::ALL.map(|agent| {
                let viewer = order.viewer(agent);
                others(viewer, truth.objects).filter(|&it| truth.was_moved(step, viewer, it)).collect()
            })
        };
        Ok(Self {
            order,
            steps: steps.to_vec(),
            objects: truth.objects,
            beliefs: match order {
                BeliefOrder::First => steps.iter().map(|&step| truth.beliefs(step)).collect(),
                BeliefOrder::Second => truth.ascribed(&simulation.event.scene, steps),
            },
            moved: steps.iter().map(moved).collect(),
        })
    }

    /// The beliefs after each of the steps.
    #[must_use]
    pub fn beliefs(&self) -> &[Beliefs] {
        &self.beliefs
    }

    /// The questions about these beliefs, with the answers of a method.
    ///
    /// # Errors
    /// As [`BeliefEvent::questions`].
    pub fn questions(&self, answers: &[Beliefs]) -> Result<Vec<BeliefQuestion>, String> {
        let moved = |step: usize, agent: AgentId, entity: usize| {
            let at = self.steps.iter().position(|&it| it == step);
            at.is_some_and(|at| self.moved[at][agent].contains(&Entity::ALL[entity]))
        };
        BeliefEvent::questions(self.order, &self.steps, self.objects, &self.beliefs, answers, moved)
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
        let particles = AgentId::ALL.map(|agent| {
            phase_sim::beliefs(event, agent, &minds).into_iter().map(|snapshot| snapshot.particles).collect()
        });
        let seen = observed_sets(&physics, &states);
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

    /// The beliefs that each agent ascribes to the other after some steps. An agent that knows the other's
    /// goal knows its senses, too; another takes it to have its own eyes alone.
    fn ascribed(&self, scene: &Scene, steps: &[usize]) -> Vec<Beliefs> {
        let physics = scene.physics();
        let mut beliefs: Vec<Beliefs> = steps.iter().map(|_| [const { Vec::new() }; AGENT_COUNT]).collect();
        for agent in AgentId::ALL {
            let other = agent.other();
            let sees = match scene.agents[agent].awareness.knows {
                Knowledge::Goals => scene.agents[other].awareness.sees,
                Knowledge::Nothing(_) => Sight::Own,
            };
            let glance = |particles: &Vec<State>| Glance::of(&physics, particles, other);
            let glances: Vec<Glance> = self.particles[agent].iter().map(glance).collect();
            let ascribed = AscribedBelief::along(&glances, sees);
            for (&step, beliefs) in steps.iter().zip(&mut beliefs) {
                let of = |entity: Entity| ascribed[step].places(entity);
                beliefs[agent] = others(other, self.objects).map(of).collect();
            }
        }
        beliefs
    }

    /// Whether an entity is in another room than when an agent could last see it, or at the start.
    fn was_moved(&self, step: usize, agent: AgentId, entity: Entity) -> bool {
        let then = (0..=step).rev().find(|&t| self.seen[t][agent].contains(entity)).unwrap_or(0);
        let room = |t: usize| room_of(self.states[t].position(entity));
        room(then) != room(step)
    }
}
