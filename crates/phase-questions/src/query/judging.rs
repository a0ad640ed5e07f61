//! Weights that a method's judgement gives to the options of a question.

use super::Query;
use crate::Watched;
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Entity, EventKind, Goal, Judgement, LandmarkId, Relation, Sign,
};

impl Query {
    /// Weight of a judgement for a value, at least 0.
    pub(super) fn score(&self, watched: &[Watched], value: &str) -> f64 {
        let judged = |k: usize| watched.get(k).and_then(|it| it.judgement.as_ref());
        let Some(judgement) = judged(0) else { return 0.0 };
        let roles = judgement.roles.unwrap_or_default();
        let number = |value: &str| value.parse::<usize>().ok();
        match *self {
            Self::Relation => relation(value).map_or(0.0, |it| judgement.relation.of(it)),
            Self::Kind => EventKind::named(value).map_or(0.0, |kind| kind_probability(judgement, kind)),
            Self::Role if value == "neither" => judgement.relation.neutral,
            Self::Role => {
                let agent = number(value).and_then(|agent| AgentId::ALL.get(agent).copied());
                let role = |attitude| agent.map_or(0.0, |agent| roles.of(agent, attitude).max(0.0));
                role(Attitude::Help) + role(Attitude::Hinder)
            }
            Self::Goal { agent, subject } => {
                let wanted = number(value).and_then(|number| LandmarkId::ALL.get(number).copied());
                landmark_mass(&judgement.goals[agent], subject, wanted)
            }
            Self::Without { idle, .. } => {
                let helps = roles.of(idle, Attitude::Help).max(0.0);
                let hinders = roles.of(idle, Attitude::Hinder).max(0.0);
                let friendly = (judgement.relation.friendly - roles.helps.iter().sum::<f64>()).max(0.0);
                let adversarial =
                    (judgement.relation.adversarial - roles.hinders.iter().sum::<f64>()).max(0.0);
                match value {
                    "worse" => helps + friendly,
                    "better" => hinders + adversarial,
                    _ => judgement.relation.neutral,
                }
            }
            Self::Ahead { entity, .. } => {
                let wanted = number(value).and_then(|number| LandmarkId::ALL.get(number).copied());
                let goals = judgement.goals.iter().zip(AgentId::ALL);
                // An agent that wants an object somewhere goes there with it.
                goals
                    .map(|(goals, agent)| match entity {
                        Entity::Agent(it) if it == agent => goals
                            .iter()
                            .filter(|(goal, _)| goal.sign() == Sign::Positive && goal.landmark() == wanted)
                            .map(|(_, p)| p)
                            .sum(),
                        Entity::Agent(_) => 0.0,
                        Entity::Object(_) => landmark_mass(goals, entity, wanted),
                    })
                    .sum()
            }
            Self::PairHelp | Self::PairHinder | Self::PairTogether => {
                let Some(judgement) = number(value).and_then(judged) else { return 0.0 };
                let roles = judgement.roles;
                match self {
                    Self::PairHelp => {
                        roles.map_or(judgement.relation.friendly, |roles| roles.helps.iter().sum())
                    }
                    Self::PairHinder => {
                        roles.map_or(judgement.relation.adversarial, |roles| roles.hinders.iter().sum())
                    }
                    _ => judgement.relation.friendly,
                }
            }
            _ => 0.0,
        }
    }
}

/// The probability that an agent with these goals wants an entity on a landmark.
fn landmark_mass(goals: &[(Goal, f64)], subject: Entity, landmark: Option<LandmarkId>) -> f64 {
    goals
        .iter()
        .filter(|(goal, _)| {
            goal.sign() == Sign::Positive && goal.subject() == subject && goal.landmark() == landmark
        })
        .map(|(_, p)| p)
        .sum()
}

fn relation(name: &str) -> Option<Relation> {
    [Relation::Friendly, Relation::Adversarial, Relation::Neutral].into_iter().find(|it| it.name() == name)
}

/// The probability of a kind of event, from those of roles, relation and goals.
fn kind_probability(judgement: &Judgement, kind: EventKind) -> f64 {
    let roles = judgement.roles.unwrap_or_default();
    let helping: f64 = roles.helps.iter().sum();
    let hindering: f64 = roles.hinders.iter().sum();
    let touch = judgement.goals.iter().flatten();
    let touch: f64 = touch.filter(|(goal, _)| matches!(goal, Goal::Touch { .. })).map(|(_, p)| p).sum();
    let touch = (touch / AGENT_COUNT as f64).clamp(0.0, 1.0);
    let conflict = (judgement.relation.adversarial - hindering).max(0.0);
    match kind {
        EventKind::Helping => helping,
        EventKind::Hindering => hindering,
        EventKind::Collaborating => (judgement.relation.friendly - helping).max(0.0),
        EventKind::Chasing => conflict * touch,
        EventKind::Competing => conflict * (1.0 - touch),
        EventKind::Independent => judgement.relation.neutral,
    }
}
