//! What a PHASE agent sees and feels: a conical field of view with occlusion, and touch.
//!
//! An agent knows the walls, but of the other bodies only what it observes (paper, "Formulation" and "Belief
//! Representation and Update"): itself, what it sees, what it touches, and whatever touches something it
//! observes. [`observe`] answers in full and gives an [`Observation`]; [`observed_set`] answers only *which*
//! bodies are observed, for the millions of states that a planner imagines.
//! An agent that faces +y sees the other ahead of it, and not the object behind its back:
//!
//! ```
//! use phase_model::{AgentBody, AgentId, Body, Entity, ObjectId, PhysicsConfig, State, Vec2};
//! use phase_perception::observe;
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let physics = PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.8; 2], object_count: 1 };
//! let places = [Vec2::new(16.0, 9.0), Vec2::new(16.0, 15.0), Vec2::new(16.0, 4.0), Vec2::ZERO];
//! let state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
//!
//! let observation = observe(&physics, &state, AgentId::ZERO);
//! let other = Entity::Agent(AgentId::ONE);
//! assert_eq!(observation.body(other), Some(state.body(other)));
//! assert_eq!(observation.body(Entity::Object(ObjectId::ZERO)), None);
//! ```
//!
//! # What is seen
//!
//! The eye sits in the agent's centre of mass and looks along its heading, [54.69°](viewpoint::TAN_HALF_ANGLE) to
//! either side, as far as the arena reaches. Inner walls, objects and the other agent stand in the way, the
//! bodies as discs. A held object is no exception, so an agent that carries something in front of its head
//! sees little else: in the paper all entities obstruct the view.
//!
//! # The key design decisions
//!
//! Seeing is reckoned in [cells](Cell) of 1 × 1 u, and by their centres, as in the paper and the published
//! simulator, so that the question "where could it still be?" has an exact answer for a particle. A body is
//! seen if one of the cells of its [footprint](footprint()) is visible, leaving that body itself out of what
//! stands in the way; otherwise a large body straight ahead would hide its own cells and go unseen. The price
//! is that a body shows as soon as the centre of one of its cells does, and hides as long as none does.
//!
//! What is observed is the *least set* that satisfies the paper's sentence "entities that are in contact with
//! observed entities are also defined as observed": touching is followed from body to body until nothing new
//! comes up. Stopping after one link, as the published simulator does, would make the answer depend on the
//! order in which links are followed, and could show an agent without what it holds. With the closure, a body
//! that is not observed touches nothing that is, and nobody unobserved holds anything observed, so that a
//! belief never has to guess half of a grip. The price: a row of touching bodies is known as a whole as soon
//! as one of them is.
//!
//! An [`Observation`] holds copies of the observed bodies only, so that nothing built upon it can peek.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod cells;
pub mod footprint;
pub mod observation;
pub mod viewpoint;

pub use cells::{Cell, CellSet};
pub use footprint::footprint;
pub use observation::{Observation, observe, observed_set};
pub use viewpoint::{Viewpoint, field_of_view, sees};
