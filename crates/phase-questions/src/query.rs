//! Subjects of questions, and their answers from motion or from a method's judgement.

mod judging;

use crate::Watched;
use phase_evidence::{Track, contact, holding, search, selection::MIN_VISIBLE_STEPS};
use phase_model::{
    AgentId, Entity, Goal, ObjectId, RoomId, State, Vec2,
    arena::{CENTRE, STEP_SECONDS},
    layout::room_of,
};
use phase_perception::observed_set;
use serde::{Deserialize, Serialize};

/// Distance from the lines between the rooms from which a place counts as in its room (u).
const ROOM_MARGIN: f32 = 1.0;
/// A second of video (steps): least time between what two agents do for one of them to be the first, and
/// time for which something is in a room, before and after the moment that is asked about. A viewer who sees
/// a frame now and then tells times no better.
const MARGIN_STEPS: usize = 4;
/// Distance between outlines at which a picture leaves open whether two bodies touch (u): ten pixels of a
/// video of the usual size.
const CLOSE: f32 = 0.4;
/// Time in which an agent shows by its way where it is going (steps).
const WAY_STEPS: usize = 8;
/// Least number of steps for which an agent has to hold an object, and the distance it has to move (u).
const CARRIED: (usize, f32) = (3, 1.0);
/// The agent whose top speed is higher by this factor counts as stronger. A viewer of a frame now and then
/// does not see smaller differences.
const FASTER: f32 = 1.5;

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
    /// The agent that acts to help or hinder the other; `neither` if each minds its own goal.
    Role,
    /// The landmark on which an agent wants an entity.
    Goal {
        /// The agent.
        agent: AgentId,
        /// Itself or an object.
        subject: Entity,
    },
    /// The agent of the greater maximum force.
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
    /// The room in which an agent that has waited expects an object to be, as its way shows. It may have been
    /// told of what it did not see.
    Expects {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// After which step.
        step: usize,
    },
    /// Whether it is right about that: `yes` or `no`.
    IsRight {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// After which step.
        step: usize,
    },
    /// The room in which it will look for the object first, after the video ends.
    LooksNext {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// The last step of the video.
        step: usize,
    },
    /// Whether an agent would have reached its goal only then (`better`), not then (`worse`), or as it did
    /// (`same`), had the other done nothing.
    Without {
        /// The agent that does nothing.
        idle: AgentId,
        /// The other's goal.
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
    pub const TYPES: [&str; 20] = [
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
        "expects",
        "is-right",
        "looks-next",
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
            Self::Expects { .. } => "expects",
            Self::IsRight { .. } => "is-right",
            Self::LooksNext { .. } => "looks-next",
            Self::Without { .. } => "without",
            Self::Ahead { .. } => "ahead",
            Self::PairHelp => "pair-help",
            Self::PairHinder => "pair-hinder",
            Self::PairTogether => "pair-together",
        }
    }

    /// Whether it is about what is seen to happen, so that [`Query::seen`] can answer it. All others are
    /// answered from a [`Judgement`](phase_model::Judgement).
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
    /// answer to all physical questions but `stronger` and those about what agents have seen and believe, for
    /// which it is the best guess of an observer.
    #[must_use]
    pub fn seen(&self, track: &Track) -> Option<String> {
        let states = &track.states;
        match *self {
            Self::EndRoom { entity } => clear_room(states.last()?, entity).map(room_value),
            Self::RoomAt { entity, step } => {
                let room = clear_room(states.get(step)?, entity)?;
                let around =
                    states.iter().take(step + MARGIN_STEPS + 1).skip(step.saturating_sub(MARGIN_STEPS));
                around
                    .into_iter()
                    .all(|state| room_of(state.position(entity)) == room)
                    .then(|| room_value(room))
            }
            Self::FirstTouch { object } => first_to_touch(track, object).map(agent_value),
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
            Self::Expects { agent, object, step } => {
                let look = search::first_look(track, agent, Entity::Object(object), step)?;
                let seen = if look.at_old_place { states.first() } else { states.get(look.step) };
                Some(room_value(room_of(seen?.position(Entity::Object(object)))))
            }
            Self::IsRight { agent, object, step } => {
                let look = search::first_look(track, agent, Entity::Object(object), step)?;
                Some(if look.at_old_place { "no" } else { "yes" }.to_owned())
            }
            Self::LooksNext { agent, object, .. } => {
                let (first, last) = (states.first()?, states.last()?);
                let before = states.iter().rev().nth(WAY_STEPS)?;
                let place = |state: &State| state.position(Entity::Agent(agent));
                let approach = |to: Vec2| place(before).distance(to) - place(last).distance(to);
                let [old, new] = [first, last].map(|state| state.position(Entity::Object(object)));
                Some(room_value(room_of(if approach(old) > approach(new) { old } else { new })))
            }
            Self::Stronger => {
                let [a, b] = AgentId::ALL.map(|agent| top_speed(states, agent));
                let faster = if a > b { AgentId::ZERO } else { AgentId::ONE };
                (a.max(b) > FASTER * a.min(b)).then(|| agent_value(faster))
            }
            _ => None,
        }
    }

    /// The option, by its index, that somebody chooses who has watched the videos and judged them as given;
    /// `None` if nothing speaks for any.
    #[must_use]
    pub fn choice(&self, watched: &[Watched], values: &[String]) -> Option<usize> {
        if self.is_physical() {
            let Watched { track, stills, .. } = watched.first()?;
            // Speeds are judged from frame to frame; nothing else has to be guessed between them.
            let value = self.seen(if *self == Self::Stronger { track } else { stills })?;
            return values.iter().position(|known| *known == value);
        }
        let scores: Vec<f64> = values.iter().map(|value| self.score(watched, value)).collect();
        let best = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let worst = scores.iter().copied().fold(f64::INFINITY, f64::min);
        // A method that finds all options equally good does not answer.
        (best > worst).then(|| scores.iter().position(|&score| score >= best)).flatten()
    }
}

/// The room of an entity that is clearly in it.
pub(crate) fn clear_room(state: &State, entity: Entity) -> Option<RoomId> {
    let place = state.position(entity);
    let away = place - CENTRE;
    (away.x.abs() >= ROOM_MARGIN && away.y.abs() >= ROOM_MARGIN).then(|| room_of(place))
}

/// The agent whose touch of an object is seen to be the first: it lasts, and the other is clearly apart from
/// the object until a second later.
fn first_to_touch(track: &Track, object: ObjectId) -> Option<AgentId> {
    let object = Entity::Object(object);
    let touch = |state: &State, agent| contact::touching(&track.physics, state, Entity::Agent(agent), object);
    let gap = |state: &State, agent| contact::gap(&track.physics, state, Entity::Agent(agent), object);
    let lasting = |agent| {
        track.states.windows(MIN_VISIBLE_STEPS).position(|some| some.iter().all(|state| touch(state, agent)))
    };
    let at = AgentId::ALL.map(lasting);
    let first = match at {
        [Some(one), Some(other)] if other < one => AgentId::ONE,
        [Some(_), _] => AgentId::ZERO,
        [None, Some(_)] => AgentId::ONE,
        [None, None] => return None,
    };
    let until = at[first]? + MARGIN_STEPS;
    let apart = track.states.iter().take(until).all(|state| gap(state, first.other()) > CLOSE);
    apart.then_some(first)
}

fn observes(track: &Track, state: &State, agent: AgentId, object: ObjectId) -> bool {
    observed_set(&track.physics, state, agent).contains(Entity::Object(object))
}

/// The highest speed of an agent over a second (u/s).
fn top_speed(states: &[State], agent: AgentId) -> f32 {
    let place = |state: &State| -> Vec2 { state.position(Entity::Agent(agent)) };
    let way =
        states.windows(MARGIN_STEPS + 1).map(|span| place(&span[0]).distance(place(&span[MARGIN_STEPS])));
    way.fold(0.0, f32::max) / (MARGIN_STEPS as f32 * STEP_SECONDS as f32)
}
