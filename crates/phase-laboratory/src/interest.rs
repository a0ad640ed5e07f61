//! Areas of interest: where bodies and landmarks are in a video, in pixels.

use phase_model::{Entity, LandmarkId, PhysicsConfig, State, Vec2, arena, geometry::Outline};
use phase_render::SceneRenderer;

/// Corners of the polygon that stands for a disc.
const DISC_CORNERS: usize = 24;

/// The box and outline of something in a frame (pixels from the upper left corner, y down).
#[derive(Clone, PartialEq, Debug)]
pub struct Area {
    /// Left and upper edge of the box.
    pub min: Vec2,
    /// Right and lower edge.
    pub max: Vec2,
    /// Corners of the outline: four of an agent or landmark, 24 on the circle of an object.
    pub outline: Vec<Vec2>,
}

/// The areas of all bodies in a state, agents first.
#[must_use]
pub fn bodies(physics: &PhysicsConfig, state: &State, renderer: &SceneRenderer) -> Vec<(Entity, Area)> {
    let area = |entity: Entity| {
        let corners = match Outline::of(physics, entity, state.body(entity)) {
            Outline::Trapezoid(corners) => corners.to_vec(),
            Outline::Disc { centre, radius } => (0..DISC_CORNERS)
                .map(|k| {
                    let angle = core::f32::consts::TAU * k as f32 / DISC_CORNERS as f32;
                    centre + Vec2::from_angle(angle) * radius
                })
                .collect(),
        };
        (entity, drawn(&corners, renderer))
    };
    physics.entities().map(area).collect()
}

/// The areas of the four landmarks, which do not move.
#[must_use]
pub fn landmarks(renderer: &SceneRenderer) -> Vec<(LandmarkId, Area)> {
    let half = arena::LANDMARK_HALF_SIDE;
    let area = |landmark: LandmarkId| {
        let centre = arena::LANDMARKS[landmark];
        let corner = |x: f32, y: f32| centre + Vec2::new(x, y) * half;
        (
            landmark,
            drawn(&[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], renderer),
        )
    };
    LandmarkId::ALL.into_iter().map(area).collect()
}

fn drawn(corners: &[Vec2], renderer: &SceneRenderer) -> Area {
    let outline: Vec<Vec2> = corners.iter().map(|&corner| renderer.pixel(corner)).collect();
    let min = outline.iter().copied().fold(Vec2::splat(f32::INFINITY), Vec2::min);
    let max = outline.iter().copied().fold(Vec2::splat(f32::NEG_INFINITY), Vec2::max);
    Area { min, max, outline }
}
