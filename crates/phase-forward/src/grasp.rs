//! The connection of an agent with the object it holds: a weld, or the spring that the published planner
//! imagines.

use crate::{
    body::{BodyMotion, Shape, Twist},
    rod::Rod,
    weld::Weld,
};
use phase_model::Vec2;

/// The joint of one grip.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Grasp {
    Weld(Weld),
    Rod(Rod),
}

impl Grasp {
    pub(crate) const fn agent(&self) -> usize {
        match self {
            Self::Weld(weld) => weld.agent,
            Self::Rod(rod) => rod.agent,
        }
    }

    pub(crate) const fn object(&self) -> usize {
        match self {
            Self::Weld(weld) => weld.object,
            Self::Rod(rod) => rod.object,
        }
    }

    /// Accumulated impulse (N s) and angular impulse (N u s). That of a rod has one component, stored as x.
    pub(crate) const fn impulse(&self) -> (Vec2, f32) {
        match self {
            Self::Weld(weld) => weld.impulse,
            Self::Rod(rod) => (Vec2::new(rod.impulse, 0.0), 0.0),
        }
    }

    /// Computes the effect of impulses at the present poses, and applies the accumulated ones.
    pub(crate) fn prepare(
        &mut self,
        shapes: &[Shape; 5],
        motions: &[BodyMotion; 5],
        twists: &mut [Twist; 5],
    ) {
        match self {
            Self::Weld(weld) => weld.prepare(shapes, motions, twists),
            Self::Rod(rod) => rod.prepare(shapes, motions, twists),
        }
    }

    /// One iteration of the velocity solver. Returns the maximum change of an impulse.
    #[inline]
    pub(crate) fn solve(&mut self, shapes: &[Shape; 5], twists: &mut [Twist; 5]) -> f32 {
        match self {
            Self::Weld(weld) => weld.solve(shapes, twists),
            Self::Rod(rod) => rod.solve(shapes, twists),
        }
    }

    /// One iteration of the position solver, which leaves springs alone. Returns whether the error was
    /// negligible.
    pub(crate) fn join(&self, shapes: &[Shape; 5], motions: &mut [BodyMotion; 5]) -> bool {
        match self {
            Self::Weld(weld) => weld.join(shapes, motions),
            Self::Rod(_) => true,
        }
    }
}
