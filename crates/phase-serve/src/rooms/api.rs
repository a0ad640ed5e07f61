//! The interface of pages to rooms, over HTTP.

use super::{Rooms, Wish, socket};
use crate::{
    App, admin,
    error::ApiError,
    headers::{Client, same_origin},
};
use axum::{
    Extension, Json, Router,
    body::Bytes,
    extract::{State, WebSocketUpgrade},
    http::{HeaderMap, StatusCode},
    response::Response,
    routing::{any, get, post},
};
use phase_game::{Player, View};
use phase_model::{AgentId, json::parse_as};
use serde::Deserialize;
use serde_json::{Value, json};
use std::{sync::Arc, time::Instant};

/// `/api/rooms`, `/api/game` and `/play/socket`.
pub(crate) fn routes() -> Router<Arc<App>> {
    Router::new()
        .route("/api/rooms", post(create))
        .route("/api/game", get(describe))
        .route("/play/socket", any(connect))
}

/// The wish of who opens a room.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    /// The player of the other agent: a person or a mind.
    partner: Player,
    /// The part of the world that players see: their own agents' unless given.
    #[serde(default)]
    view: View,
    /// The agent of who asks, 0 or 1; by chance if absent.
    agent: Option<u8>,
}

/// Opens a room: `{"partner": "human", "view": "own", "agent": 0}`; answers with its name and the tokens by
/// agent, `null` for a mind.
async fn create(
    State(app): State<Arc<App>>,
    Extension(Client(address)): Extension<Client>,
    headers: HeaderMap,
    body: Bytes,
) -> Result<(StatusCode, Json<Value>), ApiError> {
    let in_charge = admin::check(&app, &headers);
    if !app.settings.open {
        in_charge.clone()?;
    }
    if !same_origin(&headers) {
        return Err(ApiError::new(StatusCode::FORBIDDEN, "pages of other sites open no rooms"));
    }
    if in_charge.is_err() && !app.openings.take(address, Instant::now()) {
        let sentence = "too many rooms were opened from here; wait a minute";
        return Err(ApiError::new(StatusCode::TOO_MANY_REQUESTS, sentence));
    }
    let wrong = |error: &dyn core::fmt::Display| ApiError::bad(format!("not a wish for a room: {error}"));
    let text = core::str::from_utf8(&body).map_err(|error| wrong(&error))?;
    let asked: Asked = parse_as(text).map_err(|error| wrong(&error))?;
    let own = match asked.agent {
        Some(0) => AgentId::ZERO,
        Some(1) => AgentId::ONE,
        Some(other) => return Err(ApiError::bad(format!("agent: must be 0 or 1, not {other}"))),
        None => AgentId::ALL[usize::from(crate::token::coin().map_err(|error| ApiError::failed(&error))?)],
    };
    let mut players = [asked.partner; 2];
    players[own] = Player::Human;
    let opener = in_charge.is_err().then_some(address);
    let opened = app.rooms.create(Wish { opener, players, view: asked.view }).await?;
    Ok((StatusCode::CREATED, Json(json!({ "room": opened.name, "agent": own, "tokens": opened.tokens }))))
}

/// Answers with all that the page of the game has to know before there is a room.
async fn describe(State(app): State<Arc<App>>) -> Json<Value> {
    Json(json!({ "open": app.settings.open, "rounds": app.settings.rounds.min(app.rooms.given().len()) }))
}

/// A player's socket; who it is comes in the first message, so that it is in no log.
async fn connect(
    State(app): State<Arc<App>>,
    Extension(Client(address)): Extension<Client>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Result<Response, ApiError> {
    if !same_origin(&headers) {
        return Err(ApiError::new(StatusCode::FORBIDDEN, "pages of other sites play no games"));
    }
    let stranger = app.strangers.enter(address);
    let rooms: Arc<Rooms> = Arc::clone(&app.rooms);
    let upgrade = upgrade
        .max_message_size(socket::LARGEST_MESSAGE)
        .max_frame_size(socket::LARGEST_MESSAGE)
        .read_buffer_size(socket::BUFFER)
        .write_buffer_size(socket::BUFFER)
        .max_write_buffer_size(socket::LARGEST_BACKLOG);
    Ok(upgrade.on_upgrade(async move |socket| socket::play(rooms, socket, stranger).await))
}
