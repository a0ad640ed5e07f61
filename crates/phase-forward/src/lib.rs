//! The PHASE dynamics as a plain-data kernel that a planner can copy and step millions of times.
//!
//! [`Forward`] holds the constants of a scene: walls, shapes, masses, forces. A [`phase_model::State`] is
//! `Copy`, so a moment is saved by copying it and restored exactly. A step allocates nothing, uses neither
//! random numbers nor a clock, and is reproducible bit for bit. There are three kinds of step:
//!
//! - [`phase_model::Dynamics::step`], and [`Forward::step_substeps`] with its five frames, go from a state
//!   alone. This is what belief particles use.
//! - [`phase_model::Dynamics::step_approximate`] goes from a state alone as well, at a fraction of the cost.
//!   This is what searches use; see below.
//! - [`Forward::step_warm`] also takes a [`SolverCache`] of the last impulses and of the broad-phase pairs.
//!   This is what replays of recordings need.
//!
//! Key design decision: the solver is of the same *kind* as the one that made the published recordings
//! (sequential impulses with ten iterations, ground friction and grips as constraints among the contacts,
//! overlaps corrected by moving bodies, impacts on walls found in time), specialised to two trapezoids, two
//! discs and thin walls. A solver of another kind would be a close approximation, but a planner that inverts
//! recordings, or pushes an object for ten steps, needs the same numbers. The trade-off is that its
//! peculiarities are reproduced too, and that it supports nothing beyond PHASE: at most four bodies, no
//! friction between them, no restitution.
//!
//! An agent pushes forward for a step. A copy of the state before it, stepped again, ends in the same bits:
//!
//! ```
//! use phase_forward::Forward;
//! use phase_model::{Action, AgentBody, AgentId, Body, Dynamics, Entity, PhysicsConfig, State, Vec2};
//!
//! fn main() {
//!     let body = AgentBody { radius: 0.8, max_force: 450.0 };
//!     let agents = [body; 2];
//!     let physics = PhysicsConfig { walls: Vec::new(), agents, object_radii: [0.0; 2], object_count: 0 };
//!     let places = [Vec2::new(10.0, 6.0), Vec2::new(20.0, 16.0), Vec2::ZERO, Vec2::ZERO];
//!     let start = State::new(places.map(|place| Body::at_rest(place, 0.0))); // both face +y
//!     let forward = Forward::new(&physics);
//!
//!     let mut state = start;
//!     forward.step(&mut state, [Action::Up, Action::NoForce]);
//!     let agent = Entity::Agent(AgentId::ZERO);
//!     assert!(state.position(agent).y > 6.0 && state.position(agent).x == 10.0);
//!     assert_eq!(state.position(Entity::Agent(AgentId::ONE)), places[1]); // nothing acts on the other
//!
//!     let mut again = start;
//!     forward.step(&mut again, [Action::Up, Action::NoForce]);
//!     assert_eq!(again, state); // bit for bit
//! }
//! ```
//!
//! # One substep of 1/60 s
//!
//! 1. An agent's force or torque changes its velocity ([`phase_model::Action::push`] acts R/12 behind its
//!    origin, in its own frame); `stop` sets the velocity to zero.
//! 2. Shapes that touch at their present poses become contacts. Bodies connected by contacts and grips are
//!    solved together: grips, ground friction (at most 100 N at a body's origin), then contacts, newest
//!    first.
//! 3. Bodies move, and overlaps and stretched grips are corrected by moving them further.
//! 4. A body whose path led it onto a wall is reset to the moment of impact, loses its normal velocity and
//!    moves on from there for the rest of the substep. Bodies may tunnel through each other, but not through
//!    walls.
//!
//! After the fifth substep agents stop turning; objects do not.
//!
//! # What a state does not contain
//!
//! A released object may overlap its holder by up to [`RELEASED_OVERLAP`] until one of them has moved about
//! that far; if it was held at a flank it penetrates the agent by a tenth of its radius. From a state alone,
//! this tolerance applies in the step of the `detach`, and at the start of later ones if the object
//! penetrates a flank to that depth exactly where it would have been held, does not approach, and was not in
//! contact; in either case until one of the two has moved away from where it then was. [`SolverCache`]
//! follows the original for three steps after a release: the two do not touch at all before one of them has
//! left its enlarged box. From then on the same tolerance applies, whereas in the original they may overlap
//! for ever.
//!
//! [`RELEASED_OVERLAP`]: phase_model::physics::RELEASED_OVERLAP
//!
//! Impulses are the other information that a state lacks: the first substep of a step from a state alone
//! starts with zero impulses and has twice the iterations; each of the other four is warm-started by the one
//! before.
//!
//! # Coarse steps
//!
//! A search compares actions by thousands of simulated steps, most of them random, which have to be plausible
//! and cheap. [`Forward::step_coarse`] makes a step in one substep, or in two where bodies may collide.
//! Bodies that hold each other move as one rigid body, so grips need no solving, and the solvers stop
//! earlier. Forces, ground friction, contacts and impacts on walls are the same; uniform acceleration gives
//! the same displacement as five substeps. `tests/forward/coarse.rs` compares it with exact steps: 90 % lie
//! within 0.15 to 0.25 u, where a body moves about 1 u in a step.
//!
//! # Reachability and sleeping
//!
//! Bodies that cannot reach anything within the step are moved without contact tests. Bodies at rest without
//! a moving body nearby are skipped. Outlines are computed once for every pose.

#![forbid(unsafe_code)]
#![deny(missing_docs)]
// The example is a whole program, as README shows it.
#![allow(clippy::needless_doctest_main)]

mod body;
mod box2d;
mod clip;
mod coarse;
mod collide;
mod constants;
mod contact;
mod contain;
mod continuous;
mod exertion;
mod finish;
mod forward;
mod group;
mod imagined;
mod key;
mod lasting;
mod manifold;
mod model;
mod narrow;
mod original;
mod outline;
mod polygon;
mod reach;
mod released;
mod solver_cache;
mod substep;
mod time_of_impact;
mod touching;
mod turn;
mod wall;
mod weld;
mod world;

pub use exertion::Exertion;
pub use forward::Forward;
pub use imagined::Imagined;
pub use lasting::ForwardWorld;
pub use original::OriginalWorld;
pub use solver_cache::SolverCache;
