//! Features of a room as the place where an agent may believe an entity to be.

use crate::nodes::{LENGTH, SPEED};
use phase_event::{ObservedEvent, others};
use phase_model::{
    AGENT_COUNT, AgentId, Body, Entity, MAX_ENTITIES, PhysicsConfig, RoomId, State, Vec2, arena::LANDMARKS,
    layout::room_of,
};
use phase_navigation::{Field, Map, Mover, NavigationParameters, Target};
use phase_perception::{Cell, Viewpoint, observed_sets};

/// Features of a room for an agent and an entity in a row: whether the entity is there, was there when the
/// agent could last see it, and at the start (3); whether the agent and the other agent are there (2); the
/// agent's way there, how much it was shortened by the last step, and the cosine of the angle between it and
/// where the agent faces (3); whether the agent sees the middle of the room, and the entity (2); whether the
/// entity is an agent, its distance from each agent, the speeds of the agent and of the entity, and for how
/// long the agent has not seen it (6).
pub(super) const FEATURES: usize = 16;

/// Entities that an agent can have beliefs about, at most.
pub(super) const OTHERS: usize = MAX_ENTITIES - 1;
/// Rooms.
pub(super) const ROOMS: usize = RoomId::ALL.len();
/// Beliefs of an event: of each agent about each other entity.
pub(super) const BELIEFS: usize = AGENT_COUNT * OTHERS;
/// The scale of times (steps): most events are shorter.
const TIME: f32 = 100.0;

/// The features of every room for every belief of an event, and whether an agent sees the entity.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct RoomFeatures {
    /// By row, belief and room; zeros for absent entities.
    pub(super) values: Vec<f32>,
    /// By row and belief.
    pub(super) seen: Vec<bool>,
}

/// The place of a belief among the [`BELIEFS`] of an event.
pub(super) const fn index_of(agent: AgentId, other: usize) -> usize {
    agent.index() * OTHERS + other
}

impl RoomFeatures {
    /// The features of an event. Which rooms have which numbers plays no part.
    pub(super) fn of(event: &ObservedEvent) -> Self {
        let physics = event.physics([0.0; AGENT_COUNT]);
        let rows = event.rows();
        let states: Vec<State> = rows.iter().map(|&row| State::new(row)).collect();
        let seen = observed_sets(&physics, &states);
        let objects = event.object_sizes().len();
        let mut all = Self {
            values: vec![0.0; rows.len() * BELIEFS * ROOMS * FEATURES],
            seen: vec![false; rows.len() * BELIEFS],
        };
        let map = Map::new(event.layout());
        for agent in AgentId::ALL {
            let of_agent = OfAgent::new(agent, &map, &physics, rows, &states);
            for (other, entity) in others(agent, objects).enumerate() {
                let mut last_seen = 0;
                for (row, seen) in seen.iter().enumerate() {
                    let sees = seen[agent].contains(entity);
                    if sees {
                        last_seen = row;
                    }
                    let belief = row * BELIEFS + index_of(agent, other);
                    all.seen[belief] = sees;
                    for room in RoomId::ALL {
                        let at = (belief * ROOMS + room.index()) * FEATURES;
                        let features = of_agent.features(entity, room, row, last_seen);
                        all.values[at..at + FEATURES].copy_from_slice(&features);
                    }
                }
            }
        }
        all
    }
}

/// One agent in all rows of an event.
struct OfAgent<'a> {
    agent: AgentId,
    rows: &'a [[Body; MAX_ENTITIES]],
    /// By row and room.
    ways: Vec<[Way; ROOMS]>,
}

/// The way of the agent to the middle of a room.
struct Way {
    /// Its length (u), or the price of a door that is too narrow.
    length: f32,
    /// Cosine of the angle between it and where the agent faces.
    facing: f32,
    /// Whether the agent sees its end.
    in_view: bool,
}

impl<'a> OfAgent<'a> {
    fn new(
        agent: AgentId,
        map: &Map,
        physics: &PhysicsConfig,
        rows: &'a [[Body; MAX_ENTITIES]],
        states: &[State],
    ) -> Self {
        let own = Entity::Agent(agent);
        let mover = Mover::of(physics, own);
        let field =
            |middle: Vec2| Field::new(map, Target::Point(middle), mover, &[], NavigationParameters::DEFAULT);
        let fields = LANDMARKS.map(field);
        let way = |state: &State| {
            let body = state.body(own);
            let viewpoint = Viewpoint::new(physics, state, agent);
            core::array::from_fn(|room| Way {
                length: fields[room].distance(body.position),
                facing: fields[room].direction(body.position).dot(body.forward()),
                in_view: Cell::at(LANDMARKS[room]).is_some_and(|cell| viewpoint.sees_cell(cell)),
            })
        };
        Self { agent, rows, ways: states.iter().map(way).collect() }
    }

    fn features(&self, entity: Entity, room: RoomId, row: usize, last_seen: usize) -> [f32; FEATURES] {
        let flag = |is: bool| f32::from(u8::from(is));
        let body = |row: usize, entity: Entity| &self.rows[row][entity];
        let is_here = |row: usize, entity: Entity| flag(room_of(body(row, entity).position) == room);
        let (own, other) = (Entity::Agent(self.agent), Entity::Agent(self.agent.other()));
        let way = &self.ways[row][room.index()];
        let before = &self.ways[row.saturating_sub(1)][room.index()];
        let distance = |from: Entity| body(row, from).position.distance(body(row, entity).position) / LENGTH;
        [
            is_here(row, entity),
            is_here(last_seen, entity),
            is_here(0, entity),
            is_here(row, own),
            is_here(row, other),
            way.length / LENGTH,
            before.length - way.length,
            way.facing,
            flag(way.in_view),
            flag(last_seen == row),
            flag(entity == other),
            distance(own),
            distance(other),
            body(row, own).velocity.length() / SPEED,
            body(row, entity).velocity.length() / SPEED,
            (row - last_seen) as f32 / TIME,
        ]
    }
}
