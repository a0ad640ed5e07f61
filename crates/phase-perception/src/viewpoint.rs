//! The viewpoint: which points are in an agent's cone of view and not occluded.

use crate::{
    cells::{Cell, CellSet},
    footprint::any_cell,
};
use phase_model::{
    AgentId, Body, Entity, MAX_ENTITIES, PhysicsConfig, Segment, State, Vec2,
    geometry::{self, FARTHEST_CORNER, Outline},
};

/// Tangent of the cone's half angle of 54.69°: 0.8 across for 17/30 ahead.
pub const TAN_HALF_ANGLE: f32 = 24.0 / 17.0;

/// The cells whose centre an agent sees.
#[must_use]
pub fn field_of_view(physics: &PhysicsConfig, state: &State, agent: AgentId) -> CellSet {
    let viewpoint = Viewpoint::new(physics, state, agent);
    Cell::all().filter(|&cell| viewpoint.sees_cell(cell)).collect()
}

/// Whether an agent sees an entity: whether one of the cells of the entity's footprint is visible when the
/// entity itself does not occlude. No agent sees itself.
#[must_use]
pub fn sees(physics: &PhysicsConfig, state: &State, agent: AgentId, entity: Entity) -> bool {
    Viewpoint::new(physics, state, agent).sees(entity)
}

/// An agent's viewpoint in one state of the world, prepared for many queries.
#[derive(Clone, Debug)]
pub struct Viewpoint<'a> {
    physics: &'a PhysicsConfig,
    state: &'a State,
    agent: AgentId,
    apex: Vec2,
    axis: Vec2,
    /// The bodies that may occlude, by [`Entity::index`].
    discs: [Disc; MAX_ENTITIES],
}

impl<'a> Viewpoint<'a> {
    /// The viewpoint of an agent in a state.
    #[must_use]
    pub fn new(physics: &'a PhysicsConfig, state: &'a State, agent: AgentId) -> Self {
        let own = Entity::Agent(agent);
        let body = state.body(own);
        let axis = body.forward();
        let apex = body.position - axis * physics.agents[agent].centre_of_mass_offset();
        let mut discs = [Disc::NOTHING; MAX_ENTITIES];
        for entity in physics.entities().filter(|&entity| entity != own) {
            let centre = disc_centre(physics, entity, state.body(entity));
            let radius = physics.radius(entity);
            discs[entity.index()] = Disc { centre: centre - apex, radius_squared: radius * radius };
        }
        Self { physics, state, agent, apex, axis, discs }
    }

    /// This viewpoint if an entity hides nothing, as it has gone somewhere else.
    #[must_use]
    pub fn without(mut self, entity: Entity) -> Self {
        self.discs[entity.index()] = Disc::NOTHING;
        self
    }

    /// Position of the eye: the agent's centre of mass (u).
    #[must_use]
    pub fn apex(&self) -> Vec2 {
        self.apex
    }

    /// Whether the centre of a cell is in view and not occluded.
    #[must_use]
    pub fn sees_cell(&self, cell: Cell) -> bool {
        self.sees_point_ignoring(cell.centre(), None)
    }

    /// Whether an entity is seen; see [`sees`].
    #[must_use]
    pub fn sees(&self, entity: Entity) -> bool {
        if entity == Entity::Agent(self.agent) || entity.index() >= self.physics.entity_count() {
            return false;
        }
        let body = self.state.body(entity);
        let reach = self.physics.radius(entity)
            * match entity {
                Entity::Agent(_) => FARTHEST_CORNER,
                Entity::Object(_) => 1.0,
            };
        if self.out_of_cone(body.position - self.apex, reach + HALF_DIAGONAL) {
            return false;
        }
        let seen = |cell: Cell| self.sees_point_ignoring(cell.centre(), Some(entity));
        // The cell of the origin is always part of the footprint, and is usually decisive.
        Cell::at(body.position).is_some_and(seen) || any_cell(&Outline::of(self.physics, entity, body), seen)
    }

    /// Whether a point is in view and not occluded, except possibly by one given body.
    fn sees_point_ignoring(&self, point: Vec2, see_through: Option<Entity>) -> bool {
        let ray = point - self.apex;
        in_cone(ray, self.axis)
            && !self.physics.walls.iter().any(|&wall| blocks(wall, self.apex, point))
            && !self.discs.iter().enumerate().any(|(index, disc)| {
                disc.blocks(ray) && see_through.is_none_or(|entity| entity.index() != index)
            })
    }

    /// Whether everything within a distance of a point lies outside the cone; the point is relative to the
    /// apex. Conservative: may return false where the answer is true.
    fn out_of_cone(&self, point: Vec2, distance: f32) -> bool {
        // Distance from the closer edge of the cone, on a scale of tan² + 1 instead of 1.
        let outside = self.axis.perp_dot(point).abs() - TAN_HALF_ANGLE * self.axis.dot(point);
        outside > 0.0 && outside * outside > distance * distance * (1.0 + TAN_SQUARED)
    }
}

const TAN_SQUARED: f32 = TAN_HALF_ANGLE * TAN_HALF_ANGLE;
/// Half the diagonal of a cell, rounded up (u).
const HALF_DIAGONAL: f32 = 0.7072;

/// Whether a direction lies strictly inside the cone around a unit vector.
fn in_cone(ray: Vec2, axis: Vec2) -> bool {
    let ahead = axis.dot(ray);
    let across = axis.perp_dot(ray);
    ahead > 0.0 && across * across < TAN_SQUARED * (ahead * ahead)
}

/// Whether a wall lies between two points. Points on the wall's line are on neither side of it; a ray through
/// a wall's end is blocked.
fn blocks(wall: Segment, apex: Vec2, point: Vec2) -> bool {
    let along = wall.b - wall.a;
    let eye_side = along.perp_dot(apex - wall.a);
    let point_side = along.perp_dot(point - wall.a);
    if eye_side * point_side >= 0.0 {
        return false;
    }
    let ray = point - apex;
    ray.perp_dot(wall.a - apex) * ray.perp_dot(wall.b - apex) <= 0.0
}

/// The centre of the disc that represents an entity as an occluder: the centre of mass (u).
fn disc_centre(physics: &PhysicsConfig, entity: Entity, body: &Body) -> Vec2 {
    match entity {
        Entity::Agent(agent) => {
            let offset = physics.agents[agent].centre_of_mass_offset();
            body.position - geometry::forward(body.angle) * offset
        }
        Entity::Object(_) => body.position,
    }
}

/// An occluding disc, its centre relative to the apex.
#[derive(Clone, Copy, Debug)]
struct Disc {
    centre: Vec2,
    radius_squared: f32,
}

impl Disc {
    /// A disc that occludes nothing.
    const NOTHING: Self = Self { centre: Vec2::ZERO, radius_squared: 0.0 };

    /// Whether the disc has inner points on the straight line from the apex to the end of a ray. A disc whose
    /// centre is not ahead does not block: an eye inside a body still sees in the direction away from it.
    fn blocks(&self, ray: Vec2) -> bool {
        let ahead = ray.dot(self.centre);
        let length_squared = ray.length_squared();
        if ahead >= length_squared {
            return ray.distance_squared(self.centre) < self.radius_squared;
        }
        let across = ray.perp_dot(self.centre);
        ahead > 0.0 && across * across < self.radius_squared * length_squared
    }
}
