//! Conservative reachability tests in each lane; see [`crate::reach`].

use super::{
    outline::{Boxes, WallLanes, walls_near},
    real::{LaneSet, Real, Vector, differ, lanes, larger, less, mask, pick, splat},
    worlds::Worlds,
};
use crate::{
    constants::SKIN,
    key::PAIRS,
    reach::{CORRECTION_MARGIN, DISPLACEMENT_PER_ACCELERATION, MARGIN, STEP},
    time_of_impact,
    wall::MAX_WALLS,
};
use phase_model::{AGENT_COUNT, Vec2};

/// For each body, a set of lanes.
pub(crate) type BodyLanes = [LaneSet; 4];

/// The union over all bodies.
pub(crate) fn any_body(bodies: &BodyLanes) -> LaneSet {
    bodies.iter().fold(0, |all, set| all | set)
}

/// For each body, the lanes in which it may touch or hold anything in the coming step, whatever happens. Records which walls
/// each of them can reach.
pub(crate) fn reachable_bodies(worlds: &mut Worlds<'_>) -> BodyLanes {
    let (model, used) = (worlds.model, worlds.used);
    let mut reachable = [0; 4];
    for body in 0..model.count {
        let (motion, shape) = (&worlds.motions[body], &model.shapes[body]);
        let mut sweep = motion.velocity.length() * splat(STEP);
        if body < AGENT_COUNT {
            let act = &worlds.acts[body];
            let pushed = act.max_force * splat(shape.inverse_mass) * splat(DISPLACEMENT_PER_ACCELERATION);
            sweep = pick(act.pushes, sweep + pushed, sweep);
        }
        worlds.max_displacements[body] = sweep;
        let room = splat(shape.bounding_radius) + sweep + splat(MARGIN);
        worlds.walls[body] = walls_near(model, &[used; MAX_WALLS], around(motion.centre, room));
        reachable[body] = worlds.walls[body].iter().fold(0, |all, set| all | set);
    }
    let mut grouped = [0; 4];
    let mut joint_error = Real::ZERO;
    for agent in 0..AGENT_COUNT {
        if let Some(held) = worlds.held[agent] {
            grouped[agent] = used;
            grouped[held] = used;
            joint_error += worlds.joint_error(agent, held);
        }
    }
    let longest = worlds.max_displacements;
    let reaches = |a: usize, b: usize, sweep: Real| -> LaneSet {
        let reach =
            splat(model.shapes[a].bounding_radius + model.shapes[b].bounding_radius) + sweep + splat(MARGIN);
        let distance = worlds.motions[a].centre.distance_squared(worlds.motions[b].centre);
        lanes(less(distance, reach * reach))
    };
    for (a, b) in PAIRS {
        if b < model.count {
            let both = reaches(a, b, longest[a] + longest[b]) & used;
            grouped[a] |= both;
            grouped[b] |= both;
        }
    }
    if any_body(&grouped) == 0 {
        return reachable;
    }
    // Bodies that collide may go anywhere that the sum of their speeds could take them.
    let mut together;
    loop {
        let before = grouped;
        let mut sum = Real::ZERO;
        for body in 0..model.count {
            sum = pick(mask(grouped[body]), sum + longest[body], sum);
        }
        together = splat(2.0) * sum + joint_error + splat(CORRECTION_MARGIN);
        for (a, b) in PAIRS {
            let one = grouped[a] ^ grouped[b];
            if one != 0 && b < model.count {
                let other = pick(mask(grouped[a]), longest[b], longest[a]);
                let both = one & reaches(a, b, together + other);
                grouped[a] |= both;
                grouped[b] |= both;
            }
        }
        if grouped == before {
            break;
        }
    }
    for body in 0..model.count {
        if grouped[body] != 0 {
            let room = splat(model.shapes[body].bounding_radius) + together;
            let around = around(worlds.motions[body].centre, room);
            let near = walls_near(model, &[grouped[body]; MAX_WALLS], around);
            for (walls, near) in worlds.walls[body].iter_mut().zip(near) {
                *walls = *walls & !grouped[body] | near;
            }
            reachable[body] |= grouped[body];
        }
    }
    reachable
}

/// The box around a circle.
fn around(point: Vector, room: Real) -> Boxes {
    let room = Vector { x: room, y: room };
    (point - room, point + room)
}

/// For each body of a set, the lanes in which the coming substep can change it, and for each pair of bodies those in which it
/// may touch, except those that are kept apart.
pub(crate) fn active_set(
    worlds: &mut Worlds<'_>,
    reachable: &BodyLanes,
    excluded: &[LaneSet; PAIRS.len()],
) -> (BodyLanes, [LaneSet; PAIRS.len()]) {
    let mut pairs = worlds.pairs_near(reachable);
    for (near, excluded) in pairs.iter_mut().zip(excluded) {
        *near &= !excluded;
    }
    let active = active(worlds, reachable, &pairs);
    for body in 0..worlds.model.count {
        worlds.outline(body, active[body]);
    }
    // Where nothing can change, nothing is looked for.
    let changing = any_body(&active);
    for near in &mut pairs {
        *near &= changing;
    }
    (active, pairs)
}

/// The bodies that the coming substep may change: all but sleeping bodies without an active neighbour. Neighbours of active
/// bodies are woken.
fn active(worlds: &mut Worlds<'_>, reachable: &BodyLanes, pairs: &[LaneSet; PAIRS.len()]) -> BodyLanes {
    let mut active = *reachable;
    for (active, sleeping) in active.iter_mut().zip(&worlds.sleeping) {
        *active &= !sleeping;
    }
    if active == *reachable {
        return active;
    }
    loop {
        let before = active;
        let mut wake = |a: usize, b: usize, near: LaneSet| {
            let woken = (active[a] | active[b]) & near;
            active[a] |= woken;
            active[b] |= woken;
        };
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            wake(a, b, pairs[pair]);
        }
        for agent in 0..AGENT_COUNT {
            if let Some(held) = worlds.held[agent] {
                wake(agent, held, !0);
            }
        }
        if active == before {
            break;
        }
    }
    for (sleeping, active) in worlds.sleeping.iter_mut().zip(&active) {
        *sleeping &= !active;
    }
    active
}

/// The walls reachable in this step whose box overlaps a body's box now, in each of the given lanes. Its outline must be up to
/// date.
#[inline]
pub(crate) fn walls_touched(worlds: &Worlds<'_>, body: usize, set: LaneSet) -> WallLanes {
    let (min, max) = worlds.outlines.boxes[body];
    let skin = Vector::splat(Vec2::splat(if body < AGENT_COUNT { SKIN } else { 0.0 }));
    walls_near(worlds.model, &worlds.walls[body].map(|walls| walls & set), (min - skin, max + skin))
}

/// The lanes among the given ones in which a body may have reached a wall on its path through this substep.
#[inline]
pub(crate) fn may_meet_wall(
    worlds: &Worlds<'_>,
    body: usize,
    set: LaneSet,
    (from_min, from_max): Boxes,
) -> LaneSet {
    let (to_min, to_max) = worlds.outlines.boxes[body];
    let moved = differ(from_min.x, to_min.x)
        | differ(from_min.y, to_min.y)
        | differ(from_max.x, to_max.x)
        | differ(from_max.y, to_max.y);
    let set = set & lanes(moved);
    if set == 0 {
        return 0;
    }
    // The boxes of walls include their skin.
    let room = time_of_impact::room(&worlds.model.shapes[body]) - SKIN;
    let room = Vector::splat(Vec2::splat(room));
    let (min, max) = (from_min.smaller(to_min) - room, from_max.larger(to_max) + room);
    let near = walls_near(worlds.model, &worlds.walls[body].map(|walls| walls & set), (min, max));
    near.iter().fold(0, |all, set| all | set)
}

/// The walls whose box overlaps the region swept by a body's circle in this substep, in each of the given lanes.
pub(crate) fn walls_swept(worlds: &Worlds<'_>, body: usize, set: LaneSet) -> WallLanes {
    let (start, motion) = (&worlds.starts[body], &worlds.motions[body]);
    let moved = differ(start.centre.x, motion.centre.x)
        | differ(start.centre.y, motion.centre.y)
        | differ(start.angle, motion.angle);
    let room = Vector::splat(Vec2::splat(worlds.model.shapes[body].bounding_radius));
    let min = start.centre.smaller(motion.centre) - room;
    let max = start.centre.larger(motion.centre) + room;
    walls_near(worlds.model, &[set & lanes(moved); MAX_WALLS], (min, max))
}

/// The lanes in which bodies of different rigid groups may collide in the coming step.
pub(crate) fn groups_may_collide(worlds: &Worlds<'_>, names: &[usize; 5]) -> LaneSet {
    let model = worlds.model;
    if !model.collisions {
        return 0;
    }
    let sweep = |body: usize| {
        (0..4)
            .filter(|&member| names[member] == names[body])
            .fold(Real::ZERO, |most, member| larger(most, worlds.max_displacements[member]))
    };
    let mut may = 0;
    for (a, b) in PAIRS {
        if names[a] != names[b] && b < model.count {
            let reach = model.shapes[a].bounding_radius + model.shapes[b].bounding_radius + MARGIN;
            let reach = splat(reach) + sweep(a) + sweep(b);
            let distance = worlds.motions[a].centre.distance_squared(worlds.motions[b].centre);
            may |= lanes(less(distance, reach * reach));
        }
    }
    may & worlds.used
}

impl Worlds<'_> {
    /// Distance between a held object and where its agent holds it (u).
    fn joint_error(&self, agent: usize, held: usize) -> Real {
        let (shape, holder) = (&self.model.shapes[agent], &self.motions[agent]);
        let reach = self.grip_direction(agent) * splat(shape.radius + self.model.shapes[held].radius);
        let place = holder.place(reach + Vector::splat(Vec2::new(0.0, shape.origin)));
        (place - self.motions[held].centre).length()
    }

    /// The side that holds, as a direction in the agent's frame.
    pub(crate) fn grip_direction(&self, agent: usize) -> Vector {
        let mut direction = Vector::ZERO;
        for (lane, grips) in self.grips.iter().enumerate() {
            if let Some(grip) = grips[agent] {
                direction.set(lane, grip.side.direction());
            }
        }
        direction
    }
}
