//! What can touch what: coarse tests that spare the exact ones.

use crate::{
    group::Groups,
    impact,
    key::{BodySet, KeySet, PAIRS, bit, pair_key, wall_keys},
    outline::Aabb,
    tuning::{H, SKIN},
    world::World,
};
use phase_model::{AGENT_COUNT, arena};

/// Substeps in a step, as seconds.
const STEP: f32 = arena::SUBSTEPS as f32 * H;
/// Way in a step per unit of constant acceleration, since each substep moves with its final speed (s²).
const WAY_PER_ACCELERATION: f32 = 15.0 * H * H;
/// Room for position corrections in a group of bodies (u).
const CORRECTIONS: f32 = 0.5;
/// Leeway of all tests (u).
const LEEWAY: f32 = 0.02;

/// The bodies that may touch or hold anything in the coming step, whatever happens; all others move alone.
/// Notes for each of them which walls it can reach.
pub(crate) fn members(world: &mut World<'_>) -> BodySet {
    let model = world.model;
    let mut members: BodySet = 0;
    let mut ways = [0.0_f32; 4];
    for (body, longest) in ways.iter_mut().enumerate().take(model.count) {
        let (motion, shape) = (&world.motions[body], &model.shapes[body]);
        let mut way = motion.velocity.length() * STEP;
        if body < AGENT_COUNT && world.actions[body].push().is_some() {
            way += shape.max_force * shape.inverse_mass * WAY_PER_ACCELERATION;
        }
        *longest = way;
        world.walls[body] = model.boxes.near_point(motion.centre, shape.bound + way + LEEWAY);
        members |= u8::from(world.walls[body] != 0) << body;
    }
    world.ways = ways;
    let (mut grouped, mut stretch): (BodySet, f32) = (0, 0.0);
    for agent in 0..AGENT_COUNT {
        if let Some(held) = world.held(agent) {
            grouped |= 1 << agent | 1 << held;
            stretch += world.stretch(agent).unwrap_or(0.0);
        }
    }
    let reaches = |a: usize, b: usize, way: f32| {
        let reach = model.shapes[a].bound + model.shapes[b].bound + way + LEEWAY;
        b < model.count && world.motions[a].centre.distance_squared(world.motions[b].centre) < reach * reach
    };
    for (a, b) in PAIRS {
        if reaches(a, b, ways[a] + ways[b]) {
            grouped |= 1 << a | 1 << b;
        }
    }
    if grouped == 0 {
        return members;
    }
    // Bodies that hit each other may go anywhere that their speeds together could take them.
    let mut before = 0;
    let mut together = 0.0;
    while grouped != before {
        before = grouped;
        let sum: f32 = (0..model.count).filter(|body| grouped & 1 << body != 0).map(|body| ways[body]).sum();
        together = 2.0 * sum + stretch + CORRECTIONS;
        for (a, b) in PAIRS {
            let (first, second) = (grouped & 1 << a != 0, grouped & 1 << b != 0);
            if first != second && reaches(a, b, together + if first { ways[b] } else { ways[a] }) {
                grouped |= 1 << a | 1 << b;
            }
        }
    }
    for body in 0..model.count {
        if grouped & 1 << body != 0 {
            let centre = world.motions[body].centre;
            world.walls[body] = model.boxes.near_point(centre, model.shapes[body].bound + together);
        }
    }
    members | grouped
}

/// Whether bodies of different rigid groups may collide in the coming step.
pub(crate) fn strangers_meet(world: &World<'_>, groups: &Groups) -> bool {
    let model = world.model;
    let way = |body: usize| {
        groups.bodies_of(groups.names[body]).map(|member| world.ways[member]).fold(0.0, f32::max)
    };
    PAIRS.into_iter().any(|(a, b)| {
        let apart = groups.names[a] != groups.names[b] && b < model.count;
        let reach = model.shapes[a].bound + model.shapes[b].bound + LEEWAY;
        let (first, second) = (&world.motions[a], &world.motions[b]);
        let distance_squared = first.centre.distance_squared(second.centre);
        apart && {
            let reach = reach + way(a) + way(b);
            distance_squared < reach * reach
        }
    })
}

/// Those of the given bodies that the coming substep can change, and all pairs of shapes that may touch in it, but
/// for those that are kept apart. `None` if nothing can change. Their outlines are up to date afterwards.
pub(crate) fn at_work(world: &mut World<'_>, members: BodySet, apart: KeySet) -> Option<(BodySet, KeySet)> {
    let pairs = pairs_near(world, members) & !apart;
    let busy = busy(world, members, pairs);
    if busy == 0 {
        return None;
    }
    world.outline(busy);
    let walls = (0..world.model.count)
        .filter(|body| busy & 1 << body != 0)
        .fold(0, |keys, body| keys | walls_near(world, body));
    Some((busy, pairs | walls))
}

/// The bodies that the coming substep may change: all but sleeping bodies without an active
/// neighbour. Neighbours of active bodies are woken.
fn busy(world: &mut World<'_>, members: BodySet, pairs: KeySet) -> BodySet {
    let mut busy = members & !world.at_ease;
    if busy == members {
        return busy;
    }
    let mut before = 0;
    while busy != before {
        before = busy;
        let mut wake = |both: BodySet| {
            if busy & both != 0 {
                busy |= both;
            }
        };
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            if pairs & bit(pair_key(pair)) != 0 {
                wake(1 << a | 1 << b);
            }
        }
        for agent in 0..AGENT_COUNT {
            if let Some(held) = world.held(agent) {
                wake(1 << agent | 1 << held);
            }
        }
    }
    world.at_ease &= !busy;
    busy
}

/// The pairs of bodies in a set whose circles overlap now.
pub(crate) fn pairs_near(world: &World<'_>, members: BodySet) -> KeySet {
    let model = world.model;
    let mut near = 0;
    for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
        if members & 1 << a != 0 && members & 1 << b != 0 {
            let reach = model.shapes[a].bound + model.shapes[b].bound;
            if world.motions[a].centre.distance_squared(world.motions[b].centre) <= reach * reach {
                near |= bit(pair_key(pair));
            }
        }
    }
    near
}

/// The walls in reach in this step whose box a body's box reaches now. Its outline must be up to date.
#[inline]
pub(crate) fn walls_near(world: &World<'_>, body: usize) -> KeySet {
    if world.walls[body] == 0 {
        return 0;
    }
    let (min, max) = world.outlines.boxes[body];
    let skin = agent_skin(body);
    wall_keys(world.walls[body] & world.model.boxes.near(min - skin, max + skin), body)
}

/// Whether a body may have reached a wall on its way through this substep: whether its boxes at the two ends
/// of the way do not lie both beyond each wall, on one side. The outline at the end must be up to date.
#[inline]
pub(crate) fn may_meet_wall(world: &World<'_>, body: usize, (from_min, from_max): Aabb) -> bool {
    let (to_min, to_max) = world.outlines.boxes[body];
    if world.walls[body] == 0 || from_min == to_min && from_max == to_max {
        return false;
    }
    // Walls have their skin in their boxes.
    let room = impact::room(&world.model.shapes[body]) - SKIN;
    let (min, max) = (from_min.min(to_min) - room, from_max.max(to_max) + room);
    world.walls[body] & world.model.boxes.near(min, max) != 0
}

/// The walls whose box a body's circle has swept over in this substep.
pub(crate) fn walls_swept(world: &World<'_>, body: usize) -> KeySet {
    let (start, angle, _) = world.starts[body];
    let motion = &world.motions[body];
    if start == motion.centre && angle == motion.angle {
        return 0;
    }
    let room = world.model.shapes[body].bound;
    let (min, max) = (start.min(motion.centre) - room, start.max(motion.centre) + room);
    wall_keys(world.model.boxes.near(min, max), body)
}

/// Room that a body's box leaves for the body's skin (u): discs have theirs inside.
const fn agent_skin(body: usize) -> f32 {
    if body < AGENT_COUNT { SKIN } else { 0.0 }
}
