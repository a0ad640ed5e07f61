//! Words for people: the colours of bodies and landmarks, goals, attitudes and kinds of events.
//!
//! Pages, captions, instructions and tables take their words from here, so that what a film draws has one
//! name everywhere. Colours depend on the palette of a film and are therefore [`Names`]; [`Names::PAPER`] is
//! that of the published videos.
//!
//! ```
//! use phase_model::{AgentId, Goal, LandmarkId, ObjectId, Sign, words::Names};
//!
//! let object = ObjectId::ZERO;
//! let landmark = LandmarkId::TOP_LEFT;
//! let goal = Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive };
//! let names = Names::PAPER;
//! assert_eq!(names.wants(goal, AgentId::ZERO), "the light blue object on the blue landmark");
//! assert_eq!(names.wants_briefly(goal, AgentId::ZERO), "light blue object on blue");
//! ```

use crate::{AGENT_COUNT, AgentId, Attitude, Entity, EventKind, Goal, LandmarkId, MAX_OBJECTS, Sign};

/// The names of the colours in which bodies and landmarks are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Names {
    /// Colours of agents 0 and 1, such as `red`.
    pub agents: [&'static str; AGENT_COUNT],
    /// Colours of objects 0 and 1, such as `light blue`.
    pub objects: [&'static str; MAX_OBJECTS],
    /// Colours of landmarks 0 to 3, such as `blue`.
    pub landmarks: [&'static str; 4],
}

/// A piece of a sentence. Entities and landmarks are kept apart so that a page can give them their colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fragment {
    /// Words.
    Text(&'static str),
    /// An agent or object.
    Entity(Entity),
    /// A landmark.
    Landmark(LandmarkId),
}

impl Names {
    /// The colours of the published videos.
    pub const PAPER: Self = Self {
        agents: ["red", "green"],
        objects: ["light blue", "pink"],
        landmarks: ["blue", "green", "red", "yellow"],
    };

    /// An entity by its colour, such as `red agent`.
    #[must_use]
    pub fn entity(&self, entity: Entity) -> String {
        match entity {
            Entity::Agent(agent) => format!("{} agent", self.agents[agent]),
            Entity::Object(object) => format!("{} object", self.objects[object]),
        }
    }

    /// A landmark by its colour, such as `blue landmark`.
    #[must_use]
    pub fn landmark(&self, landmark: LandmarkId) -> String {
        format!("{} landmark", self.landmarks[landmark.index()])
    }

    /// A landmark by its colour and its place, such as `blue landmark (top left)`.
    #[must_use]
    pub fn landmark_and_place(&self, landmark: LandmarkId) -> String {
        format!("{} ({})", self.landmark(landmark), corner(landmark))
    }

    /// A goal of an agent as the end of the sentence "it wants …", as raters read it in the forms of studies:
    /// `the pink object on the blue landmark`, `to be on the green landmark`, `to touch the other agent`.
    #[must_use]
    pub fn wants(&self, goal: Goal, whose: AgentId) -> String {
        let place = match goal.sign() {
            Sign::Positive => "on",
            Sign::Negative => "away from",
        };
        match goal {
            Goal::AgentOnLandmark { agent, landmark, .. } if agent == whose => {
                format!("to be {place} the {}", self.landmark(landmark))
            }
            Goal::AgentOnLandmark { landmark, .. } | Goal::ObjectOnLandmark { landmark, .. } => {
                format!("the {} {place} the {}", self.entity(goal.subject()), self.landmark(landmark))
            }
            Goal::Touch { sign: Sign::Positive, .. } => "to touch the other agent".to_owned(),
            Goal::Touch { sign: Sign::Negative, .. } => "to get away from the other agent".to_owned(),
        }
    }

    /// The words of [`wants`](Self::wants) without articles and obvious nouns, for a line below a picture:
    /// `pink object on blue`, `to be on green`, `to touch the other`.
    #[must_use]
    pub fn wants_briefly(&self, goal: Goal, whose: AgentId) -> String {
        let text = self.wants(goal, whose);
        match goal {
            Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => {
                text.replace("the ", "").trim_end_matches(" landmark").to_owned()
            }
            Goal::Touch { .. } => text.trim_end_matches(" agent").to_owned(),
        }
    }

    /// A sentence of fragments as plain text; landmarks with their places.
    #[must_use]
    pub fn plain(&self, fragments: &[Fragment]) -> String {
        let word = |fragment: &Fragment| match *fragment {
            Fragment::Text(text) => text.to_owned(),
            Fragment::Entity(entity) => self.entity(entity),
            Fragment::Landmark(landmark) => self.landmark_and_place(landmark),
        };
        fragments.iter().map(word).collect()
    }
}

/// The corner of the arena in which a landmark and its room are, such as `top left`.
#[must_use]
pub const fn corner(landmark: LandmarkId) -> &'static str {
    match landmark {
        LandmarkId::TOP_LEFT => "top left",
        LandmarkId::TOP_RIGHT => "top right",
        LandmarkId::BOTTOM_RIGHT => "bottom right",
        _ => "bottom left",
    }
}

/// A goal of an agent as the end of the sentence "it wants to …".
#[must_use]
pub fn wants_to(goal: Goal, whose: AgentId) -> Vec<Fragment> {
    use Fragment::{Entity as Who, Landmark, Text};
    match (goal, goal.sign()) {
        (Goal::AgentOnLandmark { agent, landmark, .. }, Sign::Positive) if agent == whose => {
            vec![Text("go to the "), Landmark(landmark)]
        }
        (Goal::AgentOnLandmark { agent, landmark, .. }, Sign::Positive) => {
            vec![Text("get the "), Who(Entity::Agent(agent)), Text(" to the "), Landmark(landmark)]
        }
        (Goal::ObjectOnLandmark { object, landmark, .. }, Sign::Positive) => {
            vec![Text("put the "), Who(Entity::Object(object)), Text(" on the "), Landmark(landmark)]
        }
        (
            Goal::AgentOnLandmark { landmark, .. } | Goal::ObjectOnLandmark { landmark, .. },
            Sign::Negative,
        ) => {
            vec![Text("keep the "), Who(goal.subject()), Text(" off the "), Landmark(landmark)]
        }
        (Goal::Touch { agent, other, .. }, Sign::Positive) if agent == whose => {
            vec![Text("catch the "), Who(Entity::Agent(other))]
        }
        (Goal::Touch { agent, other, .. }, Sign::Positive) => {
            vec![Text("let the "), Who(Entity::Agent(agent)), Text(" reach the "), Who(Entity::Agent(other))]
        }
        (Goal::Touch { .. }, Sign::Negative) => {
            vec![Text("get away from the "), Who(Entity::Agent(whose.other()))]
        }
    }
}

/// The verb of an attitude towards the other agent: `helps`, `is neutral`, `hinders`.
#[must_use]
pub const fn attitude(attitude: Attitude) -> &'static str {
    match attitude {
        Attitude::Help => "helps",
        Attitude::Neutral => "is neutral",
        Attitude::Hinder => "hinders",
    }
}

/// A sentence on each kind of event, such as `one agent helps the other with its goal`.
#[must_use]
pub const fn kind(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Helping => "one agent helps the other with its goal",
        EventKind::Hindering => "one agent keeps the other from its goal",
        EventKind::Chasing => "one agent runs after the other, which gets away",
        EventKind::Competing => "both want the same object on different landmarks",
        EventKind::Collaborating => "both want the same object on the same landmark",
        EventKind::Independent => "each minds its own goal",
    }
}
