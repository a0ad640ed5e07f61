//! The observations of an agent of the published simulator: a cone of cells with occlusion, touch by scaled
//! outlines, and one link of what touches what is observed.

use crate::{
    perimeter::Perimeter,
    recorded::{SIGHT_GRAIN, TOUCH_SCALE},
};
use phase_model::{
    AgentId, BodySet, Entity, ObjectId, PhysicsConfig, Segment, Side, State, Vec2,
    geometry::{self, Outline},
    physics::GRAB_REACH,
};
use phase_perception::{Cell, CellSet, Observation, viewpoint::TAN_HALF_ANGLE};

/// Error of rounding in single precision (u).
const SIGHT_TOLERANCE: f32 = 1e-4;

/// Everything an agent observes of a state.
#[must_use]
pub fn observe(physics: &PhysicsConfig, state: &State, agent: AgentId) -> Observation {
    let visible = visible(physics, state, agent);
    let in_view = |entity: Entity| {
        let perimeter = Perimeter::of(physics, entity, state.body(entity));
        perimeter.cells.iter().any(|&cell| visible.contains(cell))
    };
    Observation::of(physics, state, agent, visible, observed(physics, state, agent, in_view))
}

/// The cells that an agent sees.
#[must_use]
pub fn visible(physics: &PhysicsConfig, state: &State, agent: AgentId) -> CellSet {
    let eye = Eye::new(physics, state, agent);
    Cell::all().filter(|&cell| eye.sees_cell(cell)).collect()
}

/// Whether an agent has an entity in its field of view.
#[must_use]
pub fn in_view(physics: &PhysicsConfig, state: &State, agent: AgentId, entity: Entity) -> bool {
    let eye = Eye::new(physics, state, agent);
    Perimeter::of(physics, entity, state.body(entity)).cells.iter().any(|&cell| eye.sees_cell(cell))
}

/// Whether an object by itself is near enough to an agent to be grabbed, whatever else is.
#[must_use]
pub fn attachable(physics: &PhysicsConfig, state: &State, agent: AgentId, object: ObjectId) -> bool {
    let body = state.body(Entity::Agent(agent));
    let centre = state.position(Entity::Object(object));
    let rotation = Vec2::from_angle(body.angle);
    let reach = physics.object_radii[object] + GRAB_REACH;
    state.grips[agent].is_none()
        && Side::ALL.into_iter().any(|side| {
            let point = rotation.rotate(side.direction() * physics.agents[agent].radius);
            (body.position + point).distance(centre) < reach
        })
}

/// The entities that an agent observes: itself, those in view, those it touches or holds, and what is linked
/// with them directly: links are followed once, from the other agent first, then from each object.
fn observed(
    physics: &PhysicsConfig,
    state: &State,
    agent: AgentId,
    in_view: impl Fn(Entity) -> bool,
) -> BodySet {
    let own = Entity::Agent(agent);
    let other_id = agent.other();
    let other = Entity::Agent(other_id);
    let outline = |entity| Outline::of(physics, entity, state.body(entity));
    let touches =
        |a: Entity, b: Entity| scaled(&outline(a), TOUCH_SCALE).overlaps(&scaled(&outline(b), TOUCH_SCALE));
    let mut observed: BodySet = [own].into_iter().collect();
    let held = state.held_object(agent);
    let shared = held.is_some() && held == state.held_object(other_id);
    if in_view(other) || shared || outline(own).overlaps(&scaled(&outline(other), TOUCH_SCALE)) {
        observed.insert(other);
        for object in physics.objects() {
            if state.holds(other_id, object) || touches(Entity::Object(object), other) {
                observed.insert(Entity::Object(object));
            }
        }
    }
    for object in physics.objects() {
        let entity = Entity::Object(object);
        let felt = held == Some(object) || scaled(&outline(entity), TOUCH_SCALE).overlaps(&outline(own));
        if !(felt || in_view(entity)) {
            continue;
        }
        observed.insert(entity);
        if state.holds(other_id, object) || touches(entity, other) {
            observed.insert(other);
        }
        let neighbours = physics.objects().filter(|&next| next != object).map(Entity::Object);
        for next in neighbours.filter(|&next| touches(entity, next)) {
            observed.insert(next);
        }
    }
    observed
}

/// An outline enlarged about its own origin: the middle of an agent's height, the centre of an object.
pub(crate) fn scaled(outline: &Outline, scale: f32) -> Outline {
    match *outline {
        Outline::Disc { centre, radius } => Outline::Disc { centre, radius: radius * scale },
        Outline::Trapezoid(corners) => {
            let [a, b, c, d] = corners;
            // The origin halves the line between the middles of base and top.
            let origin = (a + b + c + d) * 0.25;
            Outline::Trapezoid(corners.map(|corner| origin + (corner - origin) * scale))
        }
    }
}

/// An agent's eye, prepared for many cells.
struct Eye<'a> {
    physics: &'a PhysicsConfig,
    apex: Vec2,
    axis: Vec2,
    /// Centres (u) and radii (u) of what may hide a cell.
    discs: [(Vec2, f32); 3],
    disc_count: usize,
}

impl<'a> Eye<'a> {
    fn new(physics: &'a PhysicsConfig, state: &State, agent: AgentId) -> Self {
        let body = state.body(Entity::Agent(agent));
        let axis = body.forward();
        let centre = |agent: AgentId| {
            let body = state.body(Entity::Agent(agent));
            body.position - geometry::forward(body.angle) * physics.agents[agent].centre_of_mass_offset()
        };
        let mut discs = [(Vec2::ZERO, 0.0); 3];
        let mut disc_count = 0;
        for entity in physics.entities().filter(|&entity| entity != Entity::Agent(agent)) {
            let place = match entity {
                Entity::Agent(other) => centre(other),
                Entity::Object(_) => state.position(entity),
            };
            discs[disc_count] = (place, physics.radius(entity));
            disc_count += 1;
        }
        Self { physics, apex: centre(agent), axis, discs, disc_count }
    }

    /// Whether the centre of a cell lies strictly inside the cone and nothing is in between.
    fn sees_cell(&self, cell: Cell) -> bool {
        let point = cell.centre();
        let ray = point - self.apex;
        let ahead = self.axis.dot(ray);
        let across = self.axis.perp_dot(ray);
        if ahead <= 0.0 || across.abs() >= TAN_HALF_ANGLE * ahead {
            return false;
        }
        if self.physics.walls.iter().any(|wall| hides(wall, self.apex, ray)) {
            return false;
        }
        let length_squared = ray.length_squared();
        !self.discs[..self.disc_count].iter().any(|&(centre, radius)| {
            let to = centre - self.apex;
            let across = ray.perp_dot(to);
            across * across <= radius * radius * length_squared
                && to.length_squared() <= length_squared
                && centre.distance_squared(point) <= length_squared
        })
    }
}

/// Whether a wall crosses a ray that begins at a point. Where on the wall is rounded, so that one that ends a
/// hair beside the ray hides as well.
fn hides(wall: &Segment, from: Vec2, ray: Vec2) -> bool {
    let along = wall.b - wall.a;
    let denominator = ray.perp_dot(along);
    if denominator == 0.0 {
        return false;
    }
    let to = wall.a - from;
    let on_ray = to.perp_dot(along) / denominator;
    if !(0.0..=1.0).contains(&on_ray) {
        return false;
    }
    let rounded = |it: Vec2| (it / SIGHT_GRAIN).round() * SIGHT_GRAIN;
    let place = rounded(from + ray * on_ray);
    let min = wall.a.min(wall.b) - SIGHT_TOLERANCE;
    let max = wall.a.max(wall.b) + SIGHT_TOLERANCE;
    place.cmpge(min).all() && place.cmple(max).all()
}
