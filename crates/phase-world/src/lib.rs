//! The true PHASE world: a scene simulated by rapier2d, stepped by actions.
//!
//! [`World`] takes a [`PhysicsConfig`](phase_model::PhysicsConfig) and a [`State`](phase_model::State), advances by
//! five substeps of 1/60 s per step under the two agents' actions, and reports the state after each with the
//! grips and the contacts between bodies. [`WorldDynamics`] puts it behind the interface of planners.
//! One agent pushes forward for a step of five substeps while the other rests:
//!
//! ```
//! use phase_model::{Action, AgentBody, AgentId, Body, Entity, PhysicsConfig, State, Vec2};
//! use phase_world::World;
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let physics = PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//! let places = [Vec2::new(10.0, 6.0), Vec2::new(20.0, 16.0), Vec2::ZERO, Vec2::ZERO];
//! let start = State::new(places.map(|place| Body::at_rest(place, 0.0))); // both face +y
//! let mut world = World::new(&physics, &start);
//!
//! let substeps = world.step([Action::Up, Action::NoForce]);
//! let heights = substeps.map(|state| state.position(Entity::Agent(AgentId::ZERO)).y);
//! assert!(heights[0] > 6.0 && heights.is_sorted());
//! assert!(world.state().position(Entity::Agent(AgentId::ONE)).distance(places[1]) < 1e-3);
//! ```
//!
//! The key design decision is that everything is done with rapier's own means: solver settings (`settings`),
//! bodies and skins (`bodies`), contact hooks (`contact`), motors for ground friction
//! (`friction`), welds for grips (`grip`), sweep tests for impacts on walls (`impact`). There is no second
//! solver around the engine, so what it promises holds here: walls stop what moves at any speed, overlaps are
//! undone without explosions, and the same inputs give the same bits on every thread. Four things are done
//! around it: a substep whose contacts or welds made a body slide another way than foreseen is taken again with
//! friction aimed better (`substep`); rotations, which rapier integrates along the tangent, are set right
//! afterwards (`dynamic_body`); a body that hit a wall in mid-substep goes back to the moment of impact, has the
//! engine resolve it there, and goes on for the time left (`impact`); and an origin that bodies starting in one
//! spot squeezed out of the arena is put back (`dynamic_body`).
//!
//! Impacts are found, not foreseen. rapier offers two other ways, and both cost fidelity: contacts foreseen
//! along the way act with the lever of where the body starts and catch on the ends of walls that it is about to
//! pass, and rapier's own continuous collision detection drops what is left of the substep, also along the
//! wall.
//!
//! Nothing is warm-started, so a pose and a velocity per body are nearly the whole state. A world built anew
//! from its own [`World::state`] goes on as the old one would have, except for pairs that were let go and are
//! not clear of each other yet, and for the last bits of contacts, whose order the engine remembers; collisions
//! amplify those.
//!
//! The price is time, 10 to 40 µs a substep: rapier keeps sets, graphs and trees for thousands of bodies where
//! there are four, bodies in contact need two or three takes, and an impact is resolved in an engine built for
//! it. Planners that imagine millions of steps want a plain-data kernel instead; this crate is the authority
//! that such a kernel is held against. The other price is fidelity in hard impacts between bodies: two discs
//! struck together part company with recordings of the published simulator by some tenths of a unit.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

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
