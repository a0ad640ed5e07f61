//! Joints: ground friction, the spring of a grip that was there, and the weld of a new one.

use super::{
    ANGULAR_SLOP, DT, LINEAR_SLOP, PI,
    contact::{Solved, inverse},
    math::{normalised, spun},
};
use glam::Vec3;
use phase_model::{Vec2, physics::GROUND_FRICTION};

/// Frequency of a spring (rad/s): 100 Hz.
const FREQUENCY: f32 = 2.0 * PI * 100.0;
/// Its damping ratio.
const DAMPING: f32 = 0.5;

/// A joint with what it did in the substep before.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Joint {
    /// Friction between a body and the ground.
    Friction { body: usize, impulse: Vec2 },
    /// A spring between two origins, with its length at rest (u).
    Spring { bodies: (usize, usize), length: f32, impulse: f32 },
    /// A weld of the second body's origin to a place in the frame of the first, at a relative angle.
    Weld { bodies: (usize, usize), anchor: Vec2, angle: f32, impulse: Vec3 },
}

impl Joint {
    /// The bodies it joins; friction joins none.
    pub(super) const fn bodies(&self) -> Option<(usize, usize)> {
        match self {
            Self::Friction { .. } => None,
            Self::Spring { bodies, .. } | Self::Weld { bodies, .. } => Some(*bodies),
        }
    }

    /// Whether it acts on a body.
    pub(super) fn acts_on(&self, body: usize) -> bool {
        match self {
            Self::Friction { body: rubbed, .. } => *rubbed == body,
            Self::Spring { bodies, .. } | Self::Weld { bodies, .. } => bodies.0 == body || bodies.1 == body,
        }
    }
}

/// A joint while it is solved: the joint's own numbers, points of application, and effective masses.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solving {
    Friction(Friction),
    Spring(Spring),
    Weld(Weld),
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Friction {
    body: usize,
    arm: Vec2,
    mass: [f32; 3],
    inverse_mass: f32,
    inverse_inertia: f32,
    impulse: Vec2,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Spring {
    bodies: (usize, usize),
    arms: (Vec2, Vec2),
    direction: Vec2,
    mass: f32,
    softness: f32,
    bias: f32,
    impulse: f32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Weld {
    bodies: (usize, usize),
    anchor: Vec2,
    angle: f32,
    arms: (Vec2, Vec2),
    mass: [Vec3; 3],
    impulse: Vec3,
}

impl Solving {
    /// A joint that is not yet prepared.
    pub(super) const NONE: Self = Self::Friction(Friction {
        body: 0,
        arm: Vec2::ZERO,
        mass: [0.0; 3],
        inverse_mass: 0.0,
        inverse_inertia: 0.0,
        impulse: Vec2::ZERO,
    });

    /// Prepares a joint at the present poses, and applies the impulses with which the substep begins.
    pub(super) fn new(joint: &Joint, solved: &mut Solved, warmth: f32) -> Self {
        match *joint {
            Joint::Friction { body, impulse } => {
                Self::Friction(Friction::new(body, impulse * warmth, solved))
            }
            Joint::Spring { bodies, length, impulse } => {
                Self::Spring(Spring::new(bodies, length, impulse * warmth, solved))
            }
            Joint::Weld { bodies, anchor, angle, impulse } => {
                let mut weld = Weld {
                    bodies,
                    anchor,
                    angle,
                    arms: (Vec2::ZERO, Vec2::ZERO),
                    mass: [Vec3::ZERO; 3],
                    impulse: impulse * warmth,
                };
                weld.arms = weld.arms(solved);
                weld.mass = symmetric_inverse(response(&weld, weld.arms, solved));
                solved.apply(bodies, weld.arms, weld.impulse.truncate(), weld.impulse.z);
                Self::Weld(weld)
            }
        }
    }

    /// One iteration of the velocity solver. Returns whether it changed anything.
    pub(super) fn solve(&mut self, solved: &mut Solved) -> bool {
        match self {
            Self::Friction(friction) => {
                let body = friction.body;
                let mut velocity = solved.velocity[friction.body];
                let changed = friction.rub(&mut velocity, &mut solved.spin[body]);
                solved.velocity[body] = velocity;
                changed
            }
            Self::Spring(spring) => spring.solve(solved),
            Self::Weld(weld) => weld.solve(solved),
        }
    }

    /// One iteration of the position solver. Returns whether the error was negligible.
    pub(super) fn join(&self, solved: &mut Solved) -> bool {
        if let Self::Weld(weld) = self { weld.join(solved) } else { true }
    }

    /// Hands its impulse back to the joint.
    pub(super) fn store(&self, joint: &mut Joint) {
        match (self, joint) {
            (Self::Friction(friction), Joint::Friction { impulse, .. }) => *impulse = friction.impulse,
            (Self::Spring(spring), Joint::Spring { impulse, .. }) => *impulse = spring.impulse,
            (Self::Weld(weld), Joint::Weld { impulse, .. }) => *impulse = weld.impulse,
            _ => {}
        }
    }
}

impl Friction {
    /// Friction at the present pose, with the impulse with which the substep begins, which it applies.
    pub(super) fn new(body: usize, impulse: Vec2, solved: &mut Solved) -> Self {
        let arm = solved.rotation(body).turn(-solved.local_centre[body]);
        let m = solved.inverse_mass[body];
        let i = solved.inverse_inertia[body];
        let mass = inverse([m + i * arm.y * arm.y, -i * arm.x * arm.y, m + i * arm.x * arm.x]);
        solved.velocity[body] += m * impulse;
        solved.spin[body] += i * arm.perp_dot(impulse);
        Self { body, arm, mass, inverse_mass: m, inverse_inertia: i, impulse }
    }

    /// The impulse so far (N s).
    pub(super) const fn impulse(&self) -> Vec2 {
        self.impulse
    }

    /// One iteration. Returns whether it changed anything.
    #[inline(always)]
    pub(super) fn rub(&mut self, velocity: &mut Vec2, spin: &mut f32) -> bool {
        const MOST: f32 = DT * GROUND_FRICTION;
        let slip = *velocity + spun(*spin, self.arm);
        let [xx, xy, yy] = self.mass;
        let before = self.impulse;
        let mut impulse = before + -Vec2::new(xx * slip.x + xy * slip.y, xy * slip.x + yy * slip.y);
        if impulse.dot(impulse) > MOST * MOST {
            impulse = normalised(impulse).0 * MOST;
        }
        let change = impulse - before;
        self.impulse = impulse;
        *velocity += self.inverse_mass * change;
        *spin += self.inverse_inertia * self.arm.perp_dot(change);
        change != Vec2::ZERO
    }
}

impl Spring {
    fn new(bodies: (usize, usize), length: f32, impulse: f32, solved: &mut Solved) -> Self {
        let (a, b) = bodies;
        let mut arm = |body: usize| solved.rotation(body).turn(-solved.local_centre[body]);
        let arms = (arm(a), arm(b));
        let between = solved.centre[b] + arms.1 - solved.centre[a] - arms.0;
        let now = between.length();
        let direction = if now > LINEAR_SLOP { between * (1.0 / now) } else { Vec2::ZERO };
        let lever_a = arms.0.perp_dot(direction);
        let lever_b = arms.1.perp_dot(direction);
        let effect = solved.inverse_mass[a]
            + solved.inverse_inertia[a] * lever_a * lever_a
            + solved.inverse_mass[b]
            + solved.inverse_inertia[b] * lever_b * lever_b;
        let mass = 1.0 / effect;
        let damping = 2.0 * mass * DAMPING * FREQUENCY;
        let stiffness = mass * FREQUENCY * FREQUENCY;
        let softness = 1.0 / (DT * (damping + DT * stiffness));
        let spring = Self {
            bodies,
            arms,
            direction,
            mass: 1.0 / (effect + softness),
            softness,
            bias: (now - length) * DT * stiffness * softness,
            impulse,
        };
        solved.apply(bodies, arms, impulse * direction, 0.0);
        spring
    }

    fn solve(&mut self, solved: &mut Solved) -> bool {
        let (a, b) = self.bodies;
        let speed = |body: usize, arm: Vec2| solved.velocity[body] + spun(solved.spin[body], arm);
        let stretch = self.direction.dot(speed(b, self.arms.1) - speed(a, self.arms.0));
        let change = -self.mass * (stretch + self.bias + self.softness * self.impulse);
        self.impulse += change;
        solved.apply(self.bodies, self.arms, change * self.direction, 0.0);
        change != 0.0
    }
}

impl Weld {
    fn arms(&self, solved: &mut Solved) -> (Vec2, Vec2) {
        let (a, b) = self.bodies;
        let on_a = self.anchor - solved.local_centre[a];
        let on_b = -solved.local_centre[b];
        (solved.rotation(a).turn(on_a), solved.rotation(b).turn(on_b))
    }

    fn solve(&mut self, solved: &mut Solved) -> bool {
        let (a, b) = self.bodies;
        let slip = solved.slip(self.bodies, self.arms);
        let spin = solved.spin[b] - solved.spin[a];
        let [x, y, z] = self.mass;
        let change = -(slip.x * x + slip.y * y + spin * z);
        self.impulse += change;
        solved.apply(self.bodies, self.arms, change.truncate(), change.z);
        change != Vec3::ZERO
    }

    fn join(&self, solved: &mut Solved) -> bool {
        let (a, b) = self.bodies;
        let arms = self.arms(solved);
        let error = solved.centre[b] + arms.1 - solved.centre[a] - arms.0;
        let twist = solved.angle[b] - solved.angle[a] - self.angle;
        let matrix = response(self, arms, solved);
        let impulse = -solution(matrix, error.extend(twist));
        let push = impulse.truncate();
        solved.centre[a] -= solved.inverse_mass[a] * push;
        solved.angle[a] -= solved.inverse_inertia[a] * (arms.0.perp_dot(push) + impulse.z);
        solved.centre[b] += solved.inverse_mass[b] * push;
        solved.angle[b] += solved.inverse_inertia[b] * (arms.1.perp_dot(push) + impulse.z);
        error.length() <= LINEAR_SLOP && twist.abs() <= ANGULAR_SLOP
    }
}

/// Effect of a weld's impulses on its speeds: the columns of a symmetric matrix.
fn response(weld: &Weld, (a, b): (Vec2, Vec2), solved: &Solved) -> [Vec3; 3] {
    let (first, second) = weld.bodies;
    let mass = solved.inverse_mass[first] + solved.inverse_mass[second];
    let i = solved.inverse_inertia[first];
    let j = solved.inverse_inertia[second];
    let xx = mass + a.y * a.y * i + b.y * b.y * j;
    let xy = -a.y * a.x * i - b.y * b.x * j;
    let xz = -a.y * i - b.y * j;
    let yy = mass + a.x * a.x * i + b.x * b.x * j;
    let yz = a.x * i + b.x * j;
    [Vec3::new(xx, xy, xz), Vec3::new(xy, yy, yz), Vec3::new(xz, yz, i + j)]
}

fn reciprocal(determinant: f32) -> f32 {
    if determinant == 0.0 { 0.0 } else { 1.0 / determinant }
}

fn symmetric_inverse([x, y, z]: [Vec3; 3]) -> [Vec3; 3] {
    let scale = reciprocal(x.dot(y.cross(z)));
    let xx = x.x;
    let xy = y.x;
    let xz = z.x;
    let yy = y.y;
    let yz = z.y;
    let zz = z.z;
    let a = Vec3::new(scale * (yy * zz - yz * yz), scale * (xz * yz - xy * zz), scale * (xy * yz - xz * yy));
    let b = Vec3::new(a.y, scale * (xx * zz - xz * xz), scale * (xz * xy - xx * yz));
    [a, b, Vec3::new(a.z, b.z, scale * (xx * yy - xy * xy))]
}

fn solution([x, y, z]: [Vec3; 3], wanted: Vec3) -> Vec3 {
    let scale = reciprocal(x.dot(y.cross(z)));
    Vec3::new(scale * wanted.dot(y.cross(z)), scale * x.dot(wanted.cross(z)), scale * x.dot(y.cross(wanted)))
}
