//! Finished events kept for a later run of the same program.

use phase_event::{BelievedIntent, Event, Step, Thought};
use phase_files::{WriteError, cache::Cache};
use phase_model::{
    AGENT_COUNT, Action, AgentId, AgentSpec, Attitude, Awareness, Body, EventKind, Flip, Goal, Intent,
    LandmarkId, Layout, ObjectId, ObjectSpec, Scene, Sign, Size, State, Strength, arena::SUBSTEPS,
};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A folder of cached events that were all generated in one way.
#[derive(Clone, Debug)]
pub struct EventCache(Cache);

impl EventCache {
    /// A cache in a folder, which must exist when something is stored. `fingerprint` is a digest of
    /// everything that determines an event besides its id and seed: the program and its settings.
    #[must_use]
    pub fn new(folder: &Path, fingerprint: [u8; 32]) -> Self {
        Self(Cache::new(folder, fingerprint))
    }

    /// The event stored under an id and seed, if there is a valid one.
    #[must_use]
    pub fn load(&self, id: &str, seed: u64) -> Option<Event> {
        self.0.load::<CachedEvent>(id, seed)?.into_event(seed)
    }

    /// Stores an event.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn store(&self, id: &str, event: &Event) -> Result<(), WriteError> {
        self.0.store(id, event.seed, &CachedEvent::of(event))
    }
}

/// An event in types that do not describe themselves, since the cache stores no descriptions.
#[derive(Serialize, Deserialize)]
struct CachedEvent {
    layout: (u8, Option<u8>),
    agents: [(u8, u8, CachedGoal, i8, Awareness, Body); AGENT_COUNT],
    objects: Vec<(u8, Body)>,
    kind: EventKind,
    initial: State,
    steps: Vec<CachedStep>,
}

#[derive(Serialize, Deserialize)]
struct CachedStep {
    actions: [Action; AGENT_COUNT],
    thoughts: [Thought; AGENT_COUNT],
    /// Goal, α and particles of each intent that an agent believes the other to have.
    intents: [Vec<(CachedGoal, i8, usize)>; AGENT_COUNT],
    substeps: [State; SUBSTEPS],
}

#[derive(Clone, Copy, Serialize, Deserialize)]
enum CachedGoal {
    AgentOnLandmark(AgentId, LandmarkId, i8),
    ObjectOnLandmark(ObjectId, LandmarkId, i8),
    Touch(AgentId, AgentId, i8),
}

impl CachedEvent {
    fn of(event: &Event) -> Self {
        let scene = &event.scene;
        Self {
            layout: (scene.layout.base(), scene.layout.flip().map(u8::from)),
            agents: scene.agents.map(|agent| {
                let size = agent.size.level();
                let strength = agent.strength.level();
                (
                    size,
                    strength,
                    CachedGoal::of(agent.goal),
                    agent.attitude.alpha(),
                    agent.awareness,
                    agent.start,
                )
            }),
            objects: scene.objects.iter().map(|object| (object.size.level(), object.start)).collect(),
            kind: scene.kind,
            initial: event.initial,
            steps: event.steps.iter().map(CachedStep::of).collect(),
        }
    }

    fn into_event(self, seed: u64) -> Option<Event> {
        let (base, flip) = self.layout;
        let flip = flip.map(Flip::try_from).transpose().ok()?;
        let mut agents = Vec::with_capacity(AGENT_COUNT);
        for (size, strength, goal, alpha, awareness, start) in self.agents {
            agents.push(AgentSpec {
                size: Size::from_level(size)?,
                strength: Strength::from_level(strength)?,
                goal: goal.into_goal()?,
                attitude: Attitude::try_from(alpha).ok()?,
                awareness,
                start,
            });
        }
        let object = |(size, start)| Some(ObjectSpec { size: Size::from_level(size)?, start });
        let scene = Scene {
            layout: Layout::new(base, flip).ok()?,
            agents: agents.try_into().ok()?,
            objects: self.objects.into_iter().map(object).collect::<Option<_>>()?,
            kind: self.kind,
        };
        scene.validate().ok()?;
        let steps = self.steps.into_iter().map(CachedStep::into_step).collect::<Option<_>>()?;
        Some(Event { scene, seed, initial: self.initial, steps })
    }
}

impl CachedStep {
    fn of(step: &Step) -> Self {
        let of =
            |it: &BelievedIntent| (CachedGoal::of(it.intent.goal), it.intent.attitude.alpha(), it.particles);
        Self {
            actions: step.actions,
            thoughts: step.thoughts.clone(),
            intents: step.thoughts.each_ref().map(|thought| thought.intents.iter().map(of).collect()),
            substeps: step.substeps,
        }
    }

    fn into_step(mut self) -> Option<Step> {
        for (thought, intents) in self.thoughts.iter_mut().zip(self.intents) {
            for (goal, alpha, particles) in intents {
                let attitude = Attitude::try_from(alpha).ok()?;
                let intent = Intent { attitude, goal: goal.into_goal()? };
                thought.intents.push(BelievedIntent { intent, particles });
            }
        }
        Some(Step { actions: self.actions, thoughts: self.thoughts, substeps: self.substeps })
    }
}

impl CachedGoal {
    const fn of(goal: Goal) -> Self {
        match goal {
            Goal::AgentOnLandmark { agent, landmark, sign } => {
                Self::AgentOnLandmark(agent, landmark, sign.value())
            }
            Goal::ObjectOnLandmark { object, landmark, sign } => {
                Self::ObjectOnLandmark(object, landmark, sign.value())
            }
            Goal::Touch { agent, other, sign } => Self::Touch(agent, other, sign.value()),
        }
    }

    fn into_goal(self) -> Option<Goal> {
        let sign = |value: i8| Sign::try_from(value).ok();
        Some(match self {
            Self::AgentOnLandmark(agent, landmark, value) => {
                Goal::AgentOnLandmark { agent, landmark, sign: sign(value)? }
            }
            Self::ObjectOnLandmark(object, landmark, value) => {
                Goal::ObjectOnLandmark { object, landmark, sign: sign(value)? }
            }
            Self::Touch(agent, other, value) => Goal::Touch { agent, other, sign: sign(value)? },
        })
    }
}
