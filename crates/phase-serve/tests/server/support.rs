//! A server that runs, and players that connect to it.

use futures_util::{SinkExt as _, StreamExt as _};
use phase_game::{GameSettings, playlist::Item};
use phase_serve::{Server, ServerSettings};
use serde_json::{Value, json};
use std::{
    io::{Read as _, Write as _},
    net::{SocketAddr, TcpStream},
    thread::JoinHandle,
    time::Duration,
};
use tokio::{runtime::Runtime, sync::oneshot};
use tokio_tungstenite::{
    WebSocketStream, client_async,
    tungstenite::{Message, client::IntoClientRequest as _},
};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(20);

/// Short rounds, quick minds, a folder that is removed by the system some day.
pub(crate) fn settings() -> ServerSettings {
    let mut game = GameSettings { countdown: Duration::from_millis(100), ..GameSettings::default() };
    game.simulation.max_steps = 6;
    game.simulation.minds = game.simulation.minds.with_particles(5);
    game.simulation.minds = game.simulation.minds.with_simulations(20);
    ServerSettings {
        listen: ([127, 0, 0, 1], 0).into(),
        host: None,
        only_studies: false,
        behind_proxy: false,
        folder: tempfile::tempdir().expect("a folder").keep(),
        rooms: 50,
        mind_rooms: 2,
        open: true,
        rounds: 1,
        game,
        seed: 1,
    }
}

pub(crate) struct Running {
    pub(crate) address: SocketAddr,
    pub(crate) admin: String,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

pub(crate) struct Answer {
    pub(crate) status: u16,
    head: String,
    pub(crate) body: String,
}

impl Answer {
    pub(crate) fn header(&self, name: &str) -> Option<String> {
        let lines = self.head.lines().skip(1).filter_map(|line| line.split_once(": "));
        lines.filter(|(key, _)| key.eq_ignore_ascii_case(name)).map(|(_, value)| value.to_owned()).next()
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|_| panic!("no JSON: {}", self.body))
    }
}

impl Running {
    pub(crate) fn start(settings: ServerSettings) -> Self {
        let scene = phase_sampler::sample_named(Some("independent"), None, 1).expect("a scene");
        let item = Item { source: "one".into(), scene };
        let server = Server::bind(settings, item.clone(), vec![item], None).expect("it starts");
        let (address, admin) = (server.address(), server.admin_token().to_owned());
        let (stop, stopped) = oneshot::channel::<()>();
        let serve = move || {
            let until = async {
                let _ = stopped.await;
            };
            server.run(until).expect("it serves");
        };
        Self { address, admin, stop: Some(stop), thread: Some(std::thread::spawn(serve)) }
    }

    pub(crate) fn stop(mut self) {
        self.end();
    }

    fn end(&mut self) {
        if let Some(stop) = self.stop.take() {
            let _ = stop.send(());
        }
        if let Some(thread) = self.thread.take() {
            thread.join().expect("it ends");
        }
    }

    pub(crate) fn get(&self, path: &str) -> Answer {
        self.ask("GET", path, &[], "")
    }

    pub(crate) fn ask(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let mut request =
            format!("{method} {path} HTTP/1.1\r\nConnection: close\r\nContent-Length: {}\r\n", body.len());
        if !headers.iter().any(|(name, _)| *name == "Host") {
            request += &format!("Host: {}\r\n", self.address);
        }
        for (name, value) in headers {
            request += &format!("{name}: {value}\r\n");
        }
        let mut stream = TcpStream::connect(self.address).expect("it listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a limit");
        // A server that refuses early need not read everything.
        let _ = stream.write_all(format!("{request}\r\n{body}").as_bytes());
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let (head, body) = answer.split_once("\r\n\r\n").expect("an answer");
        let status = head.split(' ').nth(1).and_then(|code| code.parse().ok()).expect("a status");
        Answer { status, head: head.to_owned(), body: body.to_owned() }
    }

    /// Opens a room for two people, or one and a mind; the tokens.
    pub(crate) fn open(&self, partner: &str) -> Vec<String> {
        let answer = self.ask("POST", "/api/rooms", &[], &json!({ "partner": partner }).to_string());
        assert_eq!(answer.status, 201, "{}", answer.body);
        let tokens = answer.json()["tokens"].as_array().expect("tokens").clone();
        tokens.iter().filter_map(|token| token.as_str().map(Into::into)).collect()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.end();
    }
}

pub(crate) struct Player {
    socket: WebSocketStream<tokio::net::TcpStream>,
    runtime: Runtime,
}

impl Player {
    pub(crate) fn try_open(server: &Running, origin: Option<&str>) -> Result<Self, String> {
        Self::try_open_from(server, [127, 0, 0, 1], origin)
    }

    /// From an address of this machine, which has many.
    pub(crate) fn try_open_from(
        server: &Running,
        from: [u8; 4],
        origin: Option<&str>,
    ) -> Result<Self, String> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
        let socket = runtime.block_on(async {
            let mut request =
                format!("ws://{}/play/socket", server.address).into_client_request().expect("a request");
            if let Some(origin) = origin {
                request.headers_mut().insert("Origin", origin.parse().expect("a header"));
            }
            let stream = tokio::net::TcpSocket::new_v4().expect("a socket");
            stream.bind((from, 0).into()).expect("an address of this machine");
            let stream = stream.connect(server.address).await.expect("it listens");
            client_async(request, stream).await.map(|(socket, _)| socket).map_err(|error| error.to_string())
        })?;
        Ok(Self { socket, runtime })
    }

    pub(crate) fn open(server: &Running) -> Self {
        Self::try_open(server, None).expect("a socket")
    }

    pub(crate) fn join(server: &Running, token: &str) -> Self {
        let mut player = Self::open(server);
        player.send(&json!({ "type": "join", "token": token }));
        player
    }

    pub(crate) fn send(&mut self, message: &Value) {
        self.send_text(&message.to_string());
    }

    /// Sends several messages at once, without looking at what comes back.
    pub(crate) fn send_all(&mut self, messages: impl IntoIterator<Item = Message>) {
        let sent = async {
            for message in messages {
                if self.socket.feed(message).await.is_err() {
                    return;
                }
            }
            let _ = self.socket.flush().await;
        };
        // What is never read stops what is written.
        let _ = self.runtime.block_on(async { tokio::time::timeout(PATIENCE, sent).await });
    }

    /// A connection that is closed already cannot be written to.
    pub(crate) fn send_text(&mut self, text: &str) {
        let _ = self.runtime.block_on(self.socket.send(Message::text(text)));
    }

    fn next(&mut self) -> Option<Message> {
        let next = async { tokio::time::timeout(PATIENCE, self.socket.next()).await };
        self.runtime.block_on(next).expect("a message in time").and_then(Result::ok)
    }

    /// The next message that is so.
    pub(crate) fn until(&mut self, mut wanted: impl FnMut(&Value) -> bool) -> Value {
        loop {
            match self.next() {
                Some(Message::Text(text)) => {
                    let message = serde_json::from_str(&text).expect("JSON");
                    if wanted(&message) {
                        return message;
                    }
                }
                Some(Message::Close(_)) | None => panic!("the connection was closed"),
                Some(_) => {}
            }
        }
    }

    /// Waits until the connection is closed; the code, if there was one.
    pub(crate) fn closed(&mut self) -> Option<u16> {
        loop {
            match self.next() {
                Some(Message::Close(frame)) => return frame.map(|frame| frame.code.into()),
                None => return None,
                Some(_) => {}
            }
        }
    }
}
