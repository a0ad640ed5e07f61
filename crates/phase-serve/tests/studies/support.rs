//! Servers with a study, and a client that speaks just enough HTTP.

use phase_game::{GameSettings, playlist::Item};
use phase_serve::{Server, ServerSettings};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    io::{Read as _, Write as _},
    net::{SocketAddr, TcpStream},
    path::{Path, PathBuf},
    thread::JoinHandle,
    time::Duration,
};
use tokio::sync::oneshot;

/// A study of so many videos, each wanted by `raters` who see all of them, and its videos; returns the
/// configuration's path.
pub(crate) fn write_study(folder: &Path, videos: usize, raters: usize) -> PathBuf {
    fs::create_dir_all(folder.join("videos")).expect("a folder");
    let stimuli: Vec<Value> = (0..videos)
        .map(|k| {
            let bytes: Vec<u8> = (0..5000_u32).map(|n| ((n * 7 + k as u32) % 251) as u8).collect();
            fs::write(folder.join(format!("videos/{k}.mp4")), bytes).expect("written");
            json!({"id": format!("event-{k}"), "video": format!("videos/{k}.mp4"), "relation": "neutral"})
        })
        .collect();
    let config = json!({
        "format": "phase-study/1", "name": "pilot", "title": "<b>A pilot</b>", "form": "relation",
        "consent": ["Do you agree?"], "instructions": ["Watch."], "stimuli": stimuli,
        "demographics": [{"name": "notes", "text": "Anything else?", "kind": "text", "longest": 50}],
        "raters_per_video": raters, "videos_per_rater": videos, "completion": {"code": "C0DE"},
    });
    let file = folder.join("pilot.json");
    fs::write(&file, config.to_string()).expect("written");
    file
}

/// A server with studies, not yet running.
pub(crate) fn bind(folder: &Path, studies: &[PathBuf]) -> Result<Server, phase_serve::ServeError> {
    let scene = phase_sampler::sample_named(Some("helping"), None, 1).expect("a scene");
    let item = Item { source: "mine".into(), scene };
    let settings = ServerSettings {
        listen: ([127, 0, 0, 1], 0).into(),
        host: None,
        only_studies: false,
        behind_proxy: false,
        folder: folder.join("out"),
        rooms: 1,
        mind_rooms: 2,
        open: false,
        rounds: 1,
        game: GameSettings::default(),
        seed: 1,
    };
    let mut server = Server::bind(settings, item.clone(), vec![item], None)?;
    server.open_studies(studies)?;
    Ok(server)
}

/// A server in a thread, until it is dropped.
pub(crate) struct Site {
    pub(crate) address: SocketAddr,
    pub(crate) admin: String,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Site {
    pub(crate) fn start(folder: &Path, studies: &[PathBuf]) -> Self {
        let server = bind(folder, studies).expect("a server");
        let (address, admin) = (server.address(), server.admin_token().to_owned());
        let (stop, stopped) = oneshot::channel();
        let until = async move {
            let _ = stopped.await;
        };
        let thread = std::thread::spawn(move || server.run(until).expect("it runs"));
        Self { address, admin, stop: Some(stop), thread: Some(thread) }
    }
}

impl Drop for Site {
    fn drop(&mut self) {
        let _ = self.stop.take().map(|stop| stop.send(()));
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// An answer of a server.
#[derive(Debug)]
pub(crate) struct Answered {
    pub(crate) status: u16,
    pub(crate) headers: BTreeMap<String, String>,
    pub(crate) body: Vec<u8>,
}

impl Answered {
    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or(Value::Null)
    }
}

/// Asks a server; `None` if it does not answer whole.
pub(crate) fn try_ask(
    address: SocketAddr,
    method: &str,
    path: &str,
    headers: &[(&str, &str)],
    body: Option<&Value>,
) -> Option<Answered> {
    let mut stream = TcpStream::connect(address).ok()?;
    stream.set_read_timeout(Some(Duration::from_secs(20))).ok()?;
    let body = body.map(Value::to_string).unwrap_or_default();
    let mut text = format!(
        "{method} {path} HTTP/1.1\r\nhost: {address}\r\nconnection: close\r\ncontent-length: {}\r\n",
        body.len()
    );
    for (name, value) in headers {
        text += &format!("{name}: {value}\r\n");
    }
    stream.write_all(format!("{text}\r\n{body}").as_bytes()).ok()?;
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).ok()?;
    let end = bytes.windows(4).position(|window| window == b"\r\n\r\n")?;
    let head = String::from_utf8(bytes[..end].to_vec()).ok()?;
    let mut lines = head.lines();
    let status = lines.next()?.split(' ').nth(1)?.parse().ok()?;
    let headers: BTreeMap<String, String> = lines
        .filter_map(|line| line.split_once(": "))
        .map(|(name, value)| (name.to_lowercase(), value.to_owned()))
        .collect();
    let body = bytes[end + 4..].to_vec();
    let length: Option<usize> = headers.get("content-length").and_then(|length| length.parse().ok());
    let whole = method == "HEAD" || length.is_none_or(|length| length == body.len());
    whole.then_some(Answered { status, headers, body })
}

pub(crate) fn ask(
    address: SocketAddr,
    method: &str,
    path: &str,
    token: Option<&str>,
    body: Option<&Value>,
) -> Answered {
    let bearer = token.map(|token| format!("Bearer {token}"));
    let headers: Vec<(&str, &str)> = bearer.iter().map(|bearer| ("authorization", bearer.as_str())).collect();
    try_ask(address, method, path, &headers, body).expect("an answer")
}

/// Asks for a step of a rater and returns what it sees then.
pub(crate) fn step(address: SocketAddr, token: &str, what: &str, body: &Value) -> Value {
    let answered = ask(address, "POST", &format!("/study/pilot/api/{what}"), Some(token), Some(body));
    assert_eq!(answered.status, 200, "{what}: {}", String::from_utf8_lossy(&answered.body));
    answered.json()
}

/// Lets a rater in and leads it to the first trial; its token.
pub(crate) fn begin(address: SocketAddr, id: &str) -> (String, Value) {
    let body = json!({"parameters": {"PROLIFIC_PID": id}});
    let joined = ask(address, "POST", "/study/pilot/api/join", None, Some(&body));
    assert_eq!(joined.status, 200, "{joined:?}");
    let token = joined.json()["token"].as_str().expect("a token").to_owned();
    step(address, &token, "consent", &json!({"agrees": true}));
    step(address, &token, "demographics", &json!({"notes": "=1+1"}));
    let first = step(address, &token, "instructions", &json!({}));
    (token, first)
}

pub(crate) fn answer(trial: u64, relation: &str) -> Value {
    json!({"trial": trial, "answer": {"relation": relation}, "response_time": 1200, "plays": 1})
}
