//! The carried assembly: an object and its holders as one rigid body that has to pass a door.

use phase_model::{
    AGENT_COUNT, AgentId, Entity, ObjectId, PhysicsConfig, SlotId, State, Vec2, arena, geometry::Outline,
    layout::SLOT_DIRECTIONS,
};

/// Maximum number of bodies in an assembly: an object and both agents.
const BODIES: usize = 1 + AGENT_COUNT;
/// Clearance kept from a door while an assembly turns (u).
const TURNING_CLEARANCE: f32 = 0.2;
/// Distance before a door at which an aligned assembly aims for the middle of its passage (u).
const ALIGNMENT_DISTANCE: f32 = 1.8;
/// Within this distance of its turning point, the orientation penalty of an assembly has full weight (u).
const FULL_WEIGHT_DISTANCE: f32 = 1.0;
/// Beyond this distance of its turning point, the orientation penalty of an assembly is zero (u).
const ZERO_WEIGHT_DISTANCE: f32 = 6.0;
/// Lateral offset below which an assembly near the door counts as aligned (u).
const ALIGNMENT_TOLERANCE: f32 = 0.3;
/// Distance of the waypoint past the door for an aligned assembly (u).
const OVERSHOOT_DISTANCE: f32 = 1.5;

/// An object and its holders. Grips are rigid, so no member turns without rotating the others about it.
#[derive(Clone, Copy, Debug)]
pub struct CarriedAssembly {
    bodies: [Option<(Vec2, Outline)>; BODIES],
}

/// How an assembly approaches a door: the waypoint for the load and the path length left to the crossing (u).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DoorApproach {
    /// The point that the load should head for (u).
    pub waypoint: Vec2,
    /// Path length until the load reaches the door's line (u), alignment included.
    pub remaining: f32,
}

impl CarriedAssembly {
    /// The assembly of an object that is held.
    #[must_use]
    pub fn of(physics: &PhysicsConfig, state: &State, object: ObjectId) -> Self {
        let body = |entity: Entity| {
            let body = state.body(entity);
            (body.position, Outline::of(physics, entity, body))
        };
        let holder = |agent: AgentId| state.holds(agent, object).then(|| body(Entity::Agent(agent)));
        Self { bodies: [Some(body(Entity::Object(object))), holder(AgentId::ZERO), holder(AgentId::ONE)] }
    }

    fn bodies(&self) -> impl Iterator<Item = &(Vec2, Outline)> {
        self.bodies.iter().flatten()
    }

    /// Mean of the bodies' centres (u), an approximation of the centre of rotation.
    fn centre(&self) -> Vec2 {
        let sum: Vec2 = self.bodies().map(|&(place, _)| place).sum();
        sum / self.bodies().count() as f32
    }

    /// Radius of the circle about [`CarriedAssembly::centre`] that the assembly sweeps when it turns (u).
    fn reach(&self) -> f32 {
        let centre = self.centre();
        self.bodies().map(|(_, outline)| farthest(outline, centre)).fold(0.0, f32::max)
    }

    /// The approach of the assembly to a door that is open between two distances from the arena's centre,
    /// from the side that the load is on. `None` if the door is wide enough for every orientation of the
    /// assembly, or the load has no holder.
    ///
    /// The part that has not passed yet must fit between the door's ends in its present orientation. If it
    /// does not, the assembly turns where there is clearance; otherwise the leading body would enter the door
    /// while the following one stays blocked at the corner. If it fits, the assembly aligns with the door
    /// before it proceeds.
    #[must_use]
    pub fn door_approach(&self, slot: SlotId, (low, high): (f32, f32)) -> Option<DoorApproach> {
        let along = SLOT_DIRECTIONS[slot];
        let reach = self.reach();
        if self.bodies().count() < 2 || high - low >= 2.0 * reach {
            return None;
        }
        let (load, _) = self.bodies[0]?;
        let offset = load - arena::CENTRE;
        // From the door's line to the load's side.
        let inwards = along.perp() * along.perp_dot(offset).signum();
        let depth = inwards.dot(offset);
        let (mut from, mut to, mut past) = (f32::INFINITY, f32::NEG_INFINITY, false);
        for (_, outline) in self.bodies() {
            let (_, rear) = extent(outline, inwards);
            if rear <= 0.0 {
                past = true;
                continue;
            }
            let (first, last) = extent(outline, along);
            (from, to) = (from.min(first), to.max(last));
        }
        let excess = (to - from - (high - low)).max(0.0);
        if excess > 0.0 && !past {
            let centre = self.centre();
            let room = reach + TURNING_CLEARANCE;
            let turning = arena::CENTRE + along * (0.5 * (low + high)) + inwards * room;
            let way = turning - centre;
            let away = way.length();
            // Always more than for an aligned assembly, but less than the gain of approaching.
            let penalty_weight = ((ZERO_WEIGHT_DISTANCE - away)
                / (ZERO_WEIGHT_DISTANCE - FULL_WEIGHT_DISTANCE))
                .clamp(0.0, 1.0);
            let remaining = away + room + penalty_weight * (reach + excess);
            return Some(DoorApproach { waypoint: load + way, remaining });
        }
        // Lateral correction until the assembly lies between the door's ends, or is centred on the door.
        let aside = if excess > 0.0 {
            0.5 * (low + high - from - to)
        } else {
            (low - from).max(0.0) - (to - high).max(0.0)
        };
        let crossing = arena::CENTRE + along * (along.dot(offset) + aside);
        Some(if depth > ALIGNMENT_DISTANCE {
            let line_up = crossing + inwards * ALIGNMENT_DISTANCE;
            DoorApproach {
                waypoint: line_up,
                remaining: load.distance(line_up) + ALIGNMENT_DISTANCE + excess,
            }
        } else if aside.abs() < ALIGNMENT_TOLERANCE {
            DoorApproach {
                waypoint: crossing - inwards * OVERSHOOT_DISTANCE,
                remaining: aside.abs() + depth + excess,
            }
        } else {
            DoorApproach { waypoint: load + along * aside, remaining: aside.abs() + depth + excess }
        })
    }
}

/// Interval that an outline covers along a direction, as distances from the arena's centre (u).
fn extent(outline: &Outline, direction: Vec2) -> (f32, f32) {
    let at = |point: Vec2| direction.dot(point - arena::CENTRE);
    match *outline {
        Outline::Disc { centre, radius } => (at(centre) - radius, at(centre) + radius),
        Outline::Trapezoid(corners) => corners
            .iter()
            .map(|&corner| at(corner))
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(first, last), at| (first.min(at), last.max(at))),
    }
}

/// Distance of an outline's farthest point (u).
fn farthest(outline: &Outline, from: Vec2) -> f32 {
    match *outline {
        Outline::Disc { centre, radius } => centre.distance(from) + radius,
        Outline::Trapezoid(corners) => corners.iter().map(|corner| corner.distance(from)).fold(0.0, f32::max),
    }
}
