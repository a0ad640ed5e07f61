//! The mind of the published simulator's agents, reimplemented from a description of what it does.
//!
//! The recordings that the paper's results are about were made by these minds, which differ from the paper's
//! text (and from `phase-agent`) at every level: what is observed and believed ([`senses`], [`Belief`]),
//! which subgoal is pursued (hand-written rules over four rooms, then [`Mind::decide`]), and how an action is
//! searched.
//!
//! Key design decision: what the original does is done here, its oddities included where they show in what
//! its agents do; a recording is explained best by the mind that made it. The trade-off is a mind that nobody
//! would build on purpose.
//!
//! In questions that the description leaves open, the published recordings decide:
//!
//! - An agent that is hindered on the way to a landmark chooses from twelve actions instead of five while
//!   both are in the landmark's room: of its pushes there most go sideways, and none elsewhere.
//! - A hinderer that waits for the other on its way does not count the room it is in, so that it goes to and
//!   fro.
//! - An object to be carried is grabbed only if it is the one that `attach` would take.
//!
//! Differences from the original that are meant:
//!
//! - A reflected scene is thought about as it is. The original always ran in the layout before reflection,
//!   which can be told apart only by where unseen bodies are put ([`Belief`] follows it).
//! - Where the original crashes or divides by zero, something sensible is done: once every cell has been
//!   seen, unseen bodies are put wherever the agent does not look.
//! - An unseen body that the agent believes in view is redrawn even if the truth lies within 1 u, which the
//!   original tells by looking at the truth. A grip ends when either side of it is redrawn.
//! - Cells count as seen if they are in view at the end of a step, not after each substep.
//! - Either agent may help or hinder; in the original only the first can.
//!
//! Unknown: about one agent in four that has reached its goal coasts to rest instead of stopping.
//!
//! An agent that faces the landmark it wants to reach pushes forward:
//!
//! ```
//! use phase_model::{Action, AgentId, LandmarkId, Scene, Sign, random::{Purpose, stream}};
//! use phase_published::{Aim, Belief, Mind, PublishedParameters, senses::observe};
//!
//! let scene = Scene::from_json(
//!     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
//! )?;
//! let physics = scene.physics();
//! let state = scene.initial_state();
//! let own = AgentId::ZERO;
//! let mut random = stream(1, Purpose::Search, 0);
//! let belief = Belief::new(scene.layout, &physics, &observe(&physics, &state, own), 5, &mut random);
//! let parameters = PublishedParameters { simulations: 100, ..PublishedParameters::default() };
//! let mut mind = Mind::new(&scene, own, parameters)?;
//! assert_eq!(mind.aim(&state), Aim::AgentToLandmark(own, LandmarkId::TOP_RIGHT, Sign::Positive));
//! assert_eq!(mind.decide(belief.particles(), &mut random)?.0, Action::Up);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod aim;
mod belief;
mod memo;
mod mind;
mod parameters;
mod perimeter;
mod recorded;
mod redraw;
mod rooms;
mod rules;
mod search;
mod selection;
pub mod senses;
mod stream;

pub use aim::Aim;
pub use belief::Belief;
pub use memo::SearchMemo;
pub use mind::Mind;
pub use parameters::PublishedParameters;
pub use redraw::Redraw;
pub use rooms::Rooms;
pub use stream::RandomNumbers;
