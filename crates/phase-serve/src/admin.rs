//! The interface of the person in charge: `/admin/api/…`, with the token that the program prints when it
//! starts.

use crate::{App, error::ApiError, token};
use axum::{
    Json, Router,
    extract::{Path, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
    routing::{delete, get},
};
use phase_event::Recording;
use phase_files::{FileError, Problem, regular};
use phase_model::words::Names;
use serde_json::{Value, json};
use std::{fs, path::Path as FilePath, sync::Arc};

/// The routes of the admin page.
pub(crate) fn routes() -> Router<Arc<App>> {
    Router::new()
        .route("/admin/api/status", get(status))
        .route("/admin/api/rooms/{room}", delete(end))
        .route("/admin/api/events.json", get(events))
}

/// Whether a request comes from the person in charge: `Authorization: Bearer <token>`.
pub(crate) fn check(app: &App, headers: &HeaderMap) -> Result<(), ApiError> {
    let given = headers.get(header::AUTHORIZATION).and_then(|value| value.to_str().ok());
    let given = given.and_then(|value| value.strip_prefix("Bearer "));
    if given.is_some_and(|given| token::kept(given) == app.admin) {
        Ok(())
    } else {
        Err(ApiError::new(StatusCode::UNAUTHORIZED, "this needs the admin token"))
    }
}

async fn status(State(app): State<Arc<App>>, headers: HeaderMap) -> Result<Json<Value>, ApiError> {
    check(&app, &headers)?;
    let rooms: Vec<Value> = app.rooms.statuses().into_iter().map(|(_, status)| status).collect();
    let scenes: Vec<Value> = app
        .rooms
        .given()
        .into_iter()
        .map(|(source, given)| json!({ "source": source, "given": given }))
        .collect();
    let recordings = files(&app.rooms.events())?.len();
    Ok(Json(json!({
        "only_studies": app.settings.only_studies,
        "agents": Names::PAPER.agents,
        "rooms": rooms,
        "most_rooms": app.settings.rooms,
        "scenes": scenes,
        "recordings": recordings,
    })))
}

async fn end(
    State(app): State<Arc<App>>,
    headers: HeaderMap,
    Path(room): Path<String>,
) -> Result<StatusCode, ApiError> {
    check(&app, &headers)?;
    app.rooms.end(&room).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// All recordings as one file of `phase-events/1`.
async fn events(State(app): State<Arc<App>>, headers: HeaderMap) -> Result<Response, ApiError> {
    check(&app, &headers)?;
    let folder = app.rooms.events();
    let read = move || {
        let mut recordings: Vec<Recording> = Vec::new();
        for file in files(&folder)? {
            let bytes = regular::bytes(&file).map_err(|error| ApiError::failed(&error))?;
            let read = phase_event::parse(&bytes).map_err(|error| {
                ApiError::failed(&FileError { file: file.clone(), problem: Problem::content(error) })
            });
            recordings.extend(read?);
        }
        if recordings.is_empty() {
            return Err(ApiError::new(StatusCode::NOT_FOUND, "no round has been played to its end"));
        }
        phase_event::to_json(&recordings).map_err(|error| ApiError::failed(&error))
    };
    let text = tokio::task::spawn_blocking(read).await.map_err(|error| ApiError::failed(&error))??;
    let disposition = HeaderValue::from_static("attachment; filename=\"played-events.json\"");
    let headers = [
        (header::CONTENT_TYPE, HeaderValue::from_static("application/json")),
        (header::CONTENT_DISPOSITION, disposition),
    ];
    Ok((headers, text).into_response())
}

/// The recordings of a folder, by name.
fn files(folder: &FilePath) -> Result<Vec<std::path::PathBuf>, ApiError> {
    let listed = fs::read_dir(folder).and_then(|entries| {
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<std::io::Result<Vec<_>>>()
    });
    let mut files = listed.map_err(|error| ApiError::failed(&error))?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    Ok(files)
}
