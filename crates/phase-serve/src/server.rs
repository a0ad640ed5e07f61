//! From settings to a server that answers.

use crate::{
    App, ServeError, ServerSettings, admin,
    assets::{self, Assets},
    connections, headers,
    limits::{AtOnce, PerAddress},
    places::Places,
    rooms::{self, Rooms},
    study::{self, Studies},
    token,
};
use axum::{Router, body::Bytes, middleware};
use phase_files::folder::Lock;
use phase_game::playlist::Item;
use std::{
    future::{Future, poll_fn},
    net::{SocketAddr, TcpListener},
    path::PathBuf,
    pin::pin,
    sync::Arc,
    task::Poll,
    time::Duration,
};
use tokio::{runtime::Runtime, sync::watch};

/// Requests of an address at once, and then a second. A page loads a few dozen files.
const REQUESTS: (f64, f64) = (400.0, 200.0);
/// Rooms opened from an address at once, and then a second.
const OPENINGS: (f64, f64) = (30.0, 0.5);
/// Raters who come from an address at once, and then a second. A class may sit behind one.
const JOININGS: (f64, f64) = (300.0, 5.0);
/// Requests of an address that are answered at the same time.
const ANSWERING: usize = 40;
/// Sockets that have not said which player they belong to: in all, and of one address.
const STRANGERS: (usize, usize) = (64, 16);
/// Time in which what is being written has to end when the server stops.
const PATIENCE: Duration = Duration::from_secs(5);

/// A server that listens.
pub struct Server {
    app: App,
    runtime: Background,
    listener: tokio::net::TcpListener,
    address: SocketAddr,
    admin: String,
    stop: watch::Sender<bool>,
    // Held while it serves.
    lock: Lock,
}

/// A runtime that ends without waiting: a game that is being replayed is replayed again some day.
struct Background(Option<Runtime>);

impl Drop for Background {
    fn drop(&mut self) {
        if let Some(runtime) = self.0.take() {
            runtime.shutdown_background();
        }
    }
}

impl core::fmt::Debug for Server {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.debug_struct("Server").field("address", &self.address).finish_non_exhaustive()
    }
}

impl Server {
    /// Listens, and takes up the games in the settings' folder. `practice` comes before the rounds of each
    /// new game, which are drawn from `scenes`; `wasm` is the playground's WebAssembly, in the order of
    /// [`phase_web::WASM`].
    ///
    /// # Errors
    /// [`ServeError`].
    pub fn bind(
        settings: ServerSettings,
        practice: Item,
        scenes: Vec<Item>,
        wasm: Option<[&[u8]; 2]>,
    ) -> Result<Self, ServeError> {
        // Two servers would both go on with the same games.
        let lock = Lock::take_private(&settings.folder)?;
        let runtime =
            tokio::runtime::Builder::new_multi_thread().enable_all().build().map_err(ServeError::Runtime)?;
        let failed = |source| ServeError::Listen { address: settings.listen, source };
        let listener = TcpListener::bind(settings.listen).map_err(failed)?;
        listener.set_nonblocking(true).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let (stop, stopped) = watch::channel(false);
        let _entered = runtime.enter();
        let listener = tokio::net::TcpListener::from_std(listener).map_err(failed)?;
        let admin = token::new()?;
        let app = App {
            rooms: Rooms::open(settings.clone(), practice, scenes, stopped)?,
            assets: assets(wasm, settings.only_studies),
            admin: token::kept(&admin),
            strangers: Arc::new(Places::new(STRANGERS.0, STRANGERS.1)),
            requests: PerAddress::new(REQUESTS.0, REQUESTS.1),
            answering: AtOnce::new(ANSWERING),
            openings: PerAddress::new(OPENINGS.0, OPENINGS.1),
            studies: Studies::default(),
            joinings: PerAddress::new(JOININGS.0, JOININGS.1),
            settings,
        };
        drop(_entered);
        let runtime = Background(Some(runtime));
        Ok(Self { app, runtime, listener, address, admin, stop, lock })
    }

    /// Opens rating studies, each a file of the format `phase-study/1`; their answers are in `studies/` in
    /// the settings' folder.
    ///
    /// # Errors
    /// [`ServeError`] if a configuration, its videos or its answers cannot be used, or two studies have the
    /// same name.
    pub fn open_studies(&mut self, configurations: &[PathBuf]) -> Result<(), ServeError> {
        self.app.studies = Studies::open(configurations, &self.app.settings.folder.join("studies"))?;
        Ok(())
    }

    /// The names of its studies, each of which has the page `/study/NAME/`.
    pub fn studies(&self) -> impl Iterator<Item = &str> {
        self.app.studies.names()
    }

    /// Address at which the server listens.
    #[must_use]
    pub const fn address(&self) -> SocketAddr {
        self.address
    }

    /// The token of the person in charge, which `/admin/` asks for.
    #[must_use]
    pub fn admin_token(&self) -> &str {
        &self.admin
    }

    /// Serves until `until` is done. Games stop where they are; their journals are complete.
    ///
    /// # Errors
    /// [`ServeError::Runtime`].
    pub fn run(self, until: impl Future<Output = ()> + Send + 'static) -> Result<(), ServeError> {
        let Self { app, mut runtime, listener, stop, lock: _lock, .. } = self;
        // It is there until it is taken here.
        let Some(runtime) = runtime.0.take() else { return Ok(()) };
        let behind_proxy = app.settings.behind_proxy;
        let router = router(Arc::new(app));
        runtime.block_on(async move {
            let stopped = stop.subscribe();
            let mut until = pin!(until);
            // What it waits for, such as a signal, is listened for before anybody is answered.
            if poll_fn(|context| Poll::Ready(until.as_mut().poll(context).is_ready())).await {
                return;
            }
            let stopping = async move {
                until.await;
                // Nobody may be listening any more.
                let _ = stop.send(true);
            };
            let serving = connections::serve(listener, router, behind_proxy, stopped);
            tokio::join!(serving, stopping);
        });
        runtime.shutdown_timeout(PATIENCE);
        Ok(())
    }
}

/// All routes.
fn router(app: Arc<App>) -> Router {
    let games = if app.settings.only_studies { Router::new() } else { rooms::routes() };
    Router::new()
        .merge(games)
        .merge(admin::routes())
        .merge(study::routes())
        .fallback(assets::file)
        .layer(middleware::from_fn_with_state(Arc::clone(&app), headers::guard))
        .with_state(app)
}

/// The pages by path; those of studies and the admin page alone, if nothing else is served.
fn assets(wasm: Option<[&[u8]; 2]>, only_studies: bool) -> Assets {
    let mut assets = Assets::default();
    let belongs = |path: &str| {
        !only_studies || path == "site.css" || path.starts_with("study/") || path.starts_with("admin/")
    };
    for file in phase_web::site().filter(|file| belongs(file.path)) {
        assets.add(format!("/{}", file.path), Bytes::from_static(file.bytes));
    }
    match wasm {
        _ if only_studies => {}
        Some(wasm) => {
            for file in phase_web::playground(wasm) {
                assets.add(format!("/playground/{}", file.path), Bytes::copy_from_slice(file.bytes));
            }
        }
        None => assets.add("/playground/index.html".into(), Bytes::from_static(phase_web::NO_PLAYGROUND)),
    }
    assets
}
