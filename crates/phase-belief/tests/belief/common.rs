//! Scenes for beliefs, and test dynamics.

use phase_model::{
    AGENT_COUNT, Action, AgentBody, AgentId, Body, Dynamics, Entity, Layout, MAX_ENTITIES, ObjectId,
    PhysicsConfig, Segment, Size, State, Vec2, arena,
    geometry::Outline,
    random::{Pcg64Mcg, Purpose, stream},
};
use proptest::prelude::*;
use rand::RngExt;

pub(crate) const ME: Entity = Entity::Agent(AgentId::ZERO);
pub(crate) const OTHER: Entity = Entity::Agent(AgentId::ONE);
pub(crate) const BALL: Entity = Entity::Object(ObjectId::ZERO);
pub(crate) const BOX: Entity = Entity::Object(ObjectId::ONE);

pub(crate) fn random(seed: u64) -> Pcg64Mcg {
    stream(seed, Purpose::Belief, 0)
}

/// Two agents and some objects, all of one size.
pub(crate) fn physics(walls: Vec<Segment>, size: Size, object_count: usize) -> PhysicsConfig {
    let agent = AgentBody { radius: size.radius(), max_force: 300.0 };
    PhysicsConfig { walls, agents: [agent; 2], object_radii: [size.radius(); 2], object_count }
}

pub(crate) fn wall(a: (f32, f32), b: (f32, f32)) -> Segment {
    Segment { a: a.into(), b: b.into() }
}

/// Bodies at rest: positions and angles by entity.
pub(crate) fn state(bodies: [(f32, f32, f32); MAX_ENTITIES]) -> State {
    State::new(bodies.map(|(x, y, angle)| Body::at_rest(Vec2::new(x, y), angle)))
}

pub(crate) fn any_physique() -> impl Strategy<Value = PhysicsConfig> {
    let layouts = prop::sample::select(Layout::all_used().collect::<Vec<_>>());
    let size = || prop::sample::select(Size::ALL.to_vec());
    (layouts, [size(), size(), size(), size()], 0_usize..=2).prop_map(|(layout, sizes, object_count)| {
        let [a, b, c, d] = sizes.map(Size::radius);
        PhysicsConfig {
            walls: layout.walls(),
            agents: [a, b].map(|radius| AgentBody { radius, max_force: 450.0 }),
            object_radii: [c, d],
            object_count,
        }
    })
}

/// A state in which nothing overlaps, at rest but for the agents.
pub(crate) fn legal_state(physics: &PhysicsConfig, random: &mut Pcg64Mcg) -> State {
    let mut state = State::new([Body::default(); MAX_ENTITIES]);
    let mut outlines: Vec<Outline> = Vec::new();
    while outlines.len() < physics.entity_count() {
        let entity = Entity::ALL[outlines.len()];
        let position = arena::MIN + arena::SIDE * Vec2::new(random.random(), random.random());
        let mut body = Body::at_rest(position, random.random_range(-3.0..3.0));
        let outline = Outline::of(physics, entity, &body);
        if clear_of_walls(physics, &outline) && !outlines.iter().any(|other| outline.overlaps(other)) {
            if matches!(entity, Entity::Agent(_)) {
                body.velocity = Vec2::new(random.random_range(-12.0..12.0), random.random_range(-12.0..12.0));
            }
            *state.body_mut(entity) = body;
            outlines.push(outline);
        }
    }
    state
}

pub(crate) fn clear_of_walls(physics: &PhysicsConfig, outline: &Outline) -> bool {
    outline.inside_arena() && !physics.walls.iter().any(|&wall| outline.overlaps_wall(wall))
}

/// A copy of the scene with all bodies slightly smaller.
pub(crate) fn shrunk_outline(physics: &PhysicsConfig, by: f32) -> PhysicsConfig {
    let mut physics = physics.clone();
    physics.agents.iter_mut().for_each(|agent| agent.radius -= by);
    physics.object_radii.iter_mut().for_each(|radius| *radius -= by);
    physics
}

/// Nothing ever moves.
pub(crate) struct StaticDynamics;

impl Dynamics for StaticDynamics {
    fn step(&self, _: &mut State, _: [Action; AGENT_COUNT]) {}
}

/// Some entities end up in impossible places.
pub(crate) struct Lost<'a>(pub(crate) &'a [Entity]);

impl Dynamics for Lost<'_> {
    fn step(&self, state: &mut State, _: [Action; AGENT_COUNT]) {
        for &entity in self.0 {
            state.body_mut(entity).position = Vec2::NAN;
        }
    }
}

/// Arbitrary predictions: bodies out of the arena, in walls and in one another, unexpected grips and
/// contacts.
#[derive(Clone, Debug)]
pub(crate) struct Mad(pub(crate) [f32; 12]);

impl Dynamics for Mad {
    fn step(&self, state: &mut State, _: [Action; AGENT_COUNT]) {
        let n = &self.0;
        for (k, body) in state.bodies.iter_mut().enumerate() {
            body.position += Vec2::new(n[k], n[(k + 5) % 12]);
            body.angle *= n[k + 4];
            body.velocity = Vec2::new(n[11 - k], n[k]);
            body.angular_velocity = n[(k + 7) % 12];
        }
        let grip = |number: f32, object: u8| {
            (number > 0.0).then_some(phase_model::Grip {
                object: ObjectId::ALL[usize::from(object)],
                side: phase_model::Side::Tail,
                relative_angle: number,
            })
        };
        state.grips = [grip(n[0], 0), grip(n[1], u8::from(n[2] > 0.0))];
        state.contacts.insert(OTHER, BALL);
        state.contacts.insert(ME, OTHER);
    }
}
