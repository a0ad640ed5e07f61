//! Subjects of questions, and their answers from motion or from a method's judgement.

use crate::Watched;
use phase_evidence::{contact, holding};
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Entity, EventKind, Goal, Judgement, LandmarkId, ObjectId, Relation,
    RoomId, Sign, State, Vec2,
    arena::{CENTRE, STEP_SECONDS},
    layout::room_of,
};
use phase_perception::observed_set;
use serde::{Deserialize, Serialize};

/// Distance from the lines between the rooms from which a place counts as in its room (u).
const ROOM_MARGIN: f32 = 1.0;
/// Least number of steps between what two agents do for one of them to be the first.
const FIRST_MARGIN: usize = 4;
/// Least number of steps for which an agent has to hold an object, and the distance it has to move (u).
const CARRIED: (usize, f32) = (3, 1.0);
/// The higher of two top speeds has to exceed the lower by this factor for its agent to count as stronger.
const FASTER: f32 = 1.15;

/// The subject of a question. Its serialised `type` is the name of the question's type.
///
/// An answer is a short text, its *value*: the number of a landmark, room or agent, or a word such as `yes`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Query {
    /// The relation of the agents: `friendly`, `adversarial`, `neutral`.
    Relation,
    /// The kind of the event, by its name.
    Kind,
    /// `helps-0`, `helps-1`, `hinders-0`, `hinders-1`: what the agent of this number does to the other;
    /// `neither` if each minds its own goal.
    Role,
    /// The landmark on which an agent wants an entity.
    Goal {
        /// The agent.
        agent: AgentId,
        /// Itself or an object.
        subject: Entity,
    },
    /// The agent of the greater maximum force, or `equal`.
    Stronger,
    /// The room of an entity at the end.
    EndRoom {
        /// The entity.
        entity: Entity,
    },
    /// The room of an entity after a step.
    RoomAt {
        /// The entity.
        entity: Entity,
        /// The step.
        step: usize,
    },
    /// The agent that touches an object first.
    FirstTouch {
        /// The object.
        object: ObjectId,
    },
    /// The first room that an agent enters.
    EntersFirst {
        /// The agent.
        agent: AgentId,
    },
    /// The agent that carries an object, `both` or `neither`.
    Carrier {
        /// The object.
        object: ObjectId,
    },
    /// Whether an agent has seen an object by the end of a step: `yes` or `no`.
    Seen {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// The step.
        step: usize,
    },
    /// The room in which an agent believes an object to be that it does not see.
    Believes {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// After which step.
        step: usize,
    },
    /// Whether an agent would have been more (`better`) or less (`worse`) successful, or neither (`same`),
    /// had the other done nothing.
    Without {
        /// The agent that does nothing.
        idle: AgentId,
        /// Its goal is compared.
        judged: Goal,
    },
    /// The room of an entity some time after the video ends.
    Ahead {
        /// The entity.
        entity: Entity,
        /// The last step of the video.
        step: usize,
        /// Steps later.
        after: usize,
    },
    /// The video, `0` or `1`, in which one agent helps the other.
    PairHelp,
    /// The video in which one agent hinders the other.
    PairHinder,
    /// The video in which both want the same.
    PairTogether,
}

/// The value of an agent.
pub(crate) fn agent_value(agent: AgentId) -> String {
    agent.to_string()
}

/// The value of a room or landmark.
pub(crate) fn room_value(room: RoomId) -> String {
    room.to_string()
}

impl Query {
    /// The names of all types.
    pub const TYPES: [&str; 17] = [
        "relation",
        "kind",
        "role",
        "goal",
        "stronger",
        "end-room",
        "room-at",
        "first-touch",
        "enters-first",
        "carrier",
        "seen",
        "believes",
        "without",
        "ahead",
        "pair-help",
        "pair-hinder",
        "pair-together",
    ];

    /// The name of its type, one of [`Query::TYPES`].
    #[must_use]
    pub const fn type_name(&self) -> &'static str {
        match self {
            Self::Relation => "relation",
            Self::Kind => "kind",
            Self::Role => "role",
            Self::Goal { .. } => "goal",
            Self::Stronger => "stronger",
            Self::EndRoom { .. } => "end-room",
            Self::RoomAt { .. } => "room-at",
            Self::FirstTouch { .. } => "first-touch",
            Self::EntersFirst { .. } => "enters-first",
            Self::Carrier { .. } => "carrier",
            Self::Seen { .. } => "seen",
            Self::Believes { .. } => "believes",
            Self::Without { .. } => "without",
            Self::Ahead { .. } => "ahead",
            Self::PairHelp => "pair-help",
            Self::PairHinder => "pair-hinder",
            Self::PairTogether => "pair-together",
        }
    }

    /// Whether it is about what is seen to happen, so that [`Query::seen`] can answer it.
    #[must_use]
    pub const fn is_physical(&self) -> bool {
        !matches!(
            self,
            Self::Relation
                | Self::Kind
                | Self::Role
                | Self::Goal { .. }
                | Self::Without { .. }
                | Self::Ahead { .. }
                | Self::PairHelp
                | Self::PairHinder
                | Self::PairTogether
        )
    }

    /// The value that follows from motion; `None` if that leaves it open. This is the definition of the right
    /// answer to all physical questions but `stronger`, `seen` and `believes`, for which it is the best guess
    /// of an observer.
    #[must_use]
    pub fn seen(&self, track: &phase_evidence::Track) -> Option<String> {
        let states = &track.states;
        match *self {
            Self::EndRoom { entity } => clear_room(states.last()?, entity).map(room_value),
            Self::RoomAt { entity, step } => clear_room(states.get(step)?, entity).map(room_value),
            Self::FirstTouch { object } => {
                let first = AgentId::ALL.map(|agent| {
                    contact::steps_touching(track, Entity::Agent(agent), Entity::Object(object))
                        .first()
                        .copied()
                });
                let agent = match first {
                    [Some(one), Some(other)] if one.abs_diff(other) < FIRST_MARGIN => return None,
                    [Some(one), Some(other)] if one < other => AgentId::ZERO,
                    [Some(_), None] => AgentId::ZERO,
                    [_, Some(_)] => AgentId::ONE,
                    [None, None] => return None,
                };
                Some(agent_value(agent))
            }
            Self::EntersFirst { agent } => {
                let entity = Entity::Agent(agent);
                let start = room_of(states.first()?.position(entity));
                let entered = states.iter().position(|state| room_of(state.position(entity)) != start)?;
                let room = room_of(states[entered].position(entity));
                let clear = states[entered..].iter().find_map(|state| clear_room(state, entity));
                (clear == Some(room)).then(|| room_value(room))
            }
            Self::Carrier { object } => {
                let carries = AgentId::ALL.map(|agent| {
                    let carried = holding::carried(track, agent, object);
                    carried.steps >= CARRIED.0 && carried.distance >= CARRIED.1
                });
                Some(match carries {
                    [true, true] => "both".to_owned(),
                    [true, false] => agent_value(AgentId::ZERO),
                    [false, true] => agent_value(AgentId::ONE),
                    [false, false] => "neither".to_owned(),
                })
            }
            Self::Seen { agent, object, step } => {
                let seen = states.iter().take(step + 1).any(|state| observes(track, state, agent, object));
                Some(if seen { "yes" } else { "no" }.to_owned())
            }
            Self::Believes { agent, object, step } => {
                let last =
                    states.iter().take(step + 1).rfind(|state| observes(track, state, agent, object))?;
                Some(room_value(room_of(last.position(Entity::Object(object)))))
            }
            Self::Stronger => {
                let top = AgentId::ALL.map(|agent| top_speed(states, agent));
                Some(if top[0] > FASTER * top[1] {
                    agent_value(AgentId::ZERO)
                } else if top[1] > FASTER * top[0] {
                    agent_value(AgentId::ONE)
                } else {
                    "equal".to_owned()
                })
            }
            _ => None,
        }
    }

    /// The option, by its index, that somebody chooses who has watched the videos and judged them as given;
    /// `None` if nothing speaks for any.
    #[must_use]
    pub fn choice(&self, watched: &[Watched], values: &[String]) -> Option<usize> {
        if self.is_physical() {
            let value = self.seen(&watched.first()?.track)?;
            return values.iter().position(|known| *known == value);
        }
        let scores: Vec<f64> = values.iter().map(|value| self.score(watched, value)).collect();
        let best = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let worst = scores.iter().copied().fold(f64::INFINITY, f64::min);
        // A method that finds all options equally good does not answer.
        (best > worst).then(|| scores.iter().position(|&score| score >= best)).flatten()
    }

    /// Weight of a judgement for a value, at least 0.
    fn score(&self, watched: &[Watched], value: &str) -> f64 {
        let judged = |k: usize| watched.get(k).and_then(|it| it.judgement.as_ref());
        let Some(judgement) = judged(0) else { return 0.0 };
        let roles = judgement.roles.unwrap_or_default();
        let number = |value: &str| value.parse::<usize>().ok();
        match *self {
            Self::Relation => relation(value).map_or(0.0, |it| judgement.relation.of(it)),
            Self::Kind => EventKind::named(value).map_or(0.0, |kind| kind_probability(judgement, kind)),
            Self::Role if value == "neither" => judgement.relation.neutral,
            Self::Role => {
                let (attitude, agent) = match value.rsplit_once('-') {
                    Some(("helps", agent)) => (Attitude::Help, number(agent)),
                    Some((_, agent)) => (Attitude::Hinder, number(agent)),
                    None => return 0.0,
                };
                let agent = agent.and_then(|agent| AgentId::ALL.get(agent).copied());
                agent.map_or(0.0, |agent| roles.of(agent, attitude).max(0.0))
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

/// The room of an entity that is clearly in it.
pub(crate) fn clear_room(state: &State, entity: Entity) -> Option<RoomId> {
    let place = state.position(entity);
    let away = place - CENTRE;
    (away.x.abs() >= ROOM_MARGIN && away.y.abs() >= ROOM_MARGIN).then(|| room_of(place))
}

fn observes(track: &phase_evidence::Track, state: &State, agent: AgentId, object: ObjectId) -> bool {
    observed_set(&track.physics, state, agent).contains(Entity::Object(object))
}

/// The highest speed of an agent from step to step (u/s).
fn top_speed(states: &[State], agent: AgentId) -> f32 {
    let place = |state: &State| -> Vec2 { state.position(Entity::Agent(agent)) };
    let way = states.windows(2).map(|pair| place(&pair[0]).distance(place(&pair[1])));
    way.fold(0.0, f32::max) / STEP_SECONDS as f32
}
