//! A player's WebSocket.

use super::{Rooms, lock, task::Command};
use crate::limits::Bucket;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, close_code};
use core::time::Duration;
use futures_util::{SinkExt as _, StreamExt as _};
use phase_game::{Doing, FromPlayer, ToPlayer};
use serde::Deserialize;
use std::{sync::Arc, time::Instant};
use tokio::{
    sync::mpsc,
    time::{interval, timeout},
};

/// Largest message of a player (bytes).
pub(super) const LARGEST_MESSAGE: usize = 512;
/// Messages that wait for a player at most: four seconds of a game.
const OUTBOX: usize = 32;
/// Time in which a page has to say who it is.
const INTRODUCTION_TIME: Duration = Duration::from_secs(10);
/// Time between questions whether a player is still there.
const PING: Duration = Duration::from_secs(5);
/// A player that answers none for so long is gone.
const SILENCE: Duration = Duration::from_secs(15);
/// Messages at once and messages a second: keys of somebody who plays fast.
const MESSAGES: (f64, f64) = (60.0, 30.0);
/// So many messages too many, and the connection is closed.
const TOO_MANY: u32 = 200;

/// The code with which a connection is closed in favour of another one (of those left to applications, RFC
/// 6455, 7.4.2).
const ANOTHER_CONNECTION: u16 = 4001;

/// The first message of a page.
#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
enum Introduction {
    Join { token: String },
}

/// Lets a page play whose first message has a token.
pub(super) async fn play(rooms: Arc<Rooms>, mut socket: WebSocket) {
    let token = match timeout(INTRODUCTION_TIME, socket.recv()).await {
        Ok(Some(Ok(Message::Text(text)))) => {
            serde_json::from_str(&text).ok().map(|Introduction::Join { token }| token)
        }
        _ => None,
    };
    let Some((inbox, status, agent)) = token.and_then(|token| rooms.seat(&token)) else {
        let reason = Utf8Bytes::from_static("there is no such game; it may be over");
        // Whoever is gone already need not be told.
        let _ = socket.send(Message::Close(Some(CloseFrame { code: close_code::POLICY, reason }))).await;
        return;
    };
    let connection = rooms.connection();
    let (out, mut outbox) = mpsc::channel::<Utf8Bytes>(OUTBOX);
    if inbox.send(Command::Connect { agent, connection, out }).await.is_err() {
        return;
    }
    let (mut sink, mut stream) = socket.split();
    let mut stopping = rooms.stopping();
    let mut ping = interval(PING);
    let begun = Instant::now();
    let mut heard = begun;
    let mut bucket = Bucket::new(MESSAGES.0, MESSAGES.1, begun);
    let mut too_many = 0;
    let mut closing = None;
    loop {
        tokio::select! {
            message = outbox.recv() => {
                // The room drops its end when another page of the same player has come, or the game is over.
                let Some(text) = message else {
                    if lock(&status).doing != Doing::Over {
                        let reason = Utf8Bytes::from_static("the player has come by another connection");
                        closing = Some(CloseFrame { code: ANOTHER_CONNECTION, reason });
                    }
                    break;
                };
                if sink.send(Message::Text(text)).await.is_err() { break }
            }
            message = stream.next() => {
                let now = Instant::now();
                heard = now;
                let text = match message {
                    Some(Ok(Message::Text(text))) => text,
                    Some(Ok(Message::Pong(sent))) => {
                        if let Ok(sent) = <[u8; 8]>::try_from(&sent[..]) {
                            let passed = begun.elapsed().as_millis() as u64;
                            let trip = passed.saturating_sub(u64::from_be_bytes(sent));
                            lock(&status).round_trip_ms[agent] = u32::try_from(trip).ok();
                        }
                        continue;
                    }
                    Some(Ok(Message::Ping(_))) => continue,
                    Some(Ok(Message::Binary(_) | Message::Close(_)) | Err(_)) | None => break,
                };
                if !bucket.take(now) {
                    too_many += 1;
                    if too_many > TOO_MANY { break }
                    continue;
                }
                match FromPlayer::parse(&text) {
                    Ok(message) => {
                        let command = Command::Message { agent, connection, message };
                        if inbox.send(command).await.is_err() { break }
                    }
                    Err(error) => {
                        let problem = ToPlayer::Problem { text: error.to_string() };
                        let text = serde_json::to_string(&problem).unwrap_or_default();
                        if sink.send(Message::Text(text.into())).await.is_err() { break }
                    }
                }
            }
            _ = ping.tick() => {
                if heard.elapsed() > SILENCE { break }
                let sent = (begun.elapsed().as_millis() as u64).to_be_bytes().to_vec();
                if sink.send(Message::Ping(sent.into())).await.is_err() { break }
            }
            _ = stopping.changed() => break,
        }
    }
    // If the room is over, there is nobody to tell.
    let _ = inbox.send(Command::Disconnect { agent, connection }).await;
    let _ = sink.send(Message::Close(closing)).await;
}
