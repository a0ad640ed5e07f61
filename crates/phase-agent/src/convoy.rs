//! A load and all who hold it, as one rigid body that has to get through a door.

use phase_model::{
    AGENT_COUNT, AgentId, Entity, ObjectId, Physique, SlotId, State, Vec2, arena, geometry::Outline,
    layout::SLOT_DIRECTIONS,
};

/// Most bodies of a convoy: an object and both agents.
const BODIES: usize = 1 + AGENT_COUNT;
/// Room kept before a door when a convoy turns (u).
const TURNING_ROOM: f32 = 0.2;
/// Distance before a door at which a convoy in line heads for the middle of its way through (u).
const LINE_UP: f32 = 1.8;
/// Nearer than this to where it is to turn, how a convoy lies counts in full (u).
const NEAR: f32 = 1.0;
/// Farther than this from where it is to turn, how a convoy lies does not count yet (u).
const FAR: f32 = 6.0;
/// Being this much beside its way, a convoy that is near the door may go on into it (u).
const IN_LINE: f32 = 0.3;
/// How far past a door one heads that is in line with it (u).
const BEYOND: f32 = 1.5;

/// An object and its holders. They hold on rigidly: none of them turns without swinging the others round.
#[derive(Clone, Copy, Debug)]
pub struct Convoy {
    bodies: [Option<(Vec2, Outline)>; BODIES],
}

/// How a convoy stands to a door: where to head for with the load, and how far that makes it to the crossing (u).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Entrance {
    /// The point for the load to head for (u).
    pub heading_for: Vec2,
    /// What is left until the load is at the door's line (u), with what it takes to get in line.
    pub remaining: f32,
}

impl Convoy {
    /// The convoy of an object that somebody holds.
    #[must_use]
    pub fn of(physique: &Physique, state: &State, object: ObjectId) -> Self {
        let body = |entity: Entity| {
            let body = state.body(entity);
            (body.position, Outline::of(physique, entity, body))
        };
        let holder = |agent: AgentId| state.holds(agent, object).then(|| body(Entity::Agent(agent)));
        Self { bodies: [Some(body(Entity::Object(object))), holder(AgentId::ZERO), holder(AgentId::ONE)] }
    }

    fn bodies(&self) -> impl Iterator<Item = &(Vec2, Outline)> {
        self.bodies.iter().flatten()
    }

    /// The mean of the bodies' centres, about which the convoy turns, roughly (u).
    fn centre(&self) -> Vec2 {
        let sum: Vec2 = self.bodies().map(|&(place, _)| place).sum();
        sum / self.bodies().count() as f32
    }

    /// The circle about [`Convoy::centre`] that the convoy needs to turn in (u).
    fn reach(&self) -> f32 {
        let centre = self.centre();
        self.bodies().map(|(_, outline)| farthest(outline, centre)).fold(0.0, f32::max)
    }

    /// How the convoy gets through a door that is passable between two distances from the arena's centre, from the
    /// side that the load is on. `None` where the door is wide enough for it however it lies, or the load is alone.
    ///
    /// What is not through yet has to fit between the door's ends as it lies. If it does not, the convoy turns
    /// where it has room to, or what leads would be in the door with what follows held up at the corner, for
    /// good; if it does, it gets in line before it goes on.
    #[must_use]
    pub fn entrance(&self, slot: SlotId, (low, high): (f32, f32)) -> Option<Entrance> {
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
            let room = reach + TURNING_ROOM;
            let turning = arena::CENTRE + along * (0.5 * (low + high)) + inwards * room;
            let way = turning - centre;
            let away = way.length();
            // Always more than in line, but less than it takes to come nearer.
            let minded = ((FAR - away) / (FAR - NEAR)).clamp(0.0, 1.0);
            let remaining = away + room + minded * (reach + excess);
            return Some(Entrance { heading_for: load + way, remaining });
        }
        // Sideways, until it lies between the door's ends, or as much to one side as to the other.
        let aside = if excess > 0.0 {
            0.5 * (low + high - from - to)
        } else {
            (low - from).max(0.0) - (to - high).max(0.0)
        };
        let crossing = arena::CENTRE + along * (along.dot(offset) + aside);
        Some(if depth > LINE_UP {
            let line_up = crossing + inwards * LINE_UP;
            Entrance { heading_for: line_up, remaining: load.distance(line_up) + LINE_UP + excess }
        } else if aside.abs() < IN_LINE {
            Entrance { heading_for: crossing - inwards * BEYOND, remaining: aside.abs() + depth + excess }
        } else {
            Entrance { heading_for: load + along * aside, remaining: aside.abs() + depth + excess }
        })
    }
}

/// From where to where an outline reaches in a direction, as distances from the arena's centre (u).
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
