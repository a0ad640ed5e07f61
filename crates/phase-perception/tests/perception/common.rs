//! Scenes to observe.

use phase_model::{
    AgentBody, AgentId, Body, Entity, Grip, Layout, MAX_ENTITIES, ObjectId, PhysicsConfig, Segment, Side,
    Size, State, Vec2,
};
use proptest::prelude::*;

pub(crate) const ME: Entity = Entity::Agent(AgentId::ZERO);
pub(crate) const OTHER: Entity = Entity::Agent(AgentId::ONE);
pub(crate) const BALL: Entity = Entity::Object(ObjectId::ZERO);
pub(crate) const BOX: Entity = Entity::Object(ObjectId::ONE);

/// A position outside all cells.
pub(crate) const AWAY: Vec2 = Vec2::new(-500.0, -500.0);

/// Two agents and two objects, all of one size.
pub(crate) fn physics(walls: Vec<Segment>, size: Size) -> PhysicsConfig {
    let agent = AgentBody { radius: size.radius(), max_force: 300.0 };
    PhysicsConfig { walls, agents: [agent; 2], object_radii: [size.radius(); 2], object_count: 2 }
}

pub(crate) fn wall(a: (f32, f32), b: (f32, f32)) -> Segment {
    Segment { a: a.into(), b: b.into() }
}

/// Agent 0 at a position and heading; the others are far away until they are moved.
pub(crate) fn looking(position: (f32, f32), angle: f32) -> State {
    let mut state = State::new([Body::at_rest(AWAY, 0.0); MAX_ENTITIES]);
    *state.body_mut(ME) = Body::at_rest(position.into(), angle);
    state
}

pub(crate) fn with(mut state: State, entity: Entity, position: (f32, f32)) -> State {
    *state.body_mut(entity) = Body::at_rest(position.into(), 0.0);
    state
}

pub(crate) fn grip(object: u8) -> Option<Grip> {
    Some(Grip { object: ObjectId::ALL[usize::from(object)], side: Side::Head, relative_angle: 0.0 })
}

pub(crate) fn any_size() -> impl Strategy<Value = Size> {
    prop::sample::select(Size::ALL.to_vec())
}

pub(crate) fn any_physique() -> impl Strategy<Value = PhysicsConfig> {
    let layouts = prop::sample::select(Layout::all_used().collect::<Vec<_>>());
    (layouts, prop::array::uniform4(any_size()), 0_usize..=2).prop_map(|(layout, sizes, object_count)| {
        let [a, b, c, d] = sizes.map(Size::radius);
        PhysicsConfig {
            walls: layout.walls(),
            agents: [a, b].map(|radius| AgentBody { radius, max_force: 300.0 }),
            object_radii: [c, d],
            object_count,
        }
    })
}

pub(crate) fn any_body() -> impl Strategy<Value = Body> {
    (6.0_f32..26.0, 2.0_f32..22.0, -9.0_f32..9.0)
        .prop_map(|(x, y, angle)| Body { velocity: Vec2::new(y, x), ..Body::at_rest(Vec2::new(x, y), angle) })
}

/// Bodies anywhere in the arena, some pairs in contact, some objects held.
pub(crate) fn any_state() -> impl Strategy<Value = State> {
    let pairs = prop::collection::vec((0_usize..4, 0_usize..4), 0..3);
    let held = || prop::option::weighted(0.2, 0_u8..2);
    (prop::array::uniform4(any_body()), pairs, held(), held()).prop_map(|(bodies, pairs, first, second)| {
        let mut state = State::new(bodies);
        for (a, b) in pairs {
            state.contacts.insert(Entity::ALL[a], Entity::ALL[b]);
        }
        state.grips = [first, second].map(|held| held.and_then(grip));
        state
    })
}
