//! Synthetic tracks: all bodies of radius 1, in an arena without walls.

use phase_evidence::Track;
use phase_model::{
    AgentBody, Body, Contacts, Grip, MAX_ENTITIES, ObjectId, PhysicsConfig, Side, State, Vec2,
};

/// The place of every entity at one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Move {
    /// x, y and angle of both agents.
    pub(crate) agents: [(f32, f32, f32); 2],
    /// x and y of the objects.
    pub(crate) objects: Vec<(f32, f32)>,
    /// The object that each agent holds.
    pub(crate) held: [Option<u8>; 2],
}

/// A track of these moves; as many objects as the first has.
pub(crate) fn track(moves: impl IntoIterator<Item = Move>) -> Track {
    let moves: Vec<Move> = moves.into_iter().collect();
    let agent = AgentBody { radius: 1.0, max_force: 300.0 };
    let object_count = moves.first().map_or(0, |first| first.objects.len());
    let physics = PhysicsConfig { walls: vec![], agents: [agent; 2], object_radii: [1.0; 2], object_count };
    Track { physics, states: moves.iter().map(state).collect() }
}

fn state(step: &Move) -> State {
    let mut bodies = [Body::default(); MAX_ENTITIES];
    for (body, &(x, y, angle)) in bodies.iter_mut().zip(&step.agents) {
        *body = Body::at_rest(Vec2::new(x, y), angle);
    }
    for (body, &(x, y)) in bodies.iter_mut().skip(2).zip(&step.objects) {
        *body = Body::at_rest(Vec2::new(x, y), 0.0);
    }
    let grip = |object: u8| Grip {
        object: ObjectId::ALL[usize::from(object)],
        side: Side::Head,
        relative_angle: 0.0,
    };
    State { bodies, grips: step.held.map(|held| held.map(grip)), contacts: Contacts::NONE }
}
