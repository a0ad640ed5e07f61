//! A scene: the complete configuration from which two agents and an environment generate an event.

use crate::{
    AGENT_COUNT, AgentBody, AgentId, Attitude, Awareness, Body, Entity, Flip, Goal, Layout, MAX_ENTITIES,
    MAX_OBJECTS, ObjectId, PhysicsConfig, Relation, Size, State, Strength,
};
use serde::{Deserialize, Serialize};

/// The kind of social event that a scene is set up for.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EventKind {
    /// One agent helps the other with its goal.
    Helping,
    /// One agent hinders the other.
    Hindering,
    /// One agent approaches the other, which gets away.
    Chasing,
    /// Both want the same object on different landmarks.
    Competing,
    /// Both want the same object on the same landmark.
    Collaborating,
    /// Each has its own goal and no interest in the other's.
    Independent,
}

impl EventKind {
    /// All kinds.
    pub const ALL: [Self; 6] = [
        Self::Helping,
        Self::Hindering,
        Self::Chasing,
        Self::Competing,
        Self::Collaborating,
        Self::Independent,
    ];

    /// The kind of a name, as [`name`](Self::name) gives it.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The kind that follows from goals and attitudes, as scenes are labelled: a non-neutral attitude
    /// decides, otherwise the relation and the subjects of the goals.
    #[must_use]
    pub fn of(goals: [Goal; AGENT_COUNT], attitudes: [Attitude; AGENT_COUNT]) -> Self {
        match Relation::of(goals, attitudes) {
            _ if attitudes.contains(&Attitude::Help) => Self::Helping,
            _ if attitudes.contains(&Attitude::Hinder) => Self::Hindering,
            Relation::Friendly => Self::Collaborating,
            Relation::Adversarial if matches!(goals[0], Goal::Touch { .. }) => Self::Chasing,
            Relation::Adversarial => Self::Competing,
            Relation::Neutral => Self::Independent,
        }
    }

    /// The name used in files and on screen.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Helping => "helping",
            Self::Hindering => "hindering",
            Self::Chasing => "chasing",
            Self::Competing => "competing",
            Self::Collaborating => "collaborating",
            Self::Independent => "independent",
        }
    }
}

/// An agent of a scene.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AgentSpec {
    /// Size of the body.
    pub size: Size,
    /// Maximum force.
    pub strength: Strength,
    /// The goal. A helping agent has the other's goal, a hindering one the other's goal negated.
    pub goal: Goal,
    /// Social utility weight α towards the other agent.
    pub attitude: Attitude,
    /// Knowledge that it has without finding it out.
    pub awareness: Awareness,
    /// Pose and motion at the start.
    pub start: Body,
}

/// An object of a scene.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ObjectSpec {
    /// Size.
    pub size: Size,
    /// Pose and motion at the start.
    pub start: Body,
}

/// The physical and the social configuration of an event (paper, "Joint Physical-Social Simulation").
///
/// It holds everything that a simulation needs besides its settings and seed: walls, bodies with sizes and
/// strengths, goals, attitudes, and the kind of event that it was set up for. Any values can be written down;
/// `validate` says which scenes are valid, and the functions that simulate or render one call it.
#[derive(Clone, PartialEq, Debug)]
pub struct Scene {
    /// The walls.
    pub layout: Layout,
    /// The two agents.
    pub agents: [AgentSpec; AGENT_COUNT],
    /// Zero to two objects.
    pub objects: Vec<ObjectSpec>,
    /// The kind of event the scene was made for.
    pub kind: EventKind,
}

impl Scene {
    /// The part of the scene that physics depends on. Objects past the second are ignored.
    #[must_use]
    pub fn physics(&self) -> PhysicsConfig {
        let mut object_radii = [0.0; MAX_OBJECTS];
        for (radius, object) in object_radii.iter_mut().zip(&self.objects) {
            *radius = object.size.radius();
        }
        PhysicsConfig {
            walls: self.layout.walls(),
            agents: self.agents.map(|agent| AgentBody {
                radius: agent.size.radius(),
                max_force: agent.strength.max_force(),
            }),
            object_radii,
            object_count: self.objects.len().min(MAX_OBJECTS),
        }
    }

    /// The state in which the event starts, without grips and contacts.
    #[must_use]
    pub fn initial_state(&self) -> State {
        let mut bodies = [Body::default(); MAX_ENTITIES];
        for (agent, spec) in AgentId::ALL.into_iter().zip(&self.agents) {
            bodies[Entity::Agent(agent)] = spec.start;
        }
        for (object, spec) in ObjectId::ALL.into_iter().zip(&self.objects) {
            bodies[Entity::Object(object)] = spec.start;
        }
        State::new(bodies)
    }

    /// Both goals.
    #[must_use]
    pub fn goals(&self) -> [Goal; AGENT_COUNT] {
        self.agents.map(|agent| agent.goal)
    }

    /// Both attitudes.
    #[must_use]
    pub fn attitudes(&self) -> [Attitude; AGENT_COUNT] {
        self.agents.map(|agent| agent.attitude)
    }

    /// The relation that follows from goals and attitudes.
    #[must_use]
    pub fn relation(&self) -> Relation {
        Relation::of(self.goals(), self.attitudes())
    }

    /// The whole scene mirrored: walls, starts and the landmarks of the goals. `None` if the layout is
    /// already reflected, because the composition of two reflections need not be a reflection.
    #[must_use]
    pub fn mirrored(&self, flip: Flip) -> Option<Self> {
        if self.layout.flip().is_some() {
            return None;
        }
        let agents = self.agents.map(|agent| AgentSpec {
            goal: agent.goal.mirrored(flip),
            start: agent.start.mirrored(flip),
            ..agent
        });
        let object = |object: &ObjectSpec| ObjectSpec { start: object.start.mirrored(flip), ..*object };
        let objects = self.objects.iter().map(object).collect();
        Some(Self { layout: self.layout.flipped(flip), agents, objects, kind: self.kind })
    }
}
