//! A player's WebSocket.

use super::{
    NoSeat, Rooms, lock,
    task::{Command, Line},
};
use crate::{limits::Bucket, places::Guest};
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, close_code};
use core::time::Duration;
use futures_util::{SinkExt as _, StreamExt as _, stream::SplitSink};
use phase_game::{FromPlayer, ToPlayer};
use phase_model::json::parse_as;
use serde::Deserialize;
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};
use tokio::{
    sync::mpsc,
    time::{Instant, interval, sleep_until, timeout},
};

/// Largest message of a player (bytes).
pub(super) const LARGEST_MESSAGE: usize = 512;
/// Size of a piece that is read or written (bytes).
pub(super) const BUFFER: usize = 4 * 1024;
/// Most that may wait to be taken by a page (bytes): some steps.
pub(super) const LARGEST_BACKLOG: usize = 256 * 1024;
/// Messages that wait for a player at most: some seconds of a game.
const OUTBOX: usize = 64;
/// Time in which a page has to say who it is.
const INTRODUCTION_TIME: Duration = Duration::from_secs(10);
/// Time in which a page has to take a message, and a room one of a player.
const SENDING_TIME: Duration = Duration::from_secs(10);
/// Time between questions whether a player is still there.
const PING: Duration = Duration::from_secs(5);
/// A player that answers none for so long is gone. Other messages do not count: who only writes may have
/// ceased to read.
const SILENCE: Duration = Duration::from_secs(15);
/// Messages at once and messages a second: keys of somebody who plays fast. Pings and the like are messages.
const MESSAGES: (f64, f64) = (60.0, 30.0);
/// So many messages too many, and the connection is closed.
const TOO_MANY: u32 = 200;
/// Time between two changes of whether a player looks elsewhere, each of which stops or starts the game for
/// the other one. The last one counts.
const AWAY_PACE: Duration = Duration::from_millis(500);

/// The code with which a connection is closed in favour of another one (of those left to applications, RFC
/// 6455, 7.4.2).
const ANOTHER_CONNECTION: u16 = 4001;

/// The first message of a page.
#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
enum Introduction {
    Join { token: String },
}

/// Lets a page play whose first message has a token. `stranger` is its place until then.
pub(super) async fn play(rooms: Arc<Rooms>, mut socket: WebSocket, stranger: Guest) {
    let mut stopping = rooms.stopping();
    let introduced = async {
        loop {
            match socket.recv().await? {
                Ok(Message::Text(text)) => {
                    let Introduction::Join { token } = parse_as(&text).ok()?;
                    return Some(token);
                }
                // A library may ping at once; the answer is given elsewhere.
                Ok(Message::Ping(_) | Message::Pong(_)) => {}
                Ok(Message::Binary(_) | Message::Close(_)) | Err(_) => return None,
            }
        }
    };
    let token = tokio::select! {
        token = timeout(INTRODUCTION_TIME, introduced) => token.ok().flatten(),
        () = stranger.asked_to_leave() => return,
        _ = stopping.changed() => return,
    };
    let seat = match token {
        Some(token) => tokio::select! {
            seat = rooms.seat(&token) => seat,
            _ = stopping.changed() => return,
        },
        None => Err(NoSeat::Unknown),
    };
    let (inbox, status, agent) = match seat {
        Ok(seat) => seat,
        Err(error) => {
            let (code, reason) = match error {
                NoSeat::Unknown => (close_code::POLICY, "there is no such game; it may be over"),
                NoSeat::TooOften => (close_code::AGAIN, "the player has come too often"),
            };
            let frame = CloseFrame { code, reason: Utf8Bytes::from_static(reason) };
            // Whoever is gone already need not be told.
            let _ = timeout(SENDING_TIME, socket.send(Message::Close(Some(frame)))).await;
            return;
        }
    };
    drop(stranger);
    let connection = rooms.connection();
    let (out, mut outbox) = mpsc::channel::<Utf8Bytes>(OUTBOX);
    let replaced = Arc::new(AtomicBool::new(false));
    let line = Line { connection, out, replaced: Arc::clone(&replaced) };
    // A room that is still being replayed takes it later.
    if inbox.try_send(Command::Connect { agent, line }).is_err() {
        return;
    }
    let (mut sink, mut stream) = socket.split();
    let mut ping = interval(PING);
    let begun = Instant::now();
    let mut answered = begun;
    let mut bucket = Bucket::new(MESSAGES.0, MESSAGES.1, begun.into_std());
    let mut too_many = 0;
    let mut away = None;
    let mut away_due = begun;
    let mut closing = None;
    loop {
        let command = tokio::select! {
            message = outbox.recv() => {
                // The room drops its end when another page of the same player has come, when this one does
                // not keep up, and when the game is over.
                let Some(text) = message else {
                    if replaced.load(Ordering::Relaxed) {
                        let reason = Utf8Bytes::from_static("the player has come by another connection");
                        closing = Some(CloseFrame { code: ANOTHER_CONNECTION, reason });
                    }
                    break;
                };
                if !tell(&mut sink, Message::Text(text)).await { break }
                continue;
            }
            message = stream.next() => {
                let text = match message {
                    Some(Ok(Message::Text(text))) => Some(text),
                    Some(Ok(Message::Pong(sent))) => {
                        if let Some(trip) = round_trip(&sent, begun.elapsed()) {
                            answered = Instant::now();
                            lock(&status).round_trip_ms[agent] = u32::try_from(trip).ok();
                        }
                        None
                    }
                    Some(Ok(Message::Ping(_))) => None,
                    Some(Ok(Message::Binary(_) | Message::Close(_)) | Err(_)) | None => break,
                };
                if !bucket.take(Instant::now().into_std()) {
                    too_many += 1;
                    if too_many > TOO_MANY { break }
                    continue;
                }
                match text.map(|text| FromPlayer::parse(&text)) {
                    None => continue,
                    Some(Ok(FromPlayer::Away(wish))) => {
                        away = Some(wish);
                        continue;
                    }
                    Some(Ok(message)) => Command::Message { agent, connection, message },
                    Some(Err(error)) => {
                        let problem = ToPlayer::Problem { text: error.to_string() };
                        let text = serde_json::to_string(&problem).unwrap_or_default();
                        if !tell(&mut sink, Message::Text(text.into())).await { break }
                        continue;
                    }
                }
            }
            () = sleep_until(away_due), if away.is_some() => {
                away_due = Instant::now() + AWAY_PACE;
                let message = FromPlayer::Away(away.take().unwrap_or_default());
                Command::Message { agent, connection, message }
            }
            _ = ping.tick() => {
                if answered.elapsed() > SILENCE { break }
                let sent = (begun.elapsed().as_millis() as u64).to_be_bytes().to_vec();
                if !tell(&mut sink, Message::Ping(sent.into())).await { break }
                continue;
            }
            _ = stopping.changed() => break,
        };
        if !matches!(timeout(SENDING_TIME, inbox.send(command)).await, Ok(Ok(()))) {
            break;
        }
    }
    // If the room is over, there is nobody to tell.
    let _ = inbox.send(Command::Disconnect { agent, connection }).await;
    tell(&mut sink, Message::Close(closing)).await;
}

/// Sends a message. Whether the page has taken it, or will: one that takes nothing for long is gone.
async fn tell(sink: &mut SplitSink<WebSocket, Message>, message: Message) -> bool {
    matches!(timeout(SENDING_TIME, sink.send(message)).await, Ok(Ok(())))
}

/// Time since a ping was sent (ms), of its answer; `None` if no ping had this text.
fn round_trip(sent: &[u8], passed: Duration) -> Option<u64> {
    (passed.as_millis() as u64).checked_sub(u64::from_be_bytes(sent.try_into().ok()?))
}
