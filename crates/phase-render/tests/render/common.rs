//! A small scene to draw, and a way to read pixels by world point.

use phase_model::{AgentBody, Body, PhysicsConfig, Segment, State, Vec2};
use phase_render::{Frame, SceneRenderer, Style};

/// Radii of agents 0 and 1 and of objects 0 and 1 (u).
pub(crate) const RADII: [f32; 4] = [1.2, 1.01, 0.8, 1.6];

/// One wall from the centre down to (16, 7), one from the centre to the right edge.
pub(crate) fn physics() -> PhysicsConfig {
    let wall = |ax, ay, bx, by| Segment { a: Vec2::new(ax, ay), b: Vec2::new(bx, by) };
    PhysicsConfig {
        walls: vec![wall(16.0, 12.0, 16.0, 7.0), wall(16.0, 12.0, 26.0, 12.0)],
        agents: [RADII[0], RADII[1]].map(|radius| AgentBody { radius, max_force: 300.0 }),
        object_radii: [RADII[2], RADII[3]],
        object_count: 2,
    }
}

/// Agent 0 in the middle left facing up, agent 1 on the top right landmark, objects at the bottom.
pub(crate) fn state() -> State {
    State::new([
        Body::at_rest(Vec2::new(10.0, 12.0), 0.0),
        Body::at_rest(Vec2::new(23.5, 19.5), 0.0),
        Body::at_rest(Vec2::new(13.0, 4.0), 0.0),
        Body::at_rest(Vec2::new(20.0, 6.0), 0.0),
    ])
}

pub(crate) fn renderer() -> SceneRenderer {
    SceneRenderer::new(&physics(), Style::default())
        .expect("the default style and points in the picture are valid")
}

/// Red, green and blue at a world point.
pub(crate) fn at(renderer: &SceneRenderer, frame: &Frame, x: f32, y: f32) -> [u8; 3] {
    let pixel = renderer.pixel(Vec2::new(x, y));
    frame
        .pixel(pixel.x as u32, pixel.y as u32)
        .expect("the default style and points in the picture are valid")
}
