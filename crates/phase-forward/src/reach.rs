//! What can touch what: coarse tests that spare the exact ones.

use crate::{
    key::{KeySet, PAIRS, bit, pair_key, wall_key},
    substep::BodySet,
    tuning::H,
    world::World,
};
use phase_model::{AGENT_COUNT, Vec2, arena};

/// Substeps in a step, as seconds.
const STEP: f32 = arena::SUBSTEPS as f32 * H;
/// Way in a step per unit of constant acceleration, since each substep moves with its final speed (s²).
const WAY_PER_ACCELERATION: f32 = 15.0 * H * H;
/// Room for position corrections in a group of bodies (u).
const CORRECTIONS: f32 = 0.5;
/// Leeway of all tests (u).
const LEEWAY: f32 = 0.02;

/// The bodies that may touch or hold anything in the coming step, whatever happens; all others move alone.
pub(crate) fn members(world: &World<'_>) -> BodySet {
    let forward = world.forward;
    let mut members: BodySet = 0;
    let mut ways = [0.0_f32; 4];
    for (body, way) in ways.iter_mut().enumerate().take(forward.count) {
        let (motion, shape) = (&world.motions[body], &forward.shapes[body]);
        *way = motion.velocity.length() * STEP;
        if body < AGENT_COUNT && world.actions[body].push().is_some() {
            *way += shape.max_force * shape.inverse_mass * WAY_PER_ACCELERATION;
        }
        let room = Vec2::splat(shape.bound + *way + LEEWAY);
        if near_walls(world, body, motion.centre - room, motion.centre + room) != 0 {
            members |= 1 << body;
        }
    }
    let mut grouped: BodySet = 0;
    for agent in 0..AGENT_COUNT {
        if let Some(held) = world.held(agent) {
            grouped |= 1 << agent | 1 << held;
        }
    }
    let reaches = |a: usize, b: usize, way: f32| {
        let reach = forward.shapes[a].bound + forward.shapes[b].bound + way + LEEWAY;
        b < forward.count
            && world.motions[a].centre.distance_squared(world.motions[b].centre) < reach * reach
    };
    for (a, b) in PAIRS {
        if reaches(a, b, ways[a] + ways[b]) {
            grouped |= 1 << a | 1 << b;
        }
    }
    // Bodies that hit each other may go anywhere that their speeds together could take them.
    let mut before = 0;
    while grouped != before {
        before = grouped;
        let together: f32 = (0..forward.count).filter(|body| grouped & 1 << body != 0).map(|b| ways[b]).sum();
        let together = 2.0 * together + CORRECTIONS;
        for (a, b) in PAIRS {
            let (first, second) = (grouped & 1 << a != 0, grouped & 1 << b != 0);
            if first != second && reaches(a, b, together + if first { ways[b] } else { ways[a] }) {
                grouped |= 1 << a | 1 << b;
            }
        }
    }
    members | grouped
}

/// The pairs of bodies in a set whose circles overlap now.
pub(crate) fn pairs_near(world: &World<'_>, members: BodySet) -> KeySet {
    let forward = world.forward;
    let mut near = 0;
    for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
        if members & 1 << a != 0 && members & 1 << b != 0 {
            let reach = forward.shapes[a].bound + forward.shapes[b].bound;
            if world.motions[a].centre.distance_squared(world.motions[b].centre) <= reach * reach {
                near |= bit(pair_key(pair));
            }
        }
    }
    near
}

/// The walls whose box a body's circle reaches now.
pub(crate) fn walls_near(world: &World<'_>, body: usize) -> KeySet {
    let room = Vec2::splat(world.forward.shapes[body].bound);
    let centre = world.motions[body].centre;
    near_walls(world, body, centre - room, centre + room)
}

/// The walls whose box a body's circle has swept over in this substep.
pub(crate) fn walls_on_way(world: &World<'_>, body: usize) -> KeySet {
    let (start, angle, _) = world.starts[body];
    let motion = &world.motions[body];
    if start == motion.centre && angle == motion.angle {
        return 0;
    }
    let room = Vec2::splat(world.forward.shapes[body].bound);
    near_walls(world, body, start.min(motion.centre) - room, start.max(motion.centre) + room)
}

/// The walls whose boxes overlap a box.
#[inline]
fn near_walls(world: &World<'_>, body: usize, min: Vec2, max: Vec2) -> KeySet {
    let forward = world.forward;
    let mut near = 0;
    for (index, wall) in forward.walls[..forward.wall_count].iter().enumerate() {
        if wall.min.x <= max.x && wall.max.x >= min.x && wall.min.y <= max.y && wall.max.y >= min.y {
            near |= bit(wall_key(index, body));
        }
    }
    near
}
