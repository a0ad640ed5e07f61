//! The true PHASE world: a scene simulated by rapier2d, stepped by actions.
//!
//! [`World`] takes a [`Physique`](phase_model::Physique) and a [`State`](phase_model::State), advances by
//! five substeps of 1/60 s per step under the two agents' actions, and reports the state after each with the
//! grips and the contacts between bodies. [`WorldDynamics`] puts it behind the interface of planners.
//!
//! The key design decision is that everything is done with rapier's own means: solver settings (`settings`),
//! bodies, skins and foreseen contacts (`bodies`), contact hooks (`contact`), motors for ground friction
//! (`friction`) and welds for grips (`grip`). There is no second solver around the engine, so what it promises
//! holds here: walls stop what moves at any speed, overlaps are undone without explosions, and the same inputs
//! give the same bits on every thread. Three things are done around it: a substep whose contacts or welds made
//! a body slide another way than foreseen is taken again with friction aimed better (`substep`), rotations,
//! which rapier integrates along the tangent, are set right afterwards, and so is an origin that bodies
//! starting in one spot squeezed out of the arena (`mover`).
//!
//! Nothing is warm-started, so a pose and a velocity per body are nearly the whole state. A world built anew
//! from its own [`World::state`] goes on as the old one would have, except for pairs that were let go and still
//! overlap, and for the last bits of contacts, whose order the engine remembers; collisions amplify those.
//!
//! The price is time, 10 to 40 µs a substep: rapier keeps sets, graphs and trees for thousands of bodies where
//! there are four, and bodies in contact need two or three takes. Planners that imagine millions of steps want
//! a plain-data kernel instead; this crate is the authority that such a kernel is held against. The other price
//! is fidelity in hard impacts: two discs struck together part company with recordings of the published
//! simulator by some tenths of a unit, and so, for a few substeps, does what is driven into a wall by a body
//! behind it.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod bodies;
mod contact;
pub mod dynamics;
mod friction;
mod grip;
mod impact;
mod mover;
mod settings;
mod substep;
pub mod world;

pub use dynamics::WorldDynamics;
pub use world::World;
