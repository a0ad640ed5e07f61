//! Conservative reachability tests that avoid exact ones.

use crate::{
    constants::{H, SKIN},
    group::Groups,
    key::{BodyMask, KeySet, PAIRS, bit, pair_key, wall_keys},
    outline::Aabb,
    time_of_impact,
    world::World,
};
use phase_model::{AGENT_COUNT, arena};

/// Duration of a step (s).
const STEP: f32 = arena::STEP_SECONDS as f32;
/// Displacement in a step per unit of constant acceleration, since each substep moves with its final speed
/// (s²).
const DISPLACEMENT_PER_ACCELERATION: f32 = 15.0 * H * H;
/// Margin for position corrections in a group of bodies (u).
const CORRECTION_MARGIN: f32 = 0.5;
/// Leeway of all tests (u).
pub(crate) const MARGIN: f32 = 0.02;

/// The bodies that may touch or hold anything in the coming step, whatever happens; all others move alone.
/// Records for each of them which walls it can reach.
pub(crate) fn reachable_bodies(world: &mut World<'_>) -> BodyMask {
    let model = world.model;
    let mut reachable_bodies: BodyMask = 0;
    let mut max_displacements = [0.0_f32; 4];
    for (body, longest) in max_displacements.iter_mut().enumerate().take(model.count) {
        let motion = &world.motions[body];
        let shape = &model.shapes[body];
        let mut sweep = motion.velocity.length() * STEP;
        if body < AGENT_COUNT && world.actions[body].push().is_some() {
            sweep += shape.max_force * shape.inverse_mass * DISPLACEMENT_PER_ACCELERATION;
        }
        *longest = sweep;
        world.walls[body] = model.boxes.near_point(motion.centre, shape.bounding_radius + sweep + MARGIN);
        reachable_bodies |= u8::from(world.walls[body] != 0) << body;
    }
    world.max_displacements = max_displacements;
    let mut grouped: BodyMask = 0;
    let mut joint_error: f32 = 0.0;
    for agent in 0..AGENT_COUNT {
        if let Some(held) = world.held(agent) {
            grouped |= 1 << agent | 1 << held;
            joint_error += world.joint_error(agent).unwrap_or(0.0);
        }
    }
    let reaches = |a: usize, b: usize, sweep: f32| {
        let reach = model.shapes[a].bounding_radius + model.shapes[b].bounding_radius + sweep + MARGIN;
        b < model.count && world.motions[a].centre.distance_squared(world.motions[b].centre) < reach * reach
    };
    for (a, b) in PAIRS {
        if reaches(a, b, max_displacements[a] + max_displacements[b]) {
            grouped |= 1 << a | 1 << b;
        }
    }
    if grouped == 0 {
        return reachable_bodies;
    }
    // Bodies that collide may go anywhere that the sum of their speeds could take them.
    let mut before = 0;
    let mut together = 0.0;
    while grouped != before {
        before = grouped;
        let sum: f32 = (0..model.count)
            .filter(|body| grouped & 1 << body != 0)
            .map(|body| max_displacements[body])
            .sum();
        together = 2.0 * sum + joint_error + CORRECTION_MARGIN;
        for (a, b) in PAIRS {
            let first = grouped & 1 << a != 0;
            let second = grouped & 1 << b != 0;
            if first != second
                && reaches(a, b, together + if first { max_displacements[b] } else { max_displacements[a] })
            {
                grouped |= 1 << a | 1 << b;
            }
        }
    }
    for body in 0..model.count {
        if grouped & 1 << body != 0 {
            let centre = world.motions[body].centre;
            world.walls[body] = model.boxes.near_point(centre, model.shapes[body].bounding_radius + together);
        }
    }
    reachable_bodies | grouped
}

/// Whether bodies of different rigid groups may collide in the coming step.
pub(crate) fn groups_may_collide(world: &World<'_>, groups: &Groups) -> bool {
    let model = world.model;
    let sweep = |body: usize| {
        groups.bodies_of(groups.names[body]).map(|member| world.max_displacements[member]).fold(0.0, f32::max)
    };
    model.collisions
        && PAIRS.into_iter().any(|(a, b)| {
            let excluded_pairs = groups.names[a] != groups.names[b] && b < model.count;
            let reach = model.shapes[a].bounding_radius + model.shapes[b].bounding_radius + MARGIN;
            let first = &world.motions[a];
            let second = &world.motions[b];
            let distance_squared = first.centre.distance_squared(second.centre);
            excluded_pairs && {
                let reach = reach + sweep(a) + sweep(b);
                distance_squared < reach * reach
            }
        })
}

/// Those of the given bodies that the coming substep can change, and all pairs of shapes that may touch in
/// it, except those that are kept apart. `None` if nothing can change. Their outlines are up to date
/// afterwards.
pub(crate) fn active_set(
    world: &mut World<'_>,
    reachable_bodies: BodyMask,
    excluded_pairs: KeySet,
) -> Option<(BodyMask, KeySet)> {
    let pairs = pairs_near(world, reachable_bodies) & !excluded_pairs;
    let active = active(world, reachable_bodies, pairs);
    if active == 0 {
        return None;
    }
    world.outline(active);
    let walls = (0..world.model.count)
        .filter(|body| active & 1 << body != 0)
        .fold(0, |keys, body| keys | walls_near(world, body));
    Some((active, pairs | walls))
}

/// The bodies that the coming substep may change: all but sleeping bodies without an active
/// neighbour. Neighbours of active bodies are woken.
fn active(world: &mut World<'_>, reachable_bodies: BodyMask, pairs: KeySet) -> BodyMask {
    let mut active = reachable_bodies & !world.sleeping;
    if active == reachable_bodies {
        return active;
    }
    let mut before = 0;
    while active != before {
        before = active;
        let mut wake = |both: BodyMask| {
            if active & both != 0 {
                active |= both;
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
    world.sleeping &= !active;
    active
}

/// The pairs of bodies in a set whose bounding circles overlap now.
pub(crate) fn pairs_near(world: &World<'_>, reachable_bodies: BodyMask) -> KeySet {
    let model = world.model;
    let mut near = 0;
    for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
        if reachable_bodies & 1 << a != 0 && reachable_bodies & 1 << b != 0 {
            let reach = model.shapes[a].bounding_radius + model.shapes[b].bounding_radius;
            if world.motions[a].centre.distance_squared(world.motions[b].centre) <= reach * reach {
                near |= bit(pair_key(pair));
            }
        }
    }
    near
}

/// The walls reachable in this step whose box overlaps a body's box now. Its outline must be up to date.
#[inline]
pub(crate) fn walls_near(world: &World<'_>, body: usize) -> KeySet {
    if world.walls[body] == 0 {
        return 0;
    }
    let (min, max) = world.outlines.boxes[body];
    let skin = agent_skin(body);
    wall_keys(world.walls[body] & world.model.boxes.near(min - skin, max + skin), body)
}

/// Whether a body may have reached a wall on its path through this substep: false only if, for each wall, its
/// boxes at both ends of the path lie on the same side of the wall. The outline at the end must be up to
/// date.
#[inline]
pub(crate) fn may_meet_wall(world: &World<'_>, body: usize, (from_min, from_max): Aabb) -> bool {
    let (to_min, to_max) = world.outlines.boxes[body];
    if world.walls[body] == 0 || from_min == to_min && from_max == to_max {
        return false;
    }
    // The boxes of walls include their skin.
    let room = time_of_impact::room(&world.model.shapes[body]) - SKIN;
    let min = from_min.min(to_min) - room;
    let max = from_max.max(to_max) + room;
    world.walls[body] & world.model.boxes.near(min, max) != 0
}

/// The walls whose box overlaps the region swept by a body's circle in this substep.
pub(crate) fn walls_swept(world: &World<'_>, body: usize) -> KeySet {
    let (start, angle, _) = world.starts[body];
    let motion = &world.motions[body];
    if start == motion.centre && angle == motion.angle {
        return 0;
    }
    let room = world.model.shapes[body].bounding_radius;
    let min = start.min(motion.centre) - room;
    let max = start.max(motion.centre) + room;
    wall_keys(world.model.boxes.near(min, max), body)
}

/// Margin of a body's box for the body's skin (u); that of discs lies inside.
const fn agent_skin(body: usize) -> f32 {
    if body < AGENT_COUNT { SKIN } else { 0.0 }
}
