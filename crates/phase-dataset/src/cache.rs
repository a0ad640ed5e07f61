//! Finished events kept for a later run, in `bincode`.
//!
//! This is the only place that knows the encoding. It is for internal use between two runs of the same
//! program: a cache that is foreign, damaged, or of another program or other settings is not an error; it is
//! ignored, and the event is generated again.

use crate::{WriteError, atomic, checksum::sha256};
use phase_event::{Event, Step, Thought};
use phase_model::{
    AGENT_COUNT, Action, AgentId, AgentSpec, Attitude, Body, EventKind, Flip, Goal, LandmarkId, Layout,
    ObjectId, ObjectSpec, Scene, Sign, Size, State, Strength, arena::SUBSTEPS,
};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// First bytes of every cache file; the last is the version of what follows.
const MAGIC: [u8; 8] = *b"PHASEch1";
/// No event comes near this size (bytes); a greater length indicates damage.
const LIMIT: usize = 1 << 28;

/// A folder of cached events that were all generated in the same way.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
    fingerprint: [u8; 32],
}

impl Cache {
    /// A cache in a folder, which must exist when something is stored. `fingerprint` is a digest of
    /// everything that determines an event besides its id and seed: the program and its settings.
    #[must_use]
    pub fn new(folder: &Path, fingerprint: [u8; 32]) -> Self {
        Self { folder: folder.to_owned(), fingerprint }
    }

    /// The event stored under an id and seed, if there is a valid one.
    #[must_use]
    pub fn load(&self, id: &str, seed: u64) -> Option<Event> {
        let bytes = std::fs::read(self.path(id)).ok()?;
        let payload = bytes.strip_prefix(&self.head(id, seed)[..])?;
        let (sum, payload) = payload.split_first_chunk::<32>()?;
        if *sum != sha256(payload) {
            return None;
        }
        let config = bincode::config::standard().with_limit::<LIMIT>();
        let (cached, read): (CachedEvent, usize) = bincode::serde::decode_from_slice(payload, config).ok()?;
        (read == payload.len()).then(|| cached.into_event(seed))?
    }

    /// Stores an event.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn store(&self, id: &str, event: &Event) -> Result<(), WriteError> {
        let path = self.path(id);
        let config = bincode::config::standard().with_limit::<LIMIT>();
        let payload = bincode::serde::encode_to_vec(CachedEvent::of(event), config).map_err(|error| {
            let source = std::io::Error::other(error);
            WriteError { path: path.clone(), action: "encode the event", source }
        })?;
        let bytes = [&self.head(id, event.seed)[..], &sha256(&payload), &payload].concat();
        atomic::write(&path, &bytes)
    }

    fn path(&self, id: &str) -> PathBuf {
        self.folder.join(format!("{id}.bin"))
    }

    /// The header of every valid cache file.
    fn head(&self, id: &str, seed: u64) -> Vec<u8> {
        let key = [&self.fingerprint[..], id.as_bytes(), &seed.to_le_bytes()].concat();
        [&MAGIC[..], &sha256(&key)].concat()
    }
}

/// An event in types that do not describe themselves; `bincode` does not write such descriptions.
#[derive(Serialize, Deserialize)]
struct CachedEvent {
    layout: (u8, Option<u8>),
    agents: [(u8, u8, CachedGoal, i8, Body); AGENT_COUNT],
    objects: Vec<(u8, Body)>,
    kind: EventKind,
    initial: State,
    steps: Vec<CachedStep>,
}

#[derive(Serialize, Deserialize)]
struct CachedStep {
    actions: [Action; AGENT_COUNT],
    thoughts: [Thought; AGENT_COUNT],
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
                let (size, strength) = (agent.size.level(), agent.strength.level());
                (size, strength, CachedGoal::of(agent.goal), agent.attitude.alpha(), agent.start)
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
        for (size, strength, goal, alpha, start) in self.agents {
            agents.push(AgentSpec {
                size: Size::from_level(size)?,
                strength: Strength::from_level(strength)?,
                goal: goal.into_goal()?,
                attitude: Attitude::try_from(alpha).ok()?,
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
        let steps = self.steps.into_iter().map(CachedStep::into_step).collect();
        Some(Event { scene, seed, initial: self.initial, steps })
    }
}

impl CachedStep {
    fn of(step: &Step) -> Self {
        Self { actions: step.actions, thoughts: step.thoughts.clone(), substeps: step.substeps }
    }

    fn into_step(self) -> Step {
        Step { actions: self.actions, thoughts: self.thoughts, substeps: self.substeps }
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
