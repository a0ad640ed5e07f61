//! The interface of a study's page: `/study/<name>/api/…`.
//!
//! Bodies and answers are JSON. A rater shows who it is by `Authorization: Bearer <token>`; every answer but
//! that of `join` is what it sees next.

use super::{Running, new_token, now};
use crate::{
    App,
    error::ApiError,
    headers::{Client, same_origin},
};
use axum::{
    Extension, Json, Router,
    body::Bytes,
    extract::{Path, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Redirect, Response},
    routing::{get, post},
};
use phase_model::json::{Field, parse};
use phase_study::study::{Stage, Study, StudyError, Token};
use serde_json::{Value, json};
use std::{collections::BTreeMap, sync::Arc, time::Instant};

/// Most members of an address that are looked at.
const MOST_PARAMETERS: usize = 100;

type Answer = Result<Json<Stage>, ApiError>;

pub(super) fn routes() -> Router<Arc<App>> {
    Router::new()
        .route("/study/{study}", get(folder))
        .route("/study/{study}/", get(page))
        .route("/study/{study}/api/join", post(join))
        .route("/study/{study}/api/state", get(state))
        .route("/study/{study}/api/consent", post(consent))
        .route("/study/{study}/api/demographics", post(demographics))
        .route("/study/{study}/api/instructions", post(instructions))
        .route("/study/{study}/api/answer", post(answer))
        .route("/study/{study}/api/withdraw", post(withdraw))
}

/// The studies: `{"studies": [{"name", "title"}…]}`.
/// A server of studies alone does not list them, so that raters find nothing but their own.
pub(super) async fn list(State(app): State<Arc<App>>) -> Result<Json<Value>, ApiError> {
    if app.settings.only_studies {
        return Err(ApiError::missing());
    }
    let all = app.studies.0.values().map(|running| json!({ "name": running.name, "title": running.title }));
    Ok(Json(json!({ "studies": all.collect::<Vec<_>>() })))
}

/// Without the last stroke, so that the relative links of the page are right. What came with the address goes
/// on with it.
async fn folder(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    uri: axum::http::Uri,
    request: axum::extract::Request,
) -> Result<Response, ApiError> {
    if app.studies.get(&study).is_err() {
        // A file that all studies share, such as study.js.
        return Ok(crate::assets::file(State(app), request).await);
    }
    let query = uri.query().map_or_else(String::new, |query| format!("?{query}"));
    Ok(Redirect::permanent(&format!("/study/{study}/{query}")).into_response())
}

async fn page(State(app): State<Arc<App>>, Path(study): Path<String>) -> Result<Response, ApiError> {
    app.studies.get(&study)?;
    let kind = HeaderValue::from_static("text/html; charset=utf-8");
    Ok(([(header::CONTENT_TYPE, kind)], Bytes::from_static(phase_web::STUDY_PAGE)).into_response())
}

/// Lets a rater in: `{"parameters": {name: value…}}`; answers with `token` and `stage`.
async fn join(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    Extension(Client(address)): Extension<Client>,
    headers: HeaderMap,
    body: Bytes,
) -> Result<Json<Value>, ApiError> {
    let running = app.studies.get(&study)?;
    own_page(&headers)?;
    if !app.joinings.take(address, Instant::now()) {
        let sentence = "too many people came from here at once; wait a minute";
        return Err(ApiError::new(StatusCode::TOO_MANY_REQUESTS, sentence));
    }
    let document = document(&body)?;
    let parameters = parameters(&document).map_err(|error| ApiError::bad(error.to_string()))?;
    let token = new_token()?;
    let joined = running.with(move |study| study.join(&parameters, now(), token)).await?;
    Ok(Json(json!({ "token": joined.token, "stage": joined.stage })))
}

fn parameters(document: &Value) -> Result<BTreeMap<String, String>, phase_model::json::FieldError> {
    let root = Field::root(document);
    root.only(&["parameters"])?;
    let field = root.required("parameters")?;
    let Some(members) = field.value().as_object().filter(|members| members.len() <= MOST_PARAMETERS) else {
        return Err(field.error(format!("must be an object with at most {MOST_PARAMETERS} members")));
    };
    // Any text may be a name here: what the study does not keep is ignored.
    let text = |(name, value): (&String, &Value)| {
        let value = value.as_str().ok_or_else(|| field.error("must have texts as members"))?;
        Ok((name.clone(), value.to_owned()))
    };
    members.iter().map(text).collect()
}

async fn state(State(app): State<Arc<App>>, Path(study): Path<String>, headers: HeaderMap) -> Answer {
    let running = app.studies.get(&study)?;
    let token = token(&headers)?;
    Ok(Json(running.with(move |study| study.stage(&token)).await?))
}

/// `{"agrees": true}`.
async fn consent(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    headers: HeaderMap,
    body: Bytes,
) -> Answer {
    post_with(&app, &study, &headers, &body, |study, token, document| {
        let root = Field::root(&document);
        root.only(&["agrees"])?;
        let agrees = root.required("agrees")?;
        let truth = agrees.value().as_bool().ok_or_else(|| agrees.must_be("true or false"))?;
        study.consent(&token, truth, now())
    })
    .await
}

/// An object with a member for each question.
async fn demographics(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    headers: HeaderMap,
    body: Bytes,
) -> Answer {
    post_with(&app, &study, &headers, &body, |study, token, document| {
        study.demographics(&token, &document, now())
    })
    .await
}

/// `{}`.
async fn instructions(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    headers: HeaderMap,
    body: Bytes,
) -> Answer {
    post_with(&app, &study, &headers, &body, |study, token, document| {
        Field::root(&document).only(&[])?;
        study.instructed(&token, now())
    })
    .await
}

/// `{"trial", "answer", "response_time", "plays"}`, see [`Study::answer`].
async fn answer(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    headers: HeaderMap,
    body: Bytes,
) -> Answer {
    post_with(&app, &study, &headers, &body, |study, token, document| study.answer(&token, &document, now()))
        .await
}

/// `{}`.
async fn withdraw(
    State(app): State<Arc<App>>,
    Path(study): Path<String>,
    headers: HeaderMap,
    body: Bytes,
) -> Answer {
    post_with(&app, &study, &headers, &body, |study, token, document| {
        Field::root(&document).only(&[])?;
        study.withdraw(&token, now())
    })
    .await
}

async fn post_with(
    app: &App,
    study: &str,
    headers: &HeaderMap,
    body: &Bytes,
    action: impl FnOnce(&mut Study, Token, Value) -> Result<Stage, StudyError> + Send + 'static,
) -> Answer {
    let running: Arc<Running> = app.studies.get(study)?;
    own_page(headers)?;
    let token = token(headers)?;
    let document = document(body)?;
    Ok(Json(running.with(move |study| action(study, token, document)).await?))
}

fn own_page(headers: &HeaderMap) -> Result<(), ApiError> {
    let refused = || ApiError::new(StatusCode::FORBIDDEN, "pages of other sites take no part in studies");
    if same_origin(headers) { Ok(()) } else { Err(refused()) }
}

fn document(body: &Bytes) -> Result<Value, ApiError> {
    parse(body).map_err(|error| ApiError::bad(format!("what was sent {error}")))
}

fn token(headers: &HeaderMap) -> Result<Token, ApiError> {
    let given = headers.get(header::AUTHORIZATION).and_then(|value| value.to_str().ok());
    let token = given.and_then(|value| value.strip_prefix("Bearer ")).and_then(Token::parse);
    token.ok_or_else(|| ApiError::new(StatusCode::UNAUTHORIZED, StudyError::Token.to_string()))
}
