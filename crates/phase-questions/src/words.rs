//! Questions and options in words, several phrasings each.

use crate::Query;
use phase_model::{
    AgentId, Entity, EventKind, Goal, LandmarkId,
    arena::STEP_VIDEO_SECONDS,
    words::{self, Names, corner},
};

/// Facts about every video that a viewer has to know, to be shown before a question.
pub const INTRODUCTION: &str = "The video shows, from above, four rooms with walls and doors. Two agents, one red and one green, are \
     trapezoids whose narrow end is the head; they see what is ahead of them and not behind walls or bodies. Discs are \
     objects, which agents can push, or hold and carry: a dark bar joins an agent and what it holds. Large pale \
     squares in the corners are landmarks: blue at the top left, green at the top right, red at the bottom right, \
     yellow at the bottom left. Each room is named by its corner.";

/// Number of phrasings of every question.
pub const PHRASINGS: usize = 3;

/// The text of a question in one of its phrasings.
#[must_use]
pub(crate) fn question(query: &Query, phrasing: usize, names: &Names) -> String {
    let agent = |agent: AgentId| names.entity(Entity::Agent(agent));
    let seconds = |steps: usize| format!("{} s", steps as f64 * STEP_VIDEO_SECONDS);
    let pick = |texts: [String; PHRASINGS]| {
        let [one, two, three] = texts;
        match phrasing % PHRASINGS {
            0 => one,
            1 => two,
            _ => three,
        }
    };
    match *query {
        Query::Relation => pick([
            "How do the two agents relate to each other?".into(),
            "What is the relation between the red agent and the green agent?".into(),
            "Which of these describes best how the two agents treat each other?".into(),
        ]),
        Query::Kind => pick([
            "What happens in this video?".into(),
            "Which of these describes the whole video best?".into(),
            "What is going on between the two agents?".into(),
        ]),
        Query::Role => pick([
            "Which agent, if any, acts to help or hinder the other?".into(),
            "Does one of the agents help or hinder the other, and which?".into(),
            "Does an agent act for or against the other? If so, which agent?".into(),
        ]),
        Query::Goal { agent: whose, subject } if subject == Entity::Agent(whose) => {
            let who = agent(whose);
            pick([
                format!("On which landmark does the {who} want to be?"),
                format!("Which landmark is the {who} trying to reach?"),
                format!("Where does the {who} want to go?"),
            ])
        }
        Query::Goal { agent: whose, subject } => {
            let who = agent(whose);
            let what = names.entity(subject);
            pick([
                format!("On which landmark does the {who} want the {what}?"),
                format!("To which landmark is the {who} trying to bring the {what}?"),
                format!("Where does the {who} want the {what} to be?"),
            ])
        }
        Query::Stronger => pick([
            "Which agent is stronger, that is, can push with more force?".into(),
            "Which of the two agents has more strength?".into(),
            "Compare the force of the two agents. Which one is stronger?".into(),
        ]),
        Query::EndRoom { entity } => {
            let what = names.entity(entity);
            pick([
                format!("In which room is the {what} at the end?"),
                format!("Where does the {what} end up?"),
                format!("Which room holds the {what} when the video ends?"),
            ])
        }
        Query::RoomAt { entity, step } => {
            let what = names.entity(entity);
            let when = seconds(step);
            pick([
                format!("In which room is the {what} after {when}?"),
                format!("Where is the {what}, {when} after the beginning?"),
                format!("{when} have passed. Which room holds the {what}?"),
            ])
        }
        Query::FirstTouch { object } => {
            let what = names.entity(Entity::Object(object));
            pick([
                format!("Which agent touches the {what} first?"),
                format!("Which agent is the first to reach the {what}?"),
                format!("The {what} is touched. By which agent first?"),
            ])
        }
        Query::EntersFirst { agent: whose } => {
            let who = agent(whose);
            pick([
                format!("Which room does the {who} enter first, after the one in which it starts?"),
                format!("The {who} leaves the room in which it starts. Where does it come next?"),
                format!("What is the first other room that the {who} goes into?"),
            ])
        }
        Query::Carrier { object } => {
            let what = names.entity(Entity::Object(object));
            pick([
                format!("Which agent holds and moves the {what}?"),
                format!("Who carries the {what}?"),
                format!("By which agent is the {what} carried?"),
            ])
        }
        Query::Seen { agent: whose, object, step } => {
            let who = agent(whose);
            let what = names.entity(Entity::Object(object));
            let when = seconds(step);
            pick([
                format!("Has the {who} seen or felt the {what} within the first {when}?"),
                format!(
                    "After {when}, does the {who} know from its own eyes or touch where the {what} is or was?"
                ),
                format!("Did the {who} see or touch the {what} at any time in the first {when}?"),
            ])
        }
        Query::Believes { agent: whose, object, step } => {
            let who = agent(whose);
            let what = names.entity(Entity::Object(object));
            let when = seconds(step);
            pick([
                format!(
                    "After {when} the {who} does not see the {what}. In which room does it believe it to be?"
                ),
                format!("Where does the {who} think the {what} is after {when}, when it does not see it?"),
                format!(
                    "If the {who} went to look for the {what} after {when}, in which room would it look?"
                ),
            ])
        }
        Query::Expects { agent: whose, object, step } => {
            let who = agent(whose);
            let what = names.entity(Entity::Object(object));
            let when = seconds(step);
            pick([
                format!(
                    "The {who} sets out after {when}, and may have been told what it did not see. Judging by \
                     its way, in which room does it then believe the {what} to be?"
                ),
                format!(
                    "After {when} the {who} goes to look for the {what}. It may have been told where that \
                     is. Where does it think it is?"
                ),
                format!(
                    "Perhaps somebody told the {who} where the {what} is. To judge by what it does after \
                     {when}, in which room does it expect the {what}?"
                ),
            ])
        }
        Query::IsRight { agent: whose, object, step } => {
            let who = agent(whose);
            let what = names.entity(Entity::Object(object));
            let when = seconds(step);
            pick([
                format!(
                    "The {who} sets out after {when}. Judging by its way, does it know in which room \
                     the {what} is?"
                ),
                format!(
                    "After {when} the {who} goes to look for the {what}. Is it right about the room in which \
                     that is?"
                ),
                format!(
                    "To judge by what the {who} does after {when}, is its belief about where the {what} is \
                     true?"
                ),
            ])
        }
        Query::LooksNext { agent: whose, object, .. } => {
            let who = agent(whose);
            let what = names.entity(Entity::Object(object));
            pick([
                format!(
                    "The video stops while the {who} is on its way to the {what}. In which room will it look \
                     first?"
                ),
                format!("When the video ends, the {who} looks for the {what}. Where does it look first?"),
                format!("Which room is the {who} going to, at the end of the video, to find the {what}?"),
            ])
        }
        Query::Without { idle, judged } => {
            let who = agent(idle);
            let whom = agent(idle.other());
            let goal = aim(judged, names);
            pick([
                format!("The {whom} wants {goal}. Had the {who} done nothing, would it have succeeded?"),
                format!(
                    "Suppose that the {who} had not moved at all. What would that have meant for the {whom}, \
                     which wants {goal}?"
                ),
                format!(
                    "The {whom} wants {goal}. Had the {who} stood still throughout, how would it have fared?"
                ),
            ])
        }
        Query::Ahead { entity, after, .. } => {
            let what = names.entity(entity);
            let when = seconds(after);
            pick([
                format!("The video stops. In which room will the {what} be {when} later?"),
                format!("Where will the {what} be {when} after the end of the video?"),
                format!("It goes on for another {when}. Which room will then hold the {what}?"),
            ])
        }
        Query::PairHelp => pick([
            "In which of the two videos does one agent help the other?".into(),
            "Two videos begin alike. In one of them an agent is helped by the other. Which?".into(),
            "Which video shows help?".into(),
        ]),
        Query::PairHinder => pick([
            "In which of the two videos does one agent hinder the other?".into(),
            "Two videos begin alike. In one of them an agent is kept from its goal by the other. Which?"
                .into(),
            "Which video shows an agent that works against the other?".into(),
        ]),
        Query::PairTogether => pick([
            "In which of the two videos do both agents want the same?".into(),
            "Two videos begin alike. In one of them the agents work together. Which?".into(),
            "Which video shows two agents with one common goal?".into(),
        ]),
    }
}

/// A goal of being on a landmark, after "wants".
fn aim(goal: Goal, names: &Names) -> String {
    let Some(landmark) = goal.landmark() else { return String::new() };
    let place = names.landmark_and_place(landmark);
    match goal.subject() {
        Entity::Agent(_) => format!("to be on the {place}"),
        subject @ Entity::Object(_) => format!("the {} on the {place}", names.entity(subject)),
    }
}

/// The text of an option.
#[must_use]
pub(crate) fn option(query: &Query, value: &str, names: &Names) -> String {
    let number = value.parse::<usize>().ok();
    let landmark = number.and_then(|number| LandmarkId::ALL.get(number).copied());
    let agent = number.and_then(|number| AgentId::ALL.get(number).copied());
    let agent_name = |agent: AgentId| format!("the {}", names.entity(Entity::Agent(agent)));
    match query {
        Query::Relation => match value {
            "friendly" => "friendly: one helps the other, or both want the same",
            "adversarial" => "adversarial: one hinders the other, or their goals conflict",
            _ => "neutral: each minds its own goal",
        }
        .into(),
        Query::Kind => EventKind::named(value).map_or_else(String::new, |kind| words::kind(kind).to_owned()),
        Query::Goal { .. } => {
            landmark.map_or_else(String::new, |it| format!("the {}", names.landmark_and_place(it)))
        }
        Query::EndRoom { .. }
        | Query::RoomAt { .. }
        | Query::EntersFirst { .. }
        | Query::Believes { .. }
        | Query::Expects { .. }
        | Query::LooksNext { .. }
        | Query::Ahead { .. } => landmark.map_or_else(String::new, |it| format!("the {} room", corner(it))),
        Query::Role | Query::Stronger | Query::FirstTouch { .. } | Query::Carrier { .. } => {
            match (value, agent) {
                ("both", _) => "both agents, at once or one after the other".into(),
                ("neither", _) => "neither of them".into(),
                (_, Some(agent)) if matches!(query, Query::Carrier { .. }) => {
                    format!("{} alone", agent_name(agent))
                }
                (_, Some(agent)) => agent_name(agent),
                _ => String::new(),
            }
        }
        Query::Seen { .. } | Query::IsRight { .. } => value.to_owned(),
        Query::Without { idle, .. } => {
            let whom = agent_name(idle.other());
            match value {
                "better" => format!("{whom} would have succeeded, as it does not in the video"),
                "worse" => format!("{whom} would have failed, as it does not in the video"),
                _ => format!("{whom} would have succeeded just as soon as in the video"),
            }
        }
        Query::PairHelp | Query::PairHinder | Query::PairTogether => {
            if value == "0" { "the left video" } else { "the right video" }.into()
        }
    }
}
