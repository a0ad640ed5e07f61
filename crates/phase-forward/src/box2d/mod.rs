//! The engine of the published simulator, bit for bit: Box2D 2.3 (Erin Catto, zlib licence), of which this is
//! an altered version, cut down to what a step of that simulator needs.
//!
//! A search compares sums of many rewards, and a difference in the last bit of one position changes which
//! action it visits next. So this engine does the same operations on the same numbers in the same order, and
//! `tests/box2d` compares bits. Left out is what has no effect there: restitution, friction at contacts,
//! damping, gravity, and the tree of the broad phase, whose pairs are sorted anyway. The velocity
//! solver stops before its tenth iteration once an iteration has changed nothing.

// Copyright (c) 2006-2011 Erin Catto http://www.box2d.org
//
// This software is provided 'as-is', without any express or implied warranty. In no event will the authors be
// held liable for any damages arising from the use of this software. Permission is granted to anyone to use
// this software for any purpose, including commercial applications, and to alter it and redistribute it
// freely, subject to the following restrictions:
// 1. The origin of this software must not be misrepresented; you must not claim that you wrote the original
//    software. If you use this software in a product, an acknowledgment in the product documentation would be
//    appreciated but is not required.
// 2. Altered source versions must be plainly marked as such, and must not be misrepresented as being the
//    original software.
// 3. This notice may not be removed or altered from any source distribution.

mod collide;
mod contact;
mod distance;
mod handle;
mod impact;
mod impacts;
mod island;
mod joint;
mod math;
mod shape;
mod world;

pub(crate) use joint::Joint;
pub(crate) use shape::Shape;
pub(crate) use world::{BodyState, Scenery, World};

use core::f32::consts::PI;
use phase_model::Vec2;

/// Number of bodies, the last of which is static and carries all walls.
pub(crate) const BODIES: usize = 5;
/// The static body.
pub(crate) const WALLS: usize = BODIES - 1;
/// Place of the static body (u).
pub(crate) const WALLS_AT: Vec2 = Vec2::new(16.0, 12.0);

/// Most joints: friction of four bodies, two grips, and two new ones.
const MAX_JOINTS: usize = 8;

/// Duration of a substep (s).
const DT: f32 = (1.0 / 60.0_f64) as f32;
/// Share of a substep's impulses with which the next begins: the quotient of both durations, as rounded.
const WARM: f32 = 1.0 / DT * DT;
const ITERATIONS: usize = 10;
const LINEAR_SLOP: f32 = 0.005;
const ANGULAR_SLOP: f32 = 2.0 / 180.0 * PI;
/// Thickness of the skin around polygons and edges (u).
const SKIN: f32 = 2.0 * LINEAR_SLOP;
const MAX_CORRECTION: f32 = 0.2;
