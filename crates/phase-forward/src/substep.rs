//! One substep of 1/60 s: find contacts, solve velocities, move, solve positions.

use crate::{
    body::{STATIC, Twist},
    contact::Contact,
    key::{KeySet, PAIRS, bit, descending, pair_key},
    manifold::{self, Manifold, Polygon},
    tuning::{CORRECTION, H, POSITION_ITERATIONS, SETTLED_IMPULSE, SLOP},
    wall::MAX_WALLS,
    weld::Weld,
    world::{MAX_CONTACTS, Touching, World},
};
use phase_model::AGENT_COUNT;

/// A set of bodies, one bit each.
pub(crate) type BodySet = u8;

/// A joint: ground friction of one of four bodies (0 to 3), or the weld of an agent (4 and 5).
type Joint = u8;

impl World<'_> {
    /// Finds which of the pairs of shapes in a set touch, newest first.
    pub(crate) fn find_contacts(&self, candidates: KeySet, touching: &mut Touching) {
        touching.count = 0;
        if candidates == 0 {
            return;
        }
        let polygons = self.polygons(candidates);
        for key in descending(candidates) {
            let (bodies, manifold) = self.collide(key, &polygons);
            if manifold.count > 0 {
                touching.add(Contact::new(key as u8, bodies, manifold));
            }
        }
    }

    /// Applies forces and solves all given bodies, group by group.
    pub(crate) fn solve(&mut self, members: BodySet, touching: &mut Touching) {
        let mut welds: [Option<Weld>; AGENT_COUNT] = [None; AGENT_COUNT];
        let mut linked: BodySet = 0;
        for (agent, weld) in welds.iter_mut().enumerate() {
            if let (Some(grip), Some(held)) = (&self.grips[agent], self.held(agent)) {
                linked |= 1 << agent | 1 << held;
                *weld = Some(Weld::new(agent, grip, &self.forward.shapes, self.impulses.welds[agent]));
            }
        }
        for contact in touching.found() {
            linked |= 1 << contact.b | (1 << contact.a & 0xf);
        }
        for body in 0..self.forward.count {
            if members & 1 << body == 0 {
                continue;
            }
            let (shape, motion) = (&self.forward.shapes[body], &mut self.motions[body]);
            self.starts[body] = (motion.centre, motion.angle, motion.right);
            if body < AGENT_COUNT {
                motion.act(shape, self.actions[body]);
            }
            if linked & 1 << body == 0 {
                self.impulses.ground[body] = motion.slide(shape);
            }
        }
        let mut done = !(members & linked);
        for seed in (0..self.forward.count).rev() {
            if done & 1 << seed == 0 {
                let island = self.island(seed, touching.found(), &welds, &mut done);
                self.solve_island(&island, &mut touching.contacts, &mut welds);
            }
        }
        for (impulse, weld) in self.impulses.welds.iter_mut().zip(&welds) {
            if let Some(weld) = weld {
                *impulse = weld.impulse;
            }
        }
        touching.keep();
    }

    /// The outlines of those agents whose outlines matter to some pairs of shapes.
    fn polygons(&self, candidates: KeySet) -> [Polygon; AGENT_COUNT] {
        /// Keys of all walls and body 0.
        const WALLS: KeySet = 0x1111_1111_1111_1111 & (bit(pair_key(0)) - 1);
        let both = bit(pair_key(0));
        let outline = |agent: usize| {
            if candidates & (WALLS << agent | both) == 0 {
                return Polygon::NONE;
            }
            Polygon::new(&self.forward.shapes[agent], &self.motions[agent])
        };
        [outline(0), outline(1)]
    }

    /// The contact of a pair of shapes.
    pub(crate) fn collide(&self, key: usize, polygons: &[Polygon; 2]) -> ((usize, usize), Manifold) {
        let (motions, shapes) = (&self.motions, &self.forward.shapes);
        if key < pair_key(0) {
            let (wall, body) = (&self.forward.walls[key / 4], key % 4);
            let manifold = if body < AGENT_COUNT {
                manifold::wall_agent(wall, &motions[body], &polygons[body])
            } else {
                manifold::wall_disc(wall, &motions[body], shapes[STATIC].skin + shapes[body].skin)
            };
            return ((STATIC, body), manifold);
        }
        let (a, b) = PAIRS[key - 4 * MAX_WALLS];
        let skins = shapes[a].skin + shapes[b].skin;
        let manifold = if b < AGENT_COUNT {
            manifold::agents((&motions[a], &polygons[a]), (&motions[b], &polygons[b]))
        } else if a < AGENT_COUNT {
            manifold::agent_disc(&shapes[a], &motions[a], &motions[b], skins)
        } else {
            manifold::discs(&motions[a], &motions[b], skins)
        };
        ((a, b), manifold)
    }

    /// Everything that hangs together with a body by contacts and grips, in the order of solution.
    fn island(
        &self,
        seed: usize,
        contacts: &[Contact],
        welds: &[Option<Weld>; AGENT_COUNT],
        done: &mut BodySet,
    ) -> Island {
        let mut island = Island::EMPTY;
        let mut taken = 0_u32;
        let mut joined: u8 = 0;
        let (mut stack, mut height) = ([seed; 4], 1);
        *done |= 1 << seed;
        while height > 0 {
            height -= 1;
            let body = stack[height];
            island.bodies[island.body_count] = body as u8;
            island.body_count += 1;
            let mut reach = |other: usize| {
                if other != STATIC && *done & 1 << other == 0 {
                    *done |= 1 << other;
                    stack[height] = other;
                    height += 1;
                }
            };
            for (index, contact) in contacts.iter().enumerate() {
                if taken & 1 << index == 0 && (contact.a == body || contact.b == body) {
                    taken |= 1 << index;
                    island.contacts[island.contact_count] = index as u8;
                    island.contact_count += 1;
                    reach(if contact.a == body { contact.b } else { contact.a });
                }
            }
            let mut join = |joint: Joint| {
                if joined & 1 << joint == 0 {
                    joined |= 1 << joint;
                    island.joints[island.joint_count] = joint;
                    island.joint_count += 1;
                }
            };
            for agent in [self.latest_grip, 1 - self.latest_grip] {
                if let Some(weld) = &welds[agent] {
                    if weld.agent == body {
                        join(4 + agent as u8);
                        reach(weld.object);
                    } else if weld.object == body {
                        join(4 + agent as u8);
                        reach(weld.agent);
                    }
                }
            }
            join(body as u8);
        }
        island
    }

    fn solve_island(
        &mut self,
        island: &Island,
        all: &mut [Contact; MAX_CONTACTS],
        welds: &mut [Option<Weld>; AGENT_COUNT],
    ) {
        let shapes = &self.forward.shapes;
        let motions = &mut self.motions;
        let bodies = &island.bodies[..island.body_count];
        let joints = &island.joints[..island.joint_count];
        let contacts = &island.contacts[..island.contact_count];
        let [a, b, c, d, _] = motions;
        let mut twists = [a.twist(), b.twist(), c.twist(), d.twist(), Twist::ZERO];
        for &index in contacts {
            all[usize::from(index)].prepare(shapes, motions);
        }
        for &index in contacts {
            all[usize::from(index)].warm_start(shapes, &mut twists);
        }
        for &joint in joints {
            let joint = usize::from(joint);
            if joint < 4 {
                twists[joint].rub_by(&shapes[joint], motions[joint].right, self.impulses.ground[joint]);
            } else if let Some(weld) = &mut welds[joint - 4] {
                weld.prepare(shapes, motions, &mut twists);
            }
        }
        for _ in 0..self.iterations {
            let mut change = 0.0_f32;
            for &joint in joints {
                let joint = usize::from(joint);
                if joint < 4 {
                    let before = self.impulses.ground[joint];
                    let after = twists[joint].rub(&shapes[joint], motions[joint].right, before);
                    self.impulses.ground[joint] = after;
                    change = change.max((after - before).abs().max_element());
                } else if let Some(weld) = &mut welds[joint - 4] {
                    change = change.max(weld.solve(shapes, &mut twists));
                }
            }
            for &index in contacts {
                change = change.max(all[usize::from(index)].solve(shapes, &mut twists));
            }
            if change < SETTLED_IMPULSE {
                break;
            }
        }
        for &body in bodies {
            let body = usize::from(body);
            motions[body].set_twist(twists[body]);
        }
        for &body in bodies {
            let body = usize::from(body);
            motions[body].advance(&shapes[body], H);
        }
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = true;
            for &index in contacts {
                let gap = all[usize::from(index)].separate(shapes, motions, CORRECTION);
                settled &= gap >= -3.0 * SLOP;
            }
            for &joint in joints {
                if let Some(weld) = usize::from(joint).checked_sub(4).and_then(|agent| welds[agent].as_ref())
                {
                    settled &= weld.join(shapes, motions);
                }
            }
            if settled {
                break;
            }
        }
    }

    /// The pairs of bodies that touch as they are now, among the given keys.
    pub(crate) fn touching(&self, candidates: KeySet) -> KeySet {
        let pairs = candidates >> pair_key(0) << pair_key(0);
        if pairs == 0 {
            return 0;
        }
        let polygons = self.polygons(pairs);
        descending(pairs)
            .filter(|&key| self.collide(key, &polygons).1.count > 0)
            .fold(0, |set, key| set | bit(key))
    }
}

/// Bodies that hang together, with what holds them.
struct Island {
    bodies: [u8; 4],
    body_count: usize,
    contacts: [u8; MAX_CONTACTS],
    contact_count: usize,
    joints: [Joint; 6],
    joint_count: usize,
}

impl Island {
    const EMPTY: Self = Self {
        bodies: [0; 4],
        body_count: 0,
        contacts: [0; MAX_CONTACTS],
        contact_count: 0,
        joints: [0; 6],
        joint_count: 0,
    };
}
