//! People, who speak just enough HTTP and WebSocket.

use super::Wrong;
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    io::{self, Read, Write as _},
    net::{SocketAddr, TcpStream},
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
    thread,
    time::Duration,
};

/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(20);
/// Time between two answers of a rater. The server refuses who asks too often.
const BETWEEN: Duration = Duration::from_millis(20);
/// A mask of messages, which need not be random for a server that is ours.
const MASK: [u8; 4] = [1, 2, 3, 4];

/// Asks a server; `None` if it does not answer whole.
fn ask(
    address: SocketAddr,
    method: &str,
    path: &str,
    token: Option<&str>,
    body: &Value,
) -> Option<(u16, Value)> {
    let mut stream = TcpStream::connect(address).ok()?;
    stream.set_read_timeout(Some(PATIENCE)).ok()?;
    let body = if body.is_null() { String::new() } else { body.to_string() };
    let bearer = token.map(|token| format!("authorization: Bearer {token}\r\n")).unwrap_or_default();
    let length = body.len();
    let head = format!(
        "{method} {path} HTTP/1.1\r\nhost: {address}\r\nconnection: close\r\ncontent-length: {length}\r\n{bearer}"
    );
    stream.write_all(format!("{head}\r\n{body}").as_bytes()).ok()?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer).ok()?;
    let (head, body) = answer.split_once("\r\n\r\n")?;
    let status = head.split(' ').nth(1)?.parse().ok()?;
    // An answer that was cut off is none.
    Some((status, serde_json::from_str(body).ok()?))
}

/// A rater, and how many of its answers were acknowledged.
pub(super) struct Rater {
    token: Option<String>,
    /// Whether its consent was acknowledged, from which on it exists for the server.
    agreed: bool,
    acknowledged: u64,
}

impl Rater {
    /// Comes, and answers until the server does not.
    pub(super) fn take_part(address: SocketAddr, number: usize) -> Self {
        let mut rater = Self { token: None, agreed: false, acknowledged: 0 };
        let joined = json!({ "parameters": { "PROLIFIC_PID": format!("p{number}") } });
        let Some((200, joined)) = ask(address, "POST", "/study/torture/api/join", None, &joined) else {
            return rater;
        };
        rater.token = joined["token"].as_str().map(str::to_owned);
        for (what, body) in [("consent", json!({ "agrees": true })), ("instructions", json!({}))] {
            if rater.step(address, what, &body).is_none() {
                return rater;
            }
            rater.agreed = true;
        }
        while rater.answer(address, rater.acknowledged + 1).is_some() {
            rater.acknowledged += 1;
            thread::sleep(BETWEEN);
        }
        rater
    }

    fn step(&self, address: SocketAddr, what: &str, body: &Value) -> Option<Value> {
        let path = format!("/study/torture/api/{what}");
        let (status, stage) = ask(address, "POST", &path, Some(self.token.as_ref()?), body)?;
        (status == 200).then_some(stage)
    }

    fn answer(&self, address: SocketAddr, trial: u64) -> Option<Value> {
        let relation = ["friendly", "neutral", "adversarial"][trial as usize % 3];
        let body =
            json!({ "trial": trial, "answer": { "relation": relation }, "response_time": 1200, "plays": 1 });
        self.step(address, "answer", &body)
    }

    /// All answers that were acknowledged are there, and the next one is taken.
    pub(super) fn check(&self, address: SocketAddr) -> Result<(), Wrong> {
        let Some(token) = self.token.as_ref().filter(|_| self.agreed) else { return Ok(()) };
        let state = ask(address, "GET", "/study/torture/api/state", Some(token), &Value::Null);
        let Some((200, state)) = state else {
            return Err(format!("afterwards a rater is told {state:?}").into());
        };
        if self.acknowledged == 0 {
            return Ok(());
        }
        // One more may have been stored than the rater was told.
        let next = state["trial"].as_u64();
        let expected = [self.acknowledged + 1, self.acknowledged + 2].map(Some);
        if !expected.contains(&next) {
            return Err(
                format!("{} answers were acknowledged, and the next is {state}", self.acknowledged).into()
            );
        }
        match next.and_then(|trial| self.answer(address, trial)) {
            Some(_) => Ok(()),
            None => Err("afterwards no answer is taken".into()),
        }
    }
}

/// Somebody who plays with a mind, with the last step that was shown of each round.
pub(super) struct Player {
    room: String,
    token: String,
    shown: BTreeMap<u64, u64>,
    is_over: bool,
}

impl Player {
    /// Opens a room and plays until the server ends; `None` if there was no room.
    pub(super) fn play(address: SocketAddr, admin: &str, over: &AtomicBool) -> Option<Self> {
        let wish = json!({ "partner": "mind", "view": "all", "agent": 0 });
        let (201, opened) = ask(address, "POST", "/api/rooms", Some(admin), &wish)? else { return None };
        let text = |value: &Value| value.as_str().map(str::to_owned);
        let room = text(&opened["room"])?;
        let token = text(&opened["tokens"][0])?;
        let mut player = Self { room, token, shown: BTreeMap::new(), is_over: false };
        // Ends with the connection.
        let _ = player.follow(address, over);
        Some(player)
    }

    fn follow(&mut self, address: SocketAddr, over: &AtomicBool) -> io::Result<()> {
        let mut socket = Socket::open(address)?;
        socket.send(&json!({ "type": "join", "token": self.token }))?;
        let mut round = 0;
        while !over.load(Ordering::Relaxed) {
            let message = socket.next()?;
            match message["type"].as_str() {
                Some("stage") => round = message["round"].as_u64().unwrap_or_default(),
                Some("sight") => {
                    let step = message["step"].as_u64().unwrap_or_default();
                    let last = self.shown.entry(round).or_default();
                    *last = step.max(*last);
                }
                Some("state") => match message["doing"].as_str() {
                    // Practised for long enough at once.
                    Some("reading") => socket.send(&json!({ "type": "ready" }))?,
                    Some("playing") if round == 0 => socket.send(&json!({ "type": "ready" }))?,
                    // A game without its journal is over for its player, and goes on when there is one.
                    Some("over") => self.is_over = message["ending"] != "failed",
                    _ => {}
                },
                _ => {}
            }
        }
        Ok(())
    }

    /// All steps that were shown are in the journal, and the game goes on.
    pub(super) fn check(&self, address: SocketAddr, out: &Path) -> Result<(), Wrong> {
        let journal = out.join("rooms").join(format!("{}.jsonl", self.room));
        let text = fs::read_to_string(&journal)?;
        let mut kept: BTreeMap<u64, u64> = BTreeMap::new();
        let mut round = 0;
        for line in text.lines() {
            let entry: Value = serde_json::from_str(line)?;
            match entry["entry"].as_str() {
                Some("began") => {
                    round = entry["round"].as_u64().unwrap_or_default();
                    kept.insert(round, 0);
                }
                Some("step") => *kept.entry(round).or_default() += 1,
                _ => {}
            }
        }
        for (round, shown) in &self.shown {
            let there = kept.get(round).copied().unwrap_or_default();
            if there < *shown {
                return Err(format!("round {round}: step {shown} was shown, the journal has {there}").into());
            }
        }
        if self.is_over {
            return Ok(());
        }
        let mut socket = Socket::open(address)?;
        socket.send(&json!({ "type": "join", "token": self.token }))?;
        let welcome = socket.next().map_err(|error| format!("afterwards the game is gone: {error}"))?;
        if welcome["type"] == "welcome" {
            return Ok(());
        }
        Err(format!("afterwards the game says {welcome}").into())
    }
}

/// A connection for messages in JSON (RFC 6455).
struct Socket(TcpStream);

impl Socket {
    fn open(address: SocketAddr) -> io::Result<Self> {
        let mut stream = TcpStream::connect(address)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        let head = format!(
            "GET /play/socket HTTP/1.1\r\nhost: {address}\r\nconnection: Upgrade\r\nupgrade: websocket\r\n\
             sec-websocket-version: 13\r\nsec-websocket-key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        );
        stream.write_all(head.as_bytes())?;
        let mut answer = Vec::new();
        while !answer.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte)?;
            answer.extend(byte);
        }
        if answer.starts_with(b"HTTP/1.1 101") { Ok(Self(stream)) } else { Err(other("no WebSocket")) }
    }

    fn send(&mut self, message: &Value) -> io::Result<()> {
        self.send_frame(0x1, message.to_string().as_bytes())
    }

    fn send_frame(&mut self, kind: u8, content: &[u8]) -> io::Result<()> {
        // Shorter ones have their length in one byte; people have nothing longer to say.
        let length = u8::try_from(content.len()).ok().filter(|length| *length < 126);
        let length = length.ok_or_else(|| other("too long a message"))?;
        let mut frame = vec![0x80 | kind, 0x80 | length];
        frame.extend(MASK);
        frame.extend(content.iter().zip(MASK.iter().cycle()).map(|(byte, mask)| byte ^ mask));
        self.0.write_all(&frame)
    }

    /// The next message.
    fn next(&mut self) -> io::Result<Value> {
        loop {
            let [kind, length] = self.bytes()?;
            let length = match length & 0x7f {
                126 => usize::from(u16::from_be_bytes(self.bytes()?)),
                127 => usize::try_from(u64::from_be_bytes(self.bytes()?)).map_err(io::Error::other)?,
                short => usize::from(short),
            };
            let mut content = vec![0; length];
            self.0.read_exact(&mut content)?;
            match kind & 0xf {
                0x1 => return serde_json::from_slice(&content).map_err(io::Error::other),
                0x8 => return Err(other("closed")),
                // A question whether somebody is there.
                0x9 => self.send_frame(0xa, &content)?,
                _ => {}
            }
        }
    }

    fn bytes<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut bytes = [0; N];
        self.0.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}

fn other(what: &str) -> io::Error {
    io::Error::other(what)
}
