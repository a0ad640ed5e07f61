//! An object and the agents that hold it, as one rigid body.

use phase_model::{
    AGENT_COUNT, AgentId, Entity, Grip, ObjectId, PhysicsConfig, Segment, Vec2, arena,
    geometry::{Outline, trapezoid},
};

/// An object (the *load*) with its holders, in the frame of the object: its centre, and its angle.
///
/// Grips are rigid, so the assembly is the same for as long as they last.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Assembly {
    load_radius: f32,
    holders: [Option<Holder>; AGENT_COUNT],
}

/// An agent in the frame of the load.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Holder {
    position: Vec2,
    angle: f32,
    radius: f32,
}

/// The outlines of an assembly in one orientation, with the load at the origin.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    outlines: Vec<Outline>,
    /// From the load's centre to those of its holders: no wall fits between load and holder.
    spines: Vec<Segment>,
    min: Vec2,
    max: Vec2,
}

impl Assembly {
    /// The assembly of an object and those who hold it.
    #[must_use]
    pub fn of(physics: &PhysicsConfig, grips: &[Option<Grip>; AGENT_COUNT], object: ObjectId) -> Self {
        let load_radius = physics.radius(Entity::Object(object));
        let holders = AgentId::ALL.map(|agent| {
            let grip = grips[agent].filter(|grip| grip.object == object)?;
            let radius = physics.radius(Entity::Agent(agent));
            let angle = -grip.relative_angle;
            let to_load = rotation(angle).rotate(grip.side.direction()) * (radius + load_radius);
            Some(Holder { position: -to_load, angle, radius })
        });
        Self { load_radius, holders }
    }

    /// The number of agents that hold the load.
    #[must_use]
    pub fn holder_count(&self) -> usize {
        self.holders.iter().flatten().count()
    }

    /// The outlines, reduced by an overlap (u), when the load has an angle (rad).
    pub(crate) fn shape(&self, angle: f32, overlap: f32) -> Shape {
        let turn = rotation(angle);
        let load = Outline::Disc { centre: Vec2::ZERO, radius: (self.load_radius - overlap).max(0.0) };
        let mut shape =
            Shape { outlines: vec![load], spines: Vec::new(), min: Vec2::INFINITY, max: Vec2::NEG_INFINITY };
        for holder in self.holders.iter().flatten() {
            let centre = turn.rotate(holder.position);
            let own = rotation(angle + holder.angle);
            let corners = trapezoid((holder.radius - overlap).max(0.0));
            shape.outlines.push(Outline::Trapezoid(corners.map(|corner| centre + own.rotate(corner))));
            shape.spines.push(Segment { a: Vec2::ZERO, b: centre });
        }
        for (min, max) in shape.outlines.iter().map(Outline::bounds) {
            (shape.min, shape.max) = (shape.min.min(min), shape.max.max(max));
        }
        shape
    }

    /// The bits that determine it.
    pub(crate) fn bits(&self) -> impl Iterator<Item = u32> {
        let holders = self.holders.iter().flat_map(|holder| {
            holder.map_or([f32::NAN; 4], |Holder { position, angle, radius }| {
                [position.x, position.y, angle, radius]
            })
        });
        core::iter::once(self.load_radius).chain(holders).map(f32::to_bits)
    }
}

impl Shape {
    /// Whether a wall crosses the assembly, or part of it is outside the arena, with the load at a point (u).
    pub(crate) fn collides(&self, load: Vec2, walls: &[Segment]) -> bool {
        let is_inside = arena::contains(load + self.min) && arena::contains(load + self.max);
        !is_inside
            || walls.iter().any(|wall| {
                let wall = Segment { a: wall.a - load, b: wall.b - load };
                let low = wall.a.min(wall.b);
                let high = wall.a.max(wall.b);
                let is_near = low.cmple(self.max).all() && high.cmpge(self.min).all();
                is_near
                    && (self.outlines.iter().any(|outline| outline.overlaps_wall(wall))
                        || self.spines.iter().any(|spine| spine.crosses(wall)))
            })
    }
}

fn rotation(angle: f32) -> Vec2 {
    Vec2::from_angle(angle)
}
