//! The two-player game of the paper (appendix, "Experiment 2"): people move the agents of a scene, each of
//! them seeing what its agent observes.
//!
//! A [`Room`] is one game: a practice, then rounds, one scene each. It is told who comes, leaves and presses
//! what ([`FromPlayer`]), and what time it is, and answers with [`Effect`]s: messages for the players
//! ([`ToPlayer`]), entries of a [`journal`], and recordings, which are events like all others, with
//! [`Controller::Human`](phase_event::Controller::Human).
//!
//! Key design decision: a room knows no sockets, no files and no clock. It is a state machine, tested without
//! waiting, and the authority: what players send are keys, and where bodies are is told to them, as far as
//! their agents observe it. The trade-off is that a key takes effect at the next step, up to a quarter of a
//! second later, as in the paper's game.
//!
//! One person plays with a mind, which needs no more than to be ready:
//!
//! ```
//! use core::time::Duration;
//! use phase_game::{Effect, FromPlayer, GameSettings, Player, Room, Round, ToPlayer};
//! use phase_model::AgentId;
//!
//! let scene = phase_sampler::sample_named(Some("helping"), None, 1)?;
//! let round = |id: &str| Round { id: id.into(), source: "helping".into(), scene: scene.clone(), seed: 1 };
//! let mut settings = GameSettings { players: [Player::Human, Player::Mind], ..GameSettings::default() };
//! settings.simulation.minds = settings.simulation.minds.with_simulations(10);
//! let mut room = Room::open("a", [None, None], settings, vec![round(""), round("first")], Duration::ZERO)?;
//!
//! let you = AgentId::ZERO;
//! room.connect(you, Duration::ZERO);
//! room.receive(you, FromPlayer::Ready, Duration::ZERO);
//! // After the countdown there are steps.
//! let mut now = Duration::ZERO;
//! let mut steps = 0;
//! while steps < 3 {
//!     now = room.due().unwrap_or(now);
//!     let effects = room.advance(now);
//!     let shown = |effect: &&Effect| matches!(effect, Effect::Send(_, ToPlayer::Sight(_)));
//!     steps += effects.iter().filter(shown).count();
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod controls;
mod instructions;
pub mod journal;
pub mod message;
pub mod playlist;
mod resume;
mod room;
mod settings;
mod sight;

pub use instructions::Instructions;
pub use journal::{Entry, JournalError, Round};
pub use message::{Doing, Ending, FromPlayer, MessageError, PROTOCOL, ToPlayer};
pub use playlist::Playlist;
pub use room::{Effect, Room, RoomError};
pub use settings::{GameSettings, LONGEST_TIME, MOST_STEPS, Player, STEP, SettingsError, View};
