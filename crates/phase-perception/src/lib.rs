//! The observation model of a PHASE agent: a conical field of view with occlusion, and touch.
//!
//! An agent knows the walls, but of the other bodies only those it observes (paper, "Formulation" and "Belief
//! Representation and Update"): itself, those it sees, those it touches, and those that touch something it
//! observes. [`observe`] returns a full [`Observation`]; [`observed_set`] returns only *which* bodies are
//! observed, for the millions of states simulated in a search.
//! An agent that faces +y sees the other ahead of it, and not the object behind its back:
//!
//! ```
//! use phase_model::{AgentBody, AgentId, Body, Entity, ObjectId, PhysicsConfig, State, Vec2};
//! use phase_perception::observe;
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let object_radii = [0.8; 2];
//! let physics = PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii, object_count: 1 };
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
//! The eye is at the agent's centre of mass and looks along its heading, [54.69°](viewpoint::TAN_HALF_ANGLE)
//! to either side, as far as the arena extends. Inner walls, objects and the other agent occlude the view,
//! the bodies as discs. This includes a held object, so an agent that carries something in front of its head
//! sees little else: in the paper all entities obstruct the view.
//!
//! # Key design decisions
//!
//! Visibility is computed for [cells](Cell) of 1 × 1 u, by their centres, as in the paper and the published
//! simulator, so that the question "where could it still be?" has an exact answer for a particle. A body is
//! seen if one of the cells of its [footprint](footprint()) is visible, with that body itself excluded from
//! the occluders; otherwise a large body straight ahead would hide its own cells and remain unseen. The
//! trade-off is that a body becomes visible as soon as the centre of one of its cells does, and remains
//! hidden as long as none is visible.
//!
//! The set of observed entities is the *smallest set* that satisfies the paper's sentence "entities that are
//! in contact with observed entities are also defined as observed": the transitive closure of contacts.
//! Stopping after one link, as the published simulator does, would make the result depend on the order in
//! which links are followed, and an agent could be observed without the object it holds. With the closure, no
//! unobserved body touches an observed one, and no unobserved agent holds an observed object, so that a
//! belief never has to complete half of a grip. The trade-off: a row of touching bodies is observed as a
//! whole as soon as one of them is.
//!
//! An [`Observation`] contains copies of the observed bodies only, so that code built on it cannot access
//! hidden state.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod cells;
pub mod footprint;
mod observation;
pub mod viewpoint;

pub use cells::{Cell, CellSet};
pub use footprint::footprint;
pub use observation::{Observation, observe, observe_told, observed_set, observed_sets};
pub use viewpoint::{Viewpoint, field_of_view, sees};
