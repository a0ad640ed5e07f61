//! The distances at which predicates become true.

/// An agent is on a landmark when its origin is closer than this to the centre (u): 0.02 of the longest route
/// in the arena, the value with which the published recordings were made.
pub const ON_AGENT: f32 = 0.566;
/// An object is on a landmark when its centre is closer than this to the landmark's centre (u): 0.05 of the
/// longest route in the arena.
pub const ON_OBJECT: f32 = 1.414;
/// A body that moves less than this in a step is not seen to move (u, and rad of rotation).
pub const SEEN_MOTION: f32 = 0.02;
/// Two entities are close when the distance of their origins is less than the sum of their radii and this
/// (u): about the length of a small body. The paper does not give the value.
pub const CLOSE_GAP: f32 = 1.5;
