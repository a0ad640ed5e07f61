//! A PHASE agent's belief: particles that are complete states of the world, predicted, checked and resampled.
//!
//! An agent does not know the positions of the bodies that it does not observe. Its [`Belief`] is a set of
//! [`PARTICLE_COUNT`] possible states of the whole world (paper, "Belief Representation and Update"). In
//! every step each particle is
//!
//! 1. predicted by one step of the dynamics under the agent's own action and constant motion of the other,
//! 2. overwritten with the observed part of the true state, and
//! 3. checked: bodies that contradict the observation are resampled in unseen free space.
//!
//! A body contradicts the observation if it lies where the agent sees that nothing is, in a wall or out of
//! the arena, or in another body, or if its numbers are not finite. In this example an agent sees the other
//! one, but not the object behind its back. Every particle has the other agent at its true position, and the
//! object in some place that the agent does not see:
//!
//! ```
//! use phase_belief::{Belief, PARTICLE_COUNT};
//! use phase_model::{
//!     AgentBody, AgentId, Body, Entity, ObjectId, PhysicsConfig, State, Vec2,
//!     random::{Purpose, stream},
//! };
//! use phase_perception::{observe, sees};
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let object_radii = [0.8; 2];
//! let physics = PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii, object_count: 1 };
//! let positions = [Vec2::new(16.0, 9.0), Vec2::new(16.0, 15.0), Vec2::new(16.0, 4.0), Vec2::ZERO];
//! let state = State::new(positions.map(|position| Body::at_rest(position, 0.0)));
//!
//! let observation = observe(&physics, &state, AgentId::ZERO);
//! let belief = Belief::new(&physics, &observation, PARTICLE_COUNT, &mut stream(1, Purpose::Belief, 0));
//! for particle in belief.particles() {
//!     assert_eq!(particle.position(Entity::Agent(AgentId::ONE)), positions[1]);
//!     assert!(!sees(&physics, particle, AgentId::ZERO, Entity::Object(ObjectId::ZERO)));
//! }
//! ```
//!
//! # Key design decision
//!
//! Particles have no weights and are never copied from one another. The observation is exact, so a hypothesis
//! is either possible or not; an impossible body is resampled rather than replaced by a copy of another
//! particle's. Particles therefore never collapse into copies of a few. The trade-off: a resampled body loses
//! its previous hypothesis, and the resampling distribution *is* the prior of the search for hidden bodies.
//!
//! # Where bodies are resampled
//!
//! The place of a resampled body is uniform over the free space, weighted by the probability that a body got
//! there unseen: a cell has weight 0 while it is visible, 1 if it has never been seen, and 1 − exp(−age/τ) if
//! it was last seen `age` steps ago ([`occupancy_weight`]). A place that was seen empty is likely to be still
//! empty, the more so the more recently it was seen; τ is 20 steps for an agent, which moves on its own, and
//! 200 steps, longer than an event, for an object, which lies until an agent moves it. So a searching agent
//! turns to unseen places first, yet never runs out of places when it has seen everything. A body lies on
//! many cells, and the minimum of their weights counts: it would have been noticed in any of them. Strips
//! between cells that happen to have been missed would otherwise attract bodies that do not fit into them.
//!
//! A resampled body is at rest and neither holds nor is held; an agent's heading is uniform. If either side
//! of a grip is resampled, the grip is dropped and the other body stays.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod ascribed;
mod belief;
mod consistency;
mod contest;
mod memory;
mod predict;
mod resampling;
mod weights;

pub use ascribed::{AscribedBelief, Glance};
pub use belief::{Belief, PARTICLE_COUNT, overwrite};
pub use contest::Contest;
pub use memory::{AGENT_DECAY_STEPS, CellMemory, OBJECT_DECAY_STEPS, occupancy_weight};
