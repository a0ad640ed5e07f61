//! Impacts on walls within a substep: stop at the wall, lose the normal velocity, continue for the remaining
//! time.

use crate::{
    body::STATIC,
    constants::{
        IMPACT_BAUMGARTE, IMPACT_POSITION_ITERATIONS, IMPULSE_TOLERANCE, LINEAR_SLOP, MAX_IMPACTS,
        VELOCITY_ITERATIONS,
    },
    contact::Contact,
    key::{KeySet, bit, descending, wall_key},
    polygon::Polygon,
    time_of_impact::{Sweep, SweepEnds, time_of_impact},
    wall::MAX_WALLS,
    world::World,
};
use phase_model::Vec2;

/// Maximum number of walls that one impact takes into account.
const MAX_SIMULTANEOUS_WALLS: usize = 8;

impl World<'_> {
    /// Resolves the impacts of one body on the candidate walls. Returns whether there were any, with the
    /// body's centre at the last of them.
    pub(crate) fn impacts(&mut self, body: usize, candidates: KeySet) -> Option<Vec2> {
        let (start, start_angle, right) = self.starts[body];
        let shape = &self.model.shapes[body];
        let mut sweep = Sweep {
            from: start,
            to: self.motions[body].centre,
            from_angle: start_angle,
            to_angle: self.motions[body].angle,
            right,
        };
        let ends = SweepEnds::new(shape, &sweep);
        if descending(candidates).all(|key| ends.clear_of(&self.model.walls[key / 4])) {
            return None;
        }
        let mut spent = 0.0_f32;
        let mut met = [0_u8; MAX_WALLS];
        let mut off: KeySet = 0;
        let mut last = None;
        loop {
            let mut first: Option<(f32, usize)> = None;
            for wall in (0..self.model.wall_count).rev() {
                let key = bit(wall_key(wall, body));
                if candidates & key == 0 || off & key != 0 || met[wall] > MAX_IMPACTS {
                    continue;
                }
                if last.is_none() && ends.clear_of(&self.model.walls[wall]) {
                    continue;
                }
                if let Some(share) = time_of_impact(shape, &sweep, &self.model.walls[wall]) {
                    let time = (spent + (1.0 - spent) * share).min(1.0);
                    if first.is_none_or(|(earliest, _)| time < earliest) {
                        first = Some((time, wall));
                    }
                }
            }
            let Some((time, wall)) = first.filter(|(time, _)| *time <= 1.0 - 10.0 * f32::EPSILON) else {
                return last;
            };
            let way_before = sweep;
            let motion_before = self.motions[body];
            sweep.skip((time - spent) / (1.0 - spent));
            self.put(body, &sweep);
            met[wall] += 1;
            let polygon = Polygon::new(shape, &self.motions[body]);
            let polygons = [polygon; 2];
            let key = wall_key(wall, body);
            let (bodies, manifold) = self.collide(key, &polygons);
            if manifold.count == 0 {
                off |= bit(key);
                sweep = way_before;
                self.motions[body] = motion_before;
                continue;
            }
            spent = time;
            let mut contacts = [Contact::new(key as u8, bodies, manifold); MAX_SIMULTANEOUS_WALLS];
            let mut count = 1;
            for other in (0..self.model.wall_count).rev() {
                let key = wall_key(other, body);
                if other == wall || candidates & bit(key) == 0 || count == MAX_SIMULTANEOUS_WALLS {
                    continue;
                }
                off &= !bit(key);
                let (bodies, manifold) = self.collide(key, &polygons);
                if manifold.count > 0 {
                    contacts[count] = Contact::new(key as u8, bodies, manifold);
                    count += 1;
                }
            }
            self.bounce(body, &mut contacts[..count], spent, &mut sweep);
            last = Some(sweep.from);
        }
    }

    /// Separates a body from walls it has just reached, removes its velocity into them, and moves it on.
    fn bounce(&mut self, body: usize, contacts: &mut [Contact], spent: f32, sweep: &mut Sweep) {
        let shapes = &self.model.shapes;
        let shape = &shapes[body];
        let motion = &mut self.motions[body];
        for contact in contacts.iter_mut() {
            debug_assert!(contact.a == STATIC && contact.b == body);
            contact.prepare_alone(shapes, motion);
        }
        for _ in 0..IMPACT_POSITION_ITERATIONS {
            let mut settled = true;
            for contact in contacts.iter() {
                settled &= contact.separate_alone(shape, motion, IMPACT_BAUMGARTE) >= -1.5 * LINEAR_SLOP;
            }
            if settled {
                break;
            }
        }
        sweep.from = motion.centre;
        sweep.from_angle = motion.angle;
        sweep.right = motion.right;
        for contact in contacts.iter_mut() {
            contact.prepare_alone(shapes, motion);
        }
        let mut twist = motion.twist();
        for _ in 0..VELOCITY_ITERATIONS {
            let change =
                contacts.iter_mut().map(|contact| contact.solve_alone(shape, &mut twist)).fold(0.0, f32::max);
            if change < IMPULSE_TOLERANCE {
                break;
            }
        }
        motion.set_twist(twist);
        motion.advance(shape, (1.0 - spent) * self.seconds);
        sweep.to = motion.centre;
        sweep.to_angle = motion.angle;
        self.moved(body);
    }

    /// Sets a body's pose to the start of a path.
    fn put(&mut self, body: usize, sweep: &Sweep) {
        let motion = &mut self.motions[body];
        motion.centre = sweep.from;
        motion.angle = sweep.from_angle;
        motion.right = sweep.right;
    }
}
