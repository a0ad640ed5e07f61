//! The true PHASE world: a scene simulated by rapier2d, stepped by actions.
//!
//! [`World`] takes a [`Physique`](phase_model::Physique) and a [`State`](phase_model::State), advances by
//! five substeps of 1/60 s per step under the two agents' actions, and reports every state in between with
//! the contacts the engine found.
//!
//! The key design decision is that everything is done with rapier's own means: solver settings
//! ([`settings`]), joints ([`friction`], [`grip`]), skins and continuous collision ([`bodies`]) and contact
//! hooks ([`contact`]). There is no second solver around the engine, so what the engine guarantees (no
//! explosions, no tunnelling, bit-identical repetition) stays guaranteed. Warm starting is off, so a pose and
//! a velocity per body are the whole state: a world built anew from its own [`World::state`] goes on as the
//! old one would have.
//!
//! The price is time: a substep costs microseconds, because rapier keeps sets, graphs and trees for
//! thousands of bodies where there are four. Planners that imagine millions of steps want a plain-data
//! kernel instead; this crate is the authority that such a kernel is held against.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod bodies;
mod contact;
pub mod dynamics;
mod friction;
mod grip;
mod mover;
mod settings;
mod substep;
pub mod world;

pub use dynamics::WorldDynamics;
pub use world::World;
