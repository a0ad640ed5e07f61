//! The PHASE dynamics as a plain-data kernel that a planner can copy and step millions of times.
//!
//! [`Forward`] holds what never changes of a scene: walls, shapes, masses, forces. A [`phase_model::State`] is
//! `Copy`, so remembering a moment is copying it and going back is exact. A step allocates nothing, uses no
//! chance and no clock, and repeats bit for bit. There are three ways to step:
//!
//! - [`phase_model::Dynamics::step`], and [`Forward::step_substeps`] with its five frames, go from a state
//!   alone. This is what belief particles use.
//! - [`phase_model::Dynamics::step_approximate`] goes from a state alone as well, at a fraction of the cost. This is what
//!   searches use; see below.
//! - [`Forward::step_warm`] also takes a [`SolverCache`] of the impulses that acted last, and of the pairs that
//!   were up for contact. This is what replays of recordings need.
//!
//! The key design decision is to be the same *kind* of solver as the one that made the published recordings
//! (sequential impulses with ten iterations, ground friction and grips as constraints among the contacts,
//! overlaps taken back by moving bodies, impacts on walls found in time), specialised to two trapezoids, two
//! discs and thin walls. A solver of another kind comes out near, but a planner that inverts recordings, or
//! pushes an object for ten steps, needs the same numbers. The price is that its oddities are kept too, and
//! that nothing else than PHASE fits in: no more than four bodies, no friction between them, no bounce.
//!
//! An agent pushes forward for a step. A copy of the state before it, stepped again, ends in the same bits:
//!
//! ```
//! use phase_forward::Forward;
//! use phase_model::{Action, AgentBody, AgentId, Body, Dynamics, Entity, PhysicsConfig, State, Vec2};
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let physics = PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//! let places = [Vec2::new(10.0, 6.0), Vec2::new(20.0, 16.0), Vec2::ZERO, Vec2::ZERO];
//! let start = State::new(places.map(|place| Body::at_rest(place, 0.0))); // both face +y
//! let forward = Forward::new(&physics);
//!
//! let mut state = start;
//! forward.step(&mut state, [Action::Up, Action::NoForce]);
//! let agent = Entity::Agent(AgentId::ZERO);
//! assert!(state.position(agent).y > 6.0 && state.position(agent).x == 10.0);
//! assert_eq!(state.position(Entity::Agent(AgentId::ONE)), places[1]); // nothing acts on the other
//!
//! let mut again = start;
//! forward.step(&mut again, [Action::Up, Action::NoForce]);
//! assert_eq!(again, state); // bit for bit
//! ```
//!
//! # One substep of 1/60 s
//!
//! 1. An agent's force or torque changes its velocity ([`phase_model::Action::push`] acts R/12 behind its
//!    origin, in its own frame); `stop` sets the velocity to zero.
//! 2. Shapes that touch where they are now become contacts. What hangs together by contacts and grips is
//!    solved together: grips, ground friction (at most 100 N at a body's origin), then contacts, newest first.
//! 3. Bodies move, and overlaps and stretched grips are corrected by moving them further.
//! 4. A body whose way led it onto a wall goes back to the moment of impact, loses its speed into the wall
//!    and spends the rest of the substep from there. Bodies may tunnel through each other, but not through walls.
//!
//! After the fifth substep agents stop turning; objects do not.
//!
//! # What a state does not say
//!
//! Let go of, an object does not touch its holder again before one of them has moved about 0.1 u; if it was
//! held at a flank it lies a tenth of its radius deep in the agent. [`SolverCache`] carries this as the original
//! does. From a state alone, the pair is kept apart in the step of the `detach`, and at the start of later
//! ones if the object lies deep in a flank just where it was held, does not approach, and was not in contact;
//! in either case until one of the two has moved away from where it then was.
//!
//! Impulses are the other thing a state leaves out: the first substep of a step from a state alone starts
//! from none, with twice the iterations; the four after it go on from each other's.
//!
//! # Coarse steps
//!
//! A search compares actions by thousands of simulated steps, most of them random, which have to be plausible and
//! cheap. [`Forward::step_coarse`] makes a step in one substep, or in two where bodies may run into each other.
//! What holds each other moves as one rigid body, so grips need no solving, and the solvers stop earlier. Forces,
//! ground friction, contacts and impacts on walls are the same; uniform acceleration gives the same displacement
//! as five substeps. `tests/coarse.rs` compares it with exact steps: 90 % lie within 0.15 to 0.25 u, where a body
//! moves about 1 u in a step.
//!
//! # What it costs to reach
//!
//! Bodies that can reach nothing within the step are moved without looking at anything. Bodies that lie still
//! and that nothing moving is near are left alone. Outlines are worked out once for every pose.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod body;
mod clip;
mod coarse;
mod collide;
mod constants;
mod contact;
mod contain;
mod continuous;
mod finish;
mod forward;
mod group;
mod key;
mod manifold;
mod model;
mod narrow;
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

pub use forward::Forward;
pub use solver_cache::SolverCache;
