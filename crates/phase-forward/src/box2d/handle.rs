//! Joints, forces and stops, with which a step begins.

use super::{
    WALLS,
    joint::Joint,
    world::{World, bit_of},
};
use phase_model::Vec2;

impl World {
    /// Adds a joint. The bodies it joins no longer collide with each other.
    pub(crate) fn join(&mut self, joint: Joint) {
        if let Some(bodies) = joint.bodies() {
            let walls = self.scenery.walls.len();
            let known = self.contacts.iter().position(|contact| contact.bodies == bodies);
            if known.is_some_and(|known| self.contacts.remove(known).is_touching()) {
                self.wake(bodies);
            }
            self.known &= !bit_of(walls + bodies.0, bodies);
        }
        self.joints.push(joint);
    }

    /// Removes the joint of two bodies.
    pub(crate) fn part(&mut self, bodies: (usize, usize)) {
        self.joints.retain(|joint| joint.bodies() != Some(bodies));
        self.wake(bodies);
    }

    /// Wakes two bodies, but not walls.
    pub(super) fn wake(&mut self, (a, b): (usize, usize)) {
        for body in [a, b].into_iter().filter(|&body| body != WALLS) {
            if core::mem::take(&mut self.asleep[body]) {
                self.rest[body] = 0.0;
            }
        }
    }

    /// Pushes a body at a place (u) with a force (N), both in its own frame, in the coming substep.
    pub(crate) fn push(&mut self, body: usize, at: Vec2, force: Vec2) {
        self.wake((body, WALLS));
        let force = self.poses[body].rotation.turn(force);
        self.forces[body] += force;
        self.torques[body] += (self.poses[body].apply(at) - self.sweeps[body].to).perp_dot(force);
    }

    /// Turns a body in the coming substep (N u).
    pub(crate) fn turn(&mut self, body: usize, torque: f32) {
        if torque != 0.0 {
            self.wake((body, WALLS));
        }
        self.torques[body] += torque;
    }

    /// Ends the turning of a body.
    pub(crate) fn stop_turning(&mut self, body: usize) {
        self.bodies.spin[body] = 0.0;
    }

    /// Stops a body, which goes on turning.
    pub(crate) fn stop(&mut self, body: usize) {
        self.bodies.velocity[body] = Vec2::ZERO;
    }

    /// Puts a body whose origin has left a rectangle back into it, at rest.
    pub(crate) fn keep_within(&mut self, body: usize, min: Vec2, max: Vec2) {
        let place = self.poses[body].place;
        let inside = place.clamp(min, max);
        if inside != place {
            self.put(body, self.bodies.centre[body] + (inside - place), self.bodies.angle[body]);
            self.stop(body);
        }
    }
}
