//! Rating studies over HTTP: `/study/<name>/…`, and what the person in charge sees of them.

mod api;
mod export;
mod video;

use crate::error::{ApiError, ServeError};
use axum::{Router, routing::get};
use phase_files::{WriteError, private, regular};
use phase_study::{
    config::StudyConfig,
    forms::Forms,
    store::Store,
    study::{Study, StudyError, Token},
};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
    time::{SystemTime, UNIX_EPOCH},
};

/// The routes of studies.
pub(crate) fn routes() -> Router<Arc<crate::App>> {
    Router::new()
        .route("/api/studies", get(api::list))
        .merge(api::routes())
        .route("/study/{study}/videos/{video}", get(video::video))
        .merge(export::routes())
}

/// A study that is under way.
#[derive(Debug)]
pub(crate) struct Running {
    study: Mutex<Study>,
    forms: Forms,
    /// Files of the videos by their names in addresses.
    videos: BTreeMap<String, PathBuf>,
    name: String,
    title: String,
}

/// All studies of a server, by name.
#[derive(Debug, Default)]
pub(crate) struct Studies(BTreeMap<String, Arc<Running>>);

impl Studies {
    /// Opens studies with their answers in a folder. All of their videos must be there.
    pub(crate) fn open(configurations: &[PathBuf], folder: &Path) -> Result<Self, ServeError> {
        if !configurations.is_empty() {
            let failed =
                |source| WriteError { path: folder.to_owned(), action: "prepare the folder", source };
            private::take_folder(folder).map_err(failed)?;
        }
        let mut studies = BTreeMap::new();
        for file in configurations {
            let running = Running::open(file, folder)?;
            let name = running.name.clone();
            if studies.insert(name.clone(), Arc::new(running)).is_some() {
                let rule = format!("there is another study of the name {name:?}");
                return Err(ServeError::Study { file: file.clone(), rule });
            }
        }
        Ok(Self(studies))
    }

    /// Names of all, sorted.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// A study.
    fn get(&self, name: &str) -> Result<Arc<Running>, ApiError> {
        self.0.get(name).cloned().ok_or_else(ApiError::missing)
    }
}

impl Running {
    fn open(file: &Path, folder: &Path) -> Result<Self, ServeError> {
        let wrong = |rule: String| ServeError::Study { file: file.to_owned(), rule };
        let forms = Forms::included().map_err(|error| wrong(error.to_string()))?;
        let bytes = regular::bytes(file)?;
        let config = StudyConfig::read(&bytes, &forms).map_err(|error| wrong(error.to_string()))?;
        let base = file.parent().unwrap_or_else(|| Path::new("")).to_owned();
        if let Some((_, video)) = config.videos().find(|(_, video)| !base.join(video).is_file()) {
            return Err(wrong(format!("there is no video {}", base.join(video).display())));
        }
        let path = folder.join(format!("{}.sqlite", config.name));
        if path.exists() {
            // To open a pipe would wait for whoever reads it.
            regular::open(&path)?;
        }
        // What the database makes beside it has the same rights.
        let made = private::options().append(true).create(true).open(&path);
        made.map_err(|source| WriteError { path: path.clone(), action: "create", source })?;
        let store = Store::open(&path, &config.name, config.form.name())?;
        let name = config.name.clone();
        let title = config.title.clone();
        let study = Study::new(config, forms.clone(), store).map_err(|error| wrong(error.to_string()))?;
        let videos = study.addresses().map(|(name, file)| (name.to_owned(), base.join(file))).collect();
        Ok(Self { study: Mutex::new(study), forms, videos, name, title })
    }

    /// Does something with the study, on a thread that may wait for the disk.
    async fn with<T: Send + 'static>(
        self: Arc<Self>,
        action: impl FnOnce(&mut Study) -> Result<T, StudyError> + Send + 'static,
    ) -> Result<T, ApiError> {
        let done = tokio::task::spawn_blocking(move || {
            let mut study = self.study.lock().unwrap_or_else(PoisonError::into_inner);
            action(&mut study)
        });
        done.await.map_err(|error| ApiError::failed(&error))?.map_err(refusal)
    }
}

/// The answer over HTTP to a request that a study refuses.
fn refusal(error: StudyError) -> ApiError {
    use axum::http::StatusCode;
    match error {
        StudyError::Token => ApiError::new(StatusCode::UNAUTHORIZED, error.to_string()),
        StudyError::NotNow(_) | StudyError::OtherAnswer => {
            ApiError::new(StatusCode::CONFLICT, error.to_string())
        }
        StudyError::Field(error) => ApiError::bad(error.to_string()),
        StudyError::Store(_) => ApiError::failed(&error),
    }
}

/// Milliseconds since 1970-01-01 UTC.
fn now() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_millis()).unwrap_or(i64::MAX)
}

/// A new token.
fn new_token() -> Result<Token, ApiError> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| ApiError::failed(&error))?;
    Ok(Token::new(bytes))
}
