//! Impacts on walls within a substep.

use super::{
    DT, WALLS,
    contact::Contact,
    distance::Corners,
    impact::{Moving, time_of_impact},
    math::Sweep,
    shape::Shape,
    world::World,
};

/// Most impacts on one wall that a substep resolves.
const MAX_IMPACTS: u32 = 8;

impl World {
    /// Resolves the impacts of bodies on walls in this substep, in the order of time.
    pub(super) fn solve_impacts(&mut self) {
        for sweep in &mut self.sweeps {
            sweep.start = 0.0;
        }
        for contact in &mut self.contacts {
            (contact.impacts, contact.impact) = (0, None);
        }
        while let Some((time, index)) = self.next_impact() {
            let body = self.contacts[index].bodies.1;
            let backup = [self.sweeps[WALLS], self.sweeps[body]];
            for body in [WALLS, body] {
                self.sweeps[body].advance(time);
                self.put(body, self.sweeps[body].from, self.sweeps[body].from_angle);
            }
            self.update_at(index);
            let contact = &mut self.contacts[index];
            contact.impact = None;
            contact.impacts += 1;
            if !contact.is_touching() {
                contact.enabled = false;
                for (body, sweep) in [WALLS, body].into_iter().zip(backup) {
                    self.sweeps[body] = sweep;
                    self.put(body, sweep.to, sweep.to_angle);
                }
                continue;
            }
            let mut touching = vec![index];
            for other in (0..self.contacts.len()).rev() {
                if other != index && self.contacts[other].bodies == (WALLS, body) {
                    self.update_at(other);
                    if self.contacts[other].is_touching() {
                        touching.push(other);
                    }
                }
            }
            self.solve_impact(body, &touching, (1.0 - time) * DT);
            self.refit(body);
            for contact in &mut self.contacts {
                if contact.bodies.0 == body || contact.bodies.1 == body {
                    contact.impact = None;
                }
            }
            self.find_new_contacts();
        }
    }

    /// The first impact still to come: when, and which contact.
    fn next_impact(&mut self) -> Option<(f32, usize)> {
        let mut first: Option<(f32, usize)> = None;
        for index in (0..self.contacts.len()).rev() {
            let contact = self.contacts[index];
            if !contact.enabled
                || contact.impacts > MAX_IMPACTS
                || contact.bodies.0 != WALLS
                || self.asleep[contact.bodies.1]
            {
                continue;
            }
            let time = if let Some(time) = contact.impact { time } else { self.impact(&contact) };
            self.contacts[index].impact = Some(time);
            if time < first.map_or(1.0, |(earliest, _)| earliest) {
                first = Some((time, index));
            }
        }
        first.filter(|&(time, _)| 1.0 - 10.0 * f32::EPSILON >= time)
    }

    /// The time of a body's impact on a wall in the remainder of this substep; 1 without one.
    fn impact(&mut self, contact: &Contact) -> f32 {
        let (a, b) = contact.bodies;
        let start = self.sweeps[a].start.max(self.sweeps[b].start);
        for body in [a, b] {
            if self.sweeps[body].start < start {
                self.sweeps[body].advance(start);
            }
        }
        let shape_a = self.shape(contact.shapes.0);
        let shape_b = self.shape(contact.shapes.1);
        if self.is_far(contact.shapes.0, b) {
            return 1.0;
        }
        let corners = |shape: &Shape| {
            let (corners, count) = shape.corners();
            Corners { corners, count }
        };
        let corners_a = corners(shape_a);
        let corners_b = corners(shape_b);
        let time = time_of_impact(
            &Moving { corners: &corners_a, radius: shape_a.radius, sweep: self.sweeps[a] },
            &Moving { corners: &corners_b, radius: shape_b.radius, sweep: self.sweeps[b] },
        );
        time.map_or(1.0, |share| (start + (1.0 - start) * share).min(1.0))
    }

    /// Whether a body keeps clear of a wall in this substep, whichever way it turns.
    fn is_far(&self, wall: usize, body: usize) -> bool {
        const LEEWAY: f32 = 0.05;
        let Sweep { from, to, .. } = self.sweeps[body];
        let reach = self.scenery.shapes[body].reach + LEEWAY;
        let (min, max) = self.scenery.bounds[wall];
        (from.min(to) - reach).cmpgt(max).any() || min.cmpgt(from.max(to) + reach).any()
    }
}
