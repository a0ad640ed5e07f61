//! The server of PHASE: the [playground](phase_web::playground), the two-player game of `phase-game`, the
//! rating studies of `phase-study`, and the admin page.
//!
//! [`Server::bind`] listens, [`Server::run`] serves until it is told to stop. What is kept is in one folder:
//! `rooms/`, a journal for each game, `events/`, the recordings, and `studies/`, the answers of raters. A
//! server that was killed goes on with its games when it is started again.
//!
//! Key design decision: the server is a thin layer over state machines that know no sockets. Each game is one
//! task, which owns its room and is told everything through one queue, so nothing is shared and nothing is
//! locked while a game steps. The trade-off is that all players of a game wait while its mind thinks; they do
//! so between steps, when there is nothing else to do.
//!
//! ```no_run
//! use phase_game::{GameSettings, playlist::Item};
//! use phase_serve::{Server, ServerSettings};
//!
//! let scene = phase_sampler::sample_named(Some("helping"), None, 1)?;
//! let settings = ServerSettings {
//!     listen: ([127, 0, 0, 1], 8017).into(),
//!     host: None,
//!     behind_proxy: false,
//!     folder: "out/serve".into(),
//!     rooms: 200,
//!     mind_rooms: 20,
//!     open: true,
//!     rounds: 5,
//!     game: GameSettings::default(),
//!     seed: 1,
//!     only_studies: false,
//! };
//! let item = Item { source: "mine".into(), scene };
//! let server = Server::bind(settings, item.clone(), vec![item], None)?;
//! println!("http://{} (admin token: {})", server.address(), server.admin_token());
//! server.run(std::future::pending())?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod admin;
mod assets;
mod connections;
mod error;
mod headers;
mod limits;
mod log;
mod places;
mod rooms;
mod server;
mod settings;
mod study;
mod token;

pub use error::ServeError;
pub use server::Server;
pub use settings::ServerSettings;

use assets::Assets;
use limits::{AtOnce, PerAddress};
use places::Places;
use rooms::Rooms;
use std::sync::Arc;
use study::Studies;

/// The state that all requests share.
pub(crate) struct App {
    settings: ServerSettings,
    /// The digest of the admin token, see [`token::kept`].
    admin: String,
    assets: Assets,
    rooms: Arc<Rooms>,
    /// Sockets that have not said which player they belong to.
    strangers: Arc<Places>,
    /// Requests of an address.
    requests: PerAddress,
    /// Requests of an address that are being answered.
    answering: AtOnce,
    /// Rooms opened from an address.
    openings: PerAddress,
    studies: Studies,
    /// Raters who came from an address.
    joinings: PerAddress,
}
