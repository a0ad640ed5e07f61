//! The reference PHASE environment: a scene simulated by rapier2d, stepped by actions.
//!
//! [`World`] takes a [`PhysicsConfig`](phase_model::PhysicsConfig) and a [`State`](phase_model::State),
//! advances by five substeps of 1/60 s per step under the two agents' actions, and reports the state after
//! each with the grips and the contacts between bodies. [`WorldDynamics`] puts it behind the interface of
//! planners. One agent pushes forward for a step of five substeps while the other rests:
//!
//! ```
//! use phase_model::{Action, AgentBody, AgentId, Body, Entity, PhysicsConfig, State, Vec2};
//! use phase_world::World;
//!
//! fn main() {
//!     let body = AgentBody { radius: 0.8, max_force: 450.0 };
//!     let physics =
//!         PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//!     let places = [Vec2::new(10.0, 6.0), Vec2::new(20.0, 16.0), Vec2::ZERO, Vec2::ZERO];
//!     let start = State::new(places.map(|place| Body::at_rest(place, 0.0))); // both face +y
//!     let mut world = World::new(&physics, &start);
//!
//!     let substeps = world.step([Action::Up, Action::NoForce]);
//!     let heights = substeps.map(|state| state.position(Entity::Agent(AgentId::ZERO)).y);
//!     assert!(heights[0] > 6.0 && heights.is_sorted());
//!     assert!(world.state().position(Entity::Agent(AgentId::ONE)).distance(places[1]) < 1e-3);
//! }
//! ```
//!
//! Key design decision: everything is done with rapier's own features: solver settings (`settings`), bodies
//! and skins (`bodies`), contact hooks (`contact`), motors for ground friction (`friction`), welds for grips
//! (`grip`), sweep tests for impacts on walls (`impact`). There is no second solver around the engine, so the
//! engine's guarantees hold here: walls stop bodies at any speed, overlaps are resolved without explosions,
//! and the same inputs give the same bits on every thread. Four things are done around it: a substep in which
//! contacts or welds made a body slide in another direction than predicted is repeated with a better friction
//! direction (`substep`); rotations, which rapier integrates along the tangent, are corrected afterwards
//! (`dynamic_body`); a body that hit a wall in mid-substep is reset to the moment of impact, which the engine
//! resolves, and continues for the remaining time (`impact`); and an origin that bodies starting at the same
//! point have squeezed out of the arena is moved back (`dynamic_body`).
//!
//! Impacts are found in retrospect, not predicted. rapier offers two other methods, and both reduce fidelity:
//! contacts predicted along the path act with the lever arm of the body's start pose and catch on the ends of
//! walls that it is about to pass, and rapier's own continuous collision detection drops the remainder of the
//! substep, also along the wall.
//!
//! Nothing is warm-started, so a pose and a velocity per body are nearly the whole state. A world rebuilt
//! from its own [`World::state`] continues as the old one would have, except for released pairs that are not
//! clear of each other yet, and for the last bits of contacts, whose order the engine remembers; collisions
//! amplify those.
//!
//! The cost is time, 10 to 40 µs a substep: rapier keeps sets, graphs and trees for thousands of bodies where
//! there are four, bodies in contact need two or three iterations, and an impact is resolved in an engine
//! built for it. Planners that simulate millions of steps need a plain-data kernel instead; this crate is the
//! reference that such a kernel is compared with. The other cost is fidelity in hard impacts between bodies:
//! two discs struck together diverge from recordings of the published simulator by some tenths of a unit.

#![forbid(unsafe_code)]
#![deny(missing_docs)]
// The example is a whole program, as README shows it.
#![allow(clippy::needless_doctest_main)]

mod bodies;
mod contact;
mod dynamic_body;
pub mod dynamics;
mod friction;
mod grip;
mod impact;
mod settings;
mod substep;
pub mod world;

pub use dynamics::WorldDynamics;
pub use world::World;
