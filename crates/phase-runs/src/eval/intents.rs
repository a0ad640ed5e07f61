//! Intents that agents without knowledge take each other to have, compared with their particles.

use super::{
    Answers,
    answers::AnswerSource,
    beliefs::{check_settings, check_simulated},
    input::Event,
    methods,
    task::Task,
};
use crate::error::RunError;
use phase_eval::{
    beliefs::asked_steps,
    intents::{BelievedIntents, IntentEvent, IntentQuestion},
};
use phase_event::{MethodError, MethodResult, ObservedEvent, ProgressCallback, Recording, SimulationRecord};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Intent, Knowledge, Scene, json::FieldError};
use phase_sim::SimulationSettings;
use phase_simple::{NeutralKnowledge, Simple};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};

/// A method that tells what agents take each other to want.
pub(crate) enum IntentReader {
    /// SIMPLE; without latent knowledge it takes agents to know what the other wants.
    Simple(Box<Simple>),
    /// All intents are as likely as each other.
    Even,
}

impl IntentReader {
    fn settings(&self) -> Value {
        match self {
            Self::Simple(simple) => json!({
                "inference": phase_event::Recogniser::settings(&**simple),
                "neutral_knowledge": NeutralKnowledge::default(),
            }),
            Self::Even => Value::Null,
        }
    }

    fn ticks(&self) -> usize {
        match self {
            Self::Simple(simple) => phase_event::Recogniser::ticks(&**simple),
            Self::Even => 1,
        }
    }

    fn read(
        &self,
        observed: &ObservedEvent,
        steps: &[usize],
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Vec<BelievedIntents>> {
        match self {
            Self::Simple(simple) => simple.believed_intents(observed, steps, seed, tick),
            Self::Even => {
                let objects = observed.object_sizes().len();
                let believed = AgentId::ALL.map(|agent| {
                    let intents = Intent::all(agent.other(), objects);
                    let share = 1.0 / intents.len() as f64;
                    intents.into_iter().map(|intent| (intent, share)).collect()
                });
                Ok(Some((vec![believed; steps.len()], Value::Null)))
            }
        }
    }
}

/// The task.
pub(crate) struct IntentTask {
    answers: AnswerSource<IntentReader, Vec<BelievedIntents>>,
}

impl IntentTask {
    /// The task for the answers of a method.
    pub(crate) fn of(answers: &Answers) -> Result<Self, RunError> {
        let file = |_: &Path| Err(RunError::Usage("--predictions: not of intents; give a --method".into()));
        Ok(Self { answers: AnswerSource::of(answers, methods::intent_reader, file)? })
    }
}

impl Task for IntentTask {
    type Method = IntentReader;
    type Answer = Vec<BelievedIntents>;
    type ScoredEvent = IntentEvent;

    const NAME: &'static str = "intents";

    fn answers(&self) -> &AnswerSource<IntentReader, Vec<BelievedIntents>> {
        &self.answers
    }

    fn settings(&self) -> Value {
        self.answers.settings(|method| json!({ "method": method.settings() }))
    }

    fn ticks(&self) -> usize {
        self.answers.method().map_or(1, IntentReader::ticks)
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
    ) -> Result<Option<IntentEvent>, MethodError> {
        let observed = recording.observed().map_err(MethodError::new)?;
        let steps = asked_steps(observed.steps());
        let asked = self.answers.answer(event, |method| method.read(&observed, &steps, seed, tick))?;
        let Some((answers, details, cpu_seconds)) = asked else { return Ok(None) };
        let questions = TrueIntents::of(recording, &steps)?.questions(&answers).map_err(MethodError::new)?;
        Ok(Some(IntentEvent { id: event.id.clone(), questions, cpu_seconds, details }))
    }
}

/// The intents that agents of a simulated event take each other to have after some steps.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct TrueIntents {
    steps: Vec<usize>,
    /// After each step and for each agent, with shares of its particles.
    believed: Vec<[Vec<(Intent, f64)>; AGENT_COUNT]>,
    intents: [Intent; AGENT_COUNT],
}

impl TrueIntents {
    /// The intents in the particles of each agent after some steps of an event.
    ///
    /// # Errors
    /// [`MethodError`] if the event was not simulated, or its settings are not those of a simulation.
    pub fn of(recording: &Recording, steps: &[usize]) -> Result<Self, MethodError> {
        let Some(simulation) = &recording.simulation else {
            return Err(MethodError::new("was not simulated, so nobody knows its agents' beliefs"));
        };
        let believed = truth(simulation, steps).map_err(MethodError::new)?;
        Ok(Self {
            steps: steps.to_vec(),
            believed: believed.into_iter().map(|it| it.map(|of| of.into_iter().collect())).collect(),
            intents: intents_of(&simulation.event.scene),
        })
    }

    /// The questions about them, with the answers of a method.
    ///
    /// # Errors
    /// A sentence, if the answers are too few, or no probabilities.
    pub fn questions(&self, answers: &[BelievedIntents]) -> Result<Vec<IntentQuestion>, String> {
        let maps = |it: &[Vec<(Intent, f64)>; AGENT_COUNT]| it.clone().map(BTreeMap::from_iter);
        let believed: Vec<BelievedIntents> = self.believed.iter().map(maps).collect();
        IntentEvent::questions(&self.steps, &believed, answers, self.intents)
    }
}

/// The intents in the particles of each agent after some steps; none of an agent that knows the other's goal.
fn truth(simulation: &SimulationRecord, steps: &[usize]) -> Result<Vec<BelievedIntents>, FieldError> {
    let event = &simulation.event;
    let minds = SimulationSettings::read(&simulation.settings, "settings")?.minds;
    let mut all: Vec<BelievedIntents> = steps.iter().map(|_| BelievedIntents::default()).collect();
    for agent in AgentId::ALL {
        if event.scene.agents[agent].awareness.knows == Knowledge::Goals {
            continue;
        }
        let beliefs = phase_sim::beliefs(event, agent, &minds);
        for (&step, believed) in steps.iter().zip(&mut all) {
            let suppositions = &beliefs[step].suppositions;
            for supposition in suppositions {
                let share = 1.0 / suppositions.len() as f64;
                *believed[agent].entry(supposition.intent).or_default() += share;
            }
        }
    }
    Ok(all)
}

/// The intents that the agents of a scene have.
fn intents_of(scene: &Scene) -> [Intent; AGENT_COUNT] {
    let (goals, attitudes) = (scene.goals(), scene.attitudes());
    AgentId::ALL.map(|agent| {
        let attitude = attitudes[agent];
        let owner = if attitude == Attitude::Neutral { agent } else { agent.other() };
        Intent { attitude, goal: goals[owner] }
    })
}
