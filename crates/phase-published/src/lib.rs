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
//! Senses, rules, rewards, selection, belief updates, imagined steps and searches are compared with outputs
//! of the original (tests/oracle). Its random numbers can be had ([`RandomNumbers::Original`]), and with them
//! its decisions repeat: same visits of every action, same values.
//!
//! Differences from the original that are meant:
//!
//! - A reflected scene is thought about as it is, with actions and rooms named as before reflection.
//! - Where the original crashes or divides by zero, something sensible is done: a helper that should release
//!   what it holds does so, and once every cell has been seen, unseen bodies are put wherever the agent does
//!   not look.
//! - A grip ends when either side of it is redrawn; in the original only when the agent is.
//! - Either agent may help or hinder; in the original only the first can.
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
//! let parameters = PublishedParameters { particles: 5, simulations: 100, ..PublishedParameters::default() };
//! let seen = observe(&physics, &state, own);
//! let belief = Belief::new(scene.layout, &physics, &parameters, &seen, Some(&state), &mut random);
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
pub mod policy;
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
pub use mind::{Consideration, Mind};
pub use parameters::PublishedParameters;
pub use policy::PolicyNetwork;
pub use redraw::Redraw;
pub use rooms::Rooms;
pub use stream::RandomNumbers;
