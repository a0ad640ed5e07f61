//! A world of bodies, joints and contacts.

use super::{
    BODIES, MAX_JOINTS, WALLS, WALLS_AT,
    contact::{Constraint, Contact, Solved},
    joint::{Joint, Solving},
    math::{Rotation, Sweep, Transform},
    shape::Shape,
};
use phase_model::Vec2;
use std::sync::Arc;

/// Margin around the boxes of shapes (u).
const MARGIN: f32 = 0.1;

/// Pose and velocity of a body: of its origin the place, of its centre of mass the velocity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyState {
    pub(crate) place: Vec2,
    pub(crate) angle: f32,
    pub(crate) velocity: Vec2,
    pub(crate) spin: f32,
}

impl BodyState {
    /// At rest at the origin.
    pub(crate) const STILL: Self = Self { place: Vec2::ZERO, angle: 0.0, velocity: Vec2::ZERO, spin: 0.0 };
}

/// The shapes of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Scenery {
    pub(super) walls: Vec<Shape>,
    /// Boxes of the walls, without and with margins.
    pub(super) bounds: Vec<(Vec2, Vec2)>,
    boxes: Vec<(Vec2, Vec2)>,
    /// Those of the bodies, at most four.
    pub(super) shapes: Vec<Shape>,
    /// Whether bodies collide with each other, and not with walls alone.
    pub(crate) collisions: bool,
    /// The bodies at rest at the origin.
    still: Solved,
}

impl Scenery {
    /// Walls, and the shapes of bodies.
    pub(crate) fn new(walls: Vec<Shape>, shapes: Vec<Shape>) -> Self {
        let bounds: Vec<(Vec2, Vec2)> = walls.iter().map(|wall| wall.bounds(&AT_WALLS)).collect();
        let boxes = bounds.iter().copied().map(with_margin).collect();
        let of = |value: fn(&Shape) -> f32| core::array::from_fn(|body| shapes.get(body).map_or(0.0, value));
        let still = Solved {
            inverse_mass: of(|shape| shape.inverse_mass),
            inverse_inertia: of(|shape| shape.inverse_inertia),
            local_centre: core::array::from_fn(|body| {
                shapes.get(body).map_or(Vec2::ZERO, |shape| shape.local_centre)
            }),
            centre: [WALLS_AT; BODIES],
            angle: [0.0; BODIES],
            velocity: [Vec2::ZERO; BODIES],
            spin: [0.0; BODIES],
            rotations: [(0.0, AT_WALLS.rotation); BODIES],
        };
        Self { walls, bounds, boxes, shapes, collisions: true, still }
    }

    /// Number of bodies that move.
    pub(crate) fn count(&self) -> usize {
        self.shapes.len()
    }
}

/// The bit of a pair of shapes: of a wall by its number and a body, or of two bodies.
pub(super) const fn bit_of(first: usize, (a, b): (usize, usize)) -> u64 {
    if a == WALLS { 1 << (WALLS * first + b) } else { 1 << (u64::BITS as usize - 1 - (WALLS * a + b)) }
}

const AT_WALLS: Transform = Transform { place: WALLS_AT, rotation: Rotation { cos: 1.0, sin: 0.0 } };

fn with_margin((min, max): (Vec2, Vec2)) -> (Vec2, Vec2) {
    (min - MARGIN, max + MARGIN)
}

/// Bodies, joints and contacts.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(super) scenery: Arc<Scenery>,
    pub(super) bodies: Solved,
    pub(super) sweeps: [Sweep; BODIES],
    pub(super) poses: [Transform; BODIES],
    /// Poses at which the motions of this substep began.
    pub(super) before: [Transform; BODIES],
    pub(super) forces: [Vec2; BODIES],
    pub(super) torques: [f32; BODIES],
    /// In the order in which they were made; friction comes first.
    pub(super) joints: Vec<Joint>,
    /// In the order in which they were made.
    pub(super) contacts: Vec<Contact>,
    /// Boxes of bodies, with margins, and whether they are new.
    boxes: [(Vec2, Vec2); WALLS],
    moved: [bool; WALLS],
    /// Time since each body moved (s), and whether it sleeps.
    pub(super) rest: [f32; WALLS],
    pub(super) asleep: [bool; WALLS],
    /// Pairs of shapes that have contacts, a bit each.
    pub(super) known: u64,
    /// Room for solving.
    pub(super) constraints: Vec<(usize, Constraint)>,
    pub(super) solving: Vec<(usize, Solving)>,
}

impl World {
    /// A world with bodies, each of them with ground friction.
    pub(crate) fn new(scenery: &Arc<Scenery>, states: &[BodyState]) -> Self {
        let fixed = Sweep {
            local_centre: Vec2::ZERO,
            from: WALLS_AT,
            to: WALLS_AT,
            from_angle: 0.0,
            to_angle: 0.0,
            start: 0.0,
        };
        let mut world = Self {
            scenery: Arc::clone(scenery),
            bodies: scenery.still,
            sweeps: [fixed; BODIES],
            poses: [AT_WALLS; BODIES],
            before: [AT_WALLS; BODIES],
            forces: [Vec2::ZERO; BODIES],
            torques: [0.0; BODIES],
            joints: Vec::with_capacity(MAX_JOINTS),
            contacts: Vec::new(),
            boxes: [(Vec2::ZERO, Vec2::ZERO); WALLS],
            moved: [false; WALLS],
            rest: [0.0; WALLS],
            asleep: [false; WALLS],
            known: 0,
            constraints: Vec::new(),
            solving: Vec::new(),
        };
        for (body, (shape, state)) in scenery.shapes.iter().zip(states).enumerate() {
            let &BodyState { place, angle, velocity, spin } = state;
            let pose = Transform { place, rotation: Rotation::new(angle) };
            let centre = pose.apply(shape.local_centre);
            world.poses[body] = pose;
            let local_centre = shape.local_centre;
            world.sweeps[body] = Sweep {
                local_centre,
                from: centre,
                to: centre,
                from_angle: angle,
                to_angle: angle,
                start: 0.0,
            };
            let bodies = &mut world.bodies;
            (bodies.centre[body], bodies.angle[body]) = (centre, angle);
            (bodies.velocity[body], bodies.spin[body]) = (velocity, spin);
            bodies.rotations[body] = (angle, pose.rotation);
            world.boxes[body] = with_margin(shape.bounds(&pose));
            world.moved[body] = true;
            world.joints.push(Joint::Friction { body, impulse: Vec2::ZERO });
        }
        world
    }

    /// Pose and velocity of a body.
    pub(crate) fn state(&self, body: usize) -> BodyState {
        BodyState {
            place: self.poses[body].place,
            angle: self.sweeps[body].to_angle,
            velocity: self.bodies.velocity[body],
            spin: self.bodies.spin[body],
        }
    }

    /// The pairs of bodies that touch now.
    pub(crate) fn touching(&self) -> impl Iterator<Item = (usize, usize)> {
        let between = self.contacts.iter().filter(|contact| contact.bodies.0 != WALLS);
        between.filter_map(|contact| {
            let mut now = *contact;
            self.update(&mut now);
            now.is_touching().then_some(contact.bodies)
        })
    }

    /// A substep of 1/60 s.
    pub(crate) fn substep(&mut self, is_first: bool) {
        if is_first {
            self.find_new_contacts();
        }
        self.update_contacts();
        self.solve(is_first);
        for body in 0..self.count() {
            self.refit(body);
        }
        self.find_new_contacts();
        self.solve_impacts();
        self.forces = [Vec2::ZERO; BODIES];
        self.torques = [0.0; BODIES];
    }

    /// Number of bodies that move.
    pub(super) fn count(&self) -> usize {
        self.scenery.count()
    }

    /// A shape by its number, the walls first.
    pub(super) fn shape(&self, number: usize) -> &Shape {
        let Scenery { walls, shapes, .. } = &*self.scenery;
        if number < walls.len() { &walls[number] } else { &shapes[number - walls.len()] }
    }

    /// Puts a body where solving has brought it.
    pub(super) fn place(&mut self, body: usize) {
        self.poses[body] = self.bodies.pose(body);
        let sweep = &mut self.sweeps[body];
        (sweep.to, sweep.to_angle) = (self.bodies.centre[body], self.bodies.angle[body]);
    }

    pub(super) fn put(&mut self, body: usize, centre: Vec2, angle: f32) {
        (self.bodies.centre[body], self.bodies.angle[body]) = (centre, angle);
        self.place(body);
    }

    /// Makes the box of a body larger if the body has left it.
    pub(super) fn refit(&mut self, body: usize) {
        let sweep = &self.sweeps[body];
        if sweep.from == sweep.to && sweep.from_angle == sweep.to_angle {
            return;
        }
        let before = &self.before[body];
        let after = &self.poses[body];
        let shape = &self.scenery.shapes[body];
        let (min_a, max_a) = shape.bounds(before);
        let (min_b, max_b) = shape.bounds(after);
        let min = min_a.min(min_b);
        let max = max_a.max(max_b);
        let (known_min, known_max) = self.boxes[body];
        if known_min.cmple(min).all() && max.cmple(known_max).all() {
            return;
        }
        let ahead = 2.0 * (after.place - before.place);
        let (min, max) = with_margin((min, max));
        self.boxes[body] = (min + ahead.min(Vec2::ZERO), max + ahead.max(Vec2::ZERO));
        self.moved[body] = true;
    }

    fn boxes_overlap(&self, shapes: (usize, usize)) -> bool {
        let walls = &self.scenery.boxes;
        let of = |number: usize| {
            if number < walls.len() { walls[number] } else { self.boxes[number - walls.len()] }
        };
        let (min_a, max_a) = of(shapes.0);
        let (min_b, max_b) = of(shapes.1);
        min_b.cmple(max_a).all() && min_a.cmple(max_b).all()
    }

    /// Makes contacts of shapes whose boxes have begun to overlap.
    pub(super) fn find_new_contacts(&mut self) {
        let walls = self.scenery.walls.len();
        let bodies = self.count();
        if !self.moved.contains(&true) {
            return;
        }
        let mut near = 0;
        for body in (0..bodies).filter(|&body| self.moved[body]) {
            for wall in 0..walls {
                let overlap = self.boxes_overlap((wall, walls + body));
                near |= u64::from(overlap) << (WALLS * wall + body);
            }
        }
        near &= !self.known;
        self.known |= near;
        while near != 0 {
            let bit = near.trailing_zeros() as usize;
            let wall = bit / WALLS;
            let body = bit % WALLS;
            self.contacts.push(Contact::new((wall, walls + body), (WALLS, body)));
            near &= near - 1;
        }
        if self.scenery.collisions {
            for a in 0..bodies {
                for b in a + 1..bodies {
                    let held = || self.joints.iter().any(|joint| joint.bodies() == Some((a, b)));
                    if (self.moved[a] || self.moved[b]) && !held() {
                        self.find_new_contact((walls + a, walls + b), (a, b));
                    }
                }
            }
        }
        self.moved = [false; WALLS];
    }

    fn find_new_contact(&mut self, shapes: (usize, usize), bodies: (usize, usize)) {
        let bit = bit_of(shapes.0, bodies);
        if self.known & bit == 0 && self.boxes_overlap(shapes) {
            self.known |= bit;
            self.contacts.push(Contact::new(shapes, bodies));
        }
    }

    /// Ends contacts whose boxes have parted, and finds the points of the others.
    fn update_contacts(&mut self) {
        let mut contacts = core::mem::take(&mut self.contacts);
        let mut parted = 0;
        contacts.retain_mut(|contact| {
            let (a, b) = contact.bodies;
            if self.asleep[b] && (a == WALLS || self.asleep[a]) {
                return true;
            }
            let touched = contact.is_touching();
            let near = self.boxes_overlap(contact.shapes);
            if near {
                self.update(contact);
            } else {
                parted |= bit_of(contact.shapes.0, contact.bodies);
            }
            if touched != (near && contact.is_touching()) {
                self.wake(contact.bodies);
            }
            near
        });
        self.known &= !parted;
        self.contacts = contacts;
    }

    fn update(&self, contact: &mut Contact) {
        if self.is_clear(contact) {
            return contact.part();
        }
        let (a, b) = contact.shapes;
        let bodies = contact.bodies;
        contact.update((self.shape(a), &self.poses[bodies.0]), (self.shape(b), &self.poses[bodies.1]));
    }

    /// Whether the circles around two shapes are so far apart that not even corners with their skins touch.
    fn is_clear(&self, contact: &Contact) -> bool {
        const LEEWAY: f32 = 0.02;
        let (wall, _) = contact.shapes;
        let (a, b) = contact.bodies;
        let shapes = &self.scenery.shapes;
        let centre = self.bodies.centre[b];
        if a == WALLS {
            let (min, max) = self.scenery.bounds[wall];
            let reach = shapes[b].reach + LEEWAY;
            return (centre - reach).cmpgt(max).any() || min.cmpgt(centre + reach).any();
        }
        let reach = shapes[a].reach + shapes[b].reach + LEEWAY;
        self.bodies.centre[a].distance_squared(centre) > reach * reach
    }

    pub(super) fn update_at(&mut self, index: usize) {
        let mut contact = self.contacts[index];
        self.update(&mut contact);
        self.contacts[index] = contact;
    }
}
