//! Scenes in words, for people: colours for numbers, sentences for goals.

use phase_model::{
    AgentId, Attitude, Entity, EventKind, Goal, LandmarkId, ObjectId, Relation, Sign, Size, Strength,
};

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

/// What an entity looks like in videos, such as `red agent`.
#[must_use]
pub const fn entity(entity: Entity) -> &'static str {
    match entity {
        Entity::Agent(AgentId::ZERO) => "red agent",
        Entity::Agent(_) => "green agent",
        Entity::Object(ObjectId::ZERO) => "blue object",
        Entity::Object(_) => "pink object",
    }
}

/// What a landmark looks like in videos, and where it is.
#[must_use]
pub const fn landmark(landmark: LandmarkId) -> &'static str {
    match landmark {
        LandmarkId::TOP_LEFT => "blue landmark (top left)",
        LandmarkId::TOP_RIGHT => "green landmark (top right)",
        LandmarkId::BOTTOM_RIGHT => "red landmark (bottom right)",
        _ => "yellow landmark (bottom left)",
    }
}

/// A goal of an agent as the end of the sentence "it wants to …".
#[must_use]
pub fn goal(agent: AgentId, goal: Goal) -> Vec<Fragment> {
    use Fragment::{Entity as Who, Landmark, Text};
    let me = Entity::Agent(agent);
    match (goal, goal.sign()) {
        (Goal::AgentOnLandmark { agent, landmark, .. }, Sign::Positive) if Entity::Agent(agent) == me => {
            vec![Text("go to the "), Landmark(landmark)]
        }
        (Goal::AgentOnLandmark { agent, landmark, .. }, Sign::Positive) => {
            vec![Text("get the "), Who(Entity::Agent(agent)), Text(" to the "), Landmark(landmark)]
        }
        (Goal::AgentOnLandmark { agent, landmark, .. }, Sign::Negative) => {
            vec![Text("keep the "), Who(Entity::Agent(agent)), Text(" off the "), Landmark(landmark)]
        }
        (Goal::ObjectOnLandmark { object, landmark, .. }, Sign::Positive) => {
            vec![Text("put the "), Who(Entity::Object(object)), Text(" on the "), Landmark(landmark)]
        }
        (Goal::ObjectOnLandmark { object, landmark, .. }, Sign::Negative) => {
            vec![Text("keep the "), Who(Entity::Object(object)), Text(" off the "), Landmark(landmark)]
        }
        (Goal::Touch { agent, other, .. }, Sign::Positive) if Entity::Agent(agent) == me => {
            vec![Text("catch the "), Who(Entity::Agent(other))]
        }
        (Goal::Touch { agent, other, .. }, Sign::Positive) => {
            vec![Text("let the "), Who(Entity::Agent(agent)), Text(" reach the "), Who(Entity::Agent(other))]
        }
        (Goal::Touch { agent, other, .. }, Sign::Negative) => {
            let from = if Entity::Agent(agent) == me { other } else { agent };
            vec![Text("get away from the "), Who(Entity::Agent(from))]
        }
    }
}

/// Pieces as plain text.
#[must_use]
pub fn plain(pieces: &[Fragment]) -> String {
    pieces
        .iter()
        .map(|piece| match *piece {
            Fragment::Text(text) => text,
            Fragment::Entity(who) => entity(who),
            Fragment::Landmark(number) => landmark(number),
        })
        .collect()
}

/// How an agent stands to the other.
#[must_use]
pub const fn attitude(attitude: Attitude) -> &'static str {
    match attitude {
        Attitude::Help => "helps",
        Attitude::Neutral => "is neutral",
        Attitude::Hinder => "hinders",
    }
}

/// A size.
#[must_use]
pub const fn size(size: Size) -> &'static str {
    match size {
        Size::Small => "small",
        Size::Medium => "medium",
        Size::Large => "large",
        Size::Huge => "huge",
    }
}

/// A strength.
#[must_use]
pub const fn strength(strength: Strength) -> &'static str {
    match strength {
        Strength::Weak => "weak",
        Strength::Fair => "fair",
        Strength::Strong => "strong",
        Strength::Mighty => "mighty",
    }
}

/// A relation.
#[must_use]
pub const fn relation(relation: Relation) -> &'static str {
    match relation {
        Relation::Friendly => "friendly",
        Relation::Adversarial => "adversarial",
        Relation::Neutral => "neutral",
    }
}

/// What characterises an event of a kind.
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
