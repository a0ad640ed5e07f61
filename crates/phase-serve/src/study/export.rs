//! Studies as the person in charge sees them: `/admin/api/studies…`.

use super::Running;
use crate::{App, admin, error::ApiError};
use axum::{
    Json, Router,
    extract::{Path, RawQuery, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
    routing::get,
};
use phase_study::{
    analysis::{Analysis, document},
    config::StudyConfig,
    export::{psych_ds, ratings},
    forms::Forms,
    record::Rater,
};
use serde_json::{Value, json};
use std::{io, sync::Arc};
use tar::{Builder, Header};

pub(super) fn routes() -> Router<Arc<App>> {
    Router::new()
        .route("/admin/api/studies", get(progress))
        .route("/admin/api/studies/{study}/{file}", get(file))
}

/// Answers with the progress of all studies.
async fn progress(State(app): State<Arc<App>>, headers: HeaderMap) -> Result<Json<Value>, ApiError> {
    admin::check(&app, &headers)?;
    let mut all = Vec::new();
    for running in app.studies.0.values() {
        all.push(
            computed(running, |config, _, raters| {
                Ok(json!({
                    "name": config.name, "form": config.form.name(), "title": config.title,
                    "raters": phase_study::analysis::count(config, raters),
                    "wanted": config.raters, "coverage": phase_study::analysis::coverage(config, raters),
                    "raters_per_video": config.raters_per_video,
                }))
            })
            .await?,
        );
    }
    Ok(Json(json!({ "studies": all })))
}

/// A file of a study: `psych-ds.tar` (with `?external_ids` also with what raters came), `ratings.json`,
/// `report.html` or `analysis.json`.
async fn file(
    State(app): State<Arc<App>>,
    headers: HeaderMap,
    Path((study, file)): Path<(String, String)>,
    RawQuery(query): RawQuery,
) -> Result<Response, ApiError> {
    admin::check(&app, &headers)?;
    let running = app.studies.get(&study)?;
    let external_ids = query.as_deref() == Some("external_ids");
    let (kind, bytes) = match file.as_str() {
        "psych-ds.tar" => {
            let made =
                computed(&running, move |config, forms, raters| tar(config, forms, raters, external_ids));
            ("application/x-tar", made.await?)
        }
        "ratings.json" => {
            let made = computed(&running, |config, _, raters| Ok(ratings(config, raters))).await?;
            let sentence = "this study does not ask for relations";
            let made = made.ok_or_else(|| ApiError::new(StatusCode::NOT_FOUND, sentence))?;
            ("application/json", format!("{made:#}\n").into_bytes())
        }
        "report.html" => {
            let made = computed(&running, |config, forms, raters| {
                Ok(document(&config.title, &Analysis::of(config, forms, raters)).to_html())
            });
            ("text/html; charset=utf-8", made.await?.into_bytes())
        }
        "analysis.json" => {
            let made = computed(&running, |config, forms, raters| {
                serde_json::to_vec_pretty(&Analysis::of(config, forms, raters))
                    .map_err(|error| ApiError::failed(&error))
            });
            ("application/json", made.await?)
        }
        _ => return Err(ApiError::missing()),
    };
    let name = HeaderValue::try_from(format!("attachment; filename=\"{study}-{file}\""));
    let name = name.unwrap_or(HeaderValue::from_static("attachment"));
    let headers =
        [(header::CONTENT_TYPE, HeaderValue::from_static(kind)), (header::CONTENT_DISPOSITION, name)];
    Ok((headers, bytes).into_response())
}

/// Computes something of the raters, while others go on answering.
async fn computed<T: Send + 'static>(
    running: &Arc<Running>,
    compute: impl FnOnce(&StudyConfig, &Forms, &[Rater]) -> Result<T, ApiError> + Send + 'static,
) -> Result<T, ApiError> {
    let read = Arc::clone(running).with(|study| Ok((study.config().clone(), study.raters()?)));
    let (config, raters) = read.await?;
    let running = Arc::clone(running);
    let done = tokio::task::spawn_blocking(move || compute(&config, &running.forms, &raters));
    done.await.map_err(|error| ApiError::failed(&error))?
}

fn tar(
    config: &StudyConfig,
    forms: &Forms,
    raters: &[Rater],
    external_ids: bool,
) -> Result<Vec<u8>, ApiError> {
    let write = || -> io::Result<Vec<u8>> {
        let mut tar = Builder::new(Vec::new());
        for file in psych_ds(config, forms, raters, external_ids) {
            let mut header = Header::new_ustar();
            header.set_size(file.text.len() as u64);
            header.set_mode(0o644);
            header.set_mtime(0);
            tar.append_data(&mut header, format!("{}/{}", config.name, file.path), file.text.as_bytes())?;
        }
        tar.into_inner()
    };
    write().map_err(|error| ApiError::failed(&error))
}
