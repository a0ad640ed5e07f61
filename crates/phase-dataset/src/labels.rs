//! Classes of goals and of kinds of interaction, which classifiers predict.

use phase_model::{AGENT_COUNT, EventKind, Goal, LandmarkId, ObjectId, Sign};
use std::collections::BTreeMap;

/// The class of one agent's goal. There are sixteen: the paper's fourteen physical goals, in which an agent's
/// own number plays no part, and the two social ones, which hide the goal that they are about. In an event
/// each agent is one example of its class.
#[must_use]
pub fn goal_label(goal: Goal, alpha: i8) -> String {
    match (alpha, goal) {
        (1.., _) => "help".into(),
        (..=-1, _) => "hinder".into(),
        (0, Goal::Touch { sign: Sign::Positive, .. }) => "approach".into(),
        (0, Goal::Touch { sign: Sign::Negative, .. }) => "get away".into(),
        (0, Goal::AgentOnLandmark { landmark, sign, .. }) => {
            format!("{}agent on landmark {landmark}", negation(sign))
        }
        (0, Goal::ObjectOnLandmark { object, landmark, sign }) => {
            format!("{}object {object} on landmark {landmark}", negation(sign))
        }
    }
}

/// Numbers of examples of the sixteen classes, and of any other that occurs.
pub fn goal_counts(agents: impl IntoIterator<Item = (Goal, i8)>) -> BTreeMap<String, usize> {
    let mut counts: BTreeMap<String, usize> = classes().into_iter().map(|class| (class, 0)).collect();
    for (goal, alpha) in agents {
        *counts.entry(goal_label(goal, alpha)).or_default() += 1;
    }
    counts
}

/// The kind of event and what the goals in it are about: what makes two interactions of one type.
#[must_use]
pub fn interaction_type(kind: EventKind, goals: [Goal; AGENT_COUNT]) -> String {
    let mut about = goals.map(|goal| match goal {
        Goal::AgentOnLandmark { .. } => "agent on landmark",
        Goal::ObjectOnLandmark { .. } => "object on landmark",
        Goal::Touch { .. } => "touch",
    });
    about.sort_unstable();
    match about {
        [one, other] if one == other => format!("{}: {one}", kind.name()),
        [one, other] => format!("{}: {one}, {other}", kind.name()),
    }
}

fn classes() -> Vec<String> {
    let landmarks = LandmarkId::ALL.into_iter();
    let mut classes: Vec<String> =
        ["help", "hinder", "approach", "get away"].into_iter().map(Into::into).collect();
    classes.extend(landmarks.clone().map(|landmark| format!("agent on landmark {landmark}")));
    classes.extend(ObjectId::ALL.into_iter().flat_map(|object| {
        landmarks.clone().map(move |landmark| format!("object {object} on landmark {landmark}"))
    }));
    classes
}

const fn negation(sign: Sign) -> &'static str {
    match sign {
        Sign::Positive => "",
        Sign::Negative => "no ",
    }
}
