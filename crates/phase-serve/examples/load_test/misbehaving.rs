//! Clients that do not behave, from addresses of their own.

use crate::client;
use futures_util::SinkExt as _;
use serde_json::json;
use std::{error::Error, net::SocketAddr, time::Duration};
use tokio::{
    io::AsyncWriteExt as _,
    net::{TcpSocket, TcpStream},
    time::{sleep, timeout},
};
use tokio_tungstenite::{WebSocketStream, client_async, tungstenite::Message};

/// Time after which a client begins anew, if it was not cut off before.
const PATIENCE: Duration = Duration::from_secs(30);
/// Pause before that.
const PAUSE: Duration = Duration::from_millis(200);

/// What they do.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Begins a request and does not end it.
    Half,
    /// Opens a socket and says nothing.
    Silent,
    /// Sends pings and reads nothing.
    Pings,
    /// Says that it is ready and that it is away, over and over, and reads nothing.
    Deaf,
}

/// So many clients of each kind, until the runtime ends. The last two have a room, which they never play in.
pub(crate) fn start(count: u16, address: SocketAddr, admin: &str) {
    for k in 0..count {
        for (kind, last) in [(Kind::Half, 1), (Kind::Silent, 2), (Kind::Pings, 3), (Kind::Deaf, 4)] {
            let admin = admin.to_owned();
            tokio::spawn(async move {
                let [_, low] = k.to_be_bytes();
                let from = [127, 0, 100 + last, low.max(1)];
                let mut token = None;
                loop {
                    if matches!(kind, Kind::Pings | Kind::Deaf) && token.is_none() {
                        let opened = client::open_room(address, &admin, "human").await;
                        token = opened.ok().and_then(|tokens| tokens.into_iter().next());
                    }
                    // It is cut off sooner or later.
                    let _ = timeout(PATIENCE, misbehave(kind, from, address, token.as_deref())).await;
                    sleep(PAUSE).await;
                }
            });
        }
    }
}

async fn misbehave(
    kind: Kind,
    from: [u8; 4],
    address: SocketAddr,
    token: Option<&str>,
) -> Result<(), Box<dyn Error + Send + Sync>> {
    let socket = TcpSocket::new_v4()?;
    socket.bind((from, 0).into())?;
    let mut stream = socket.connect(address).await?;
    if matches!(kind, Kind::Half) {
        stream.write_all(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ").await?;
        sleep(PATIENCE).await;
        return Ok(());
    }
    let (mut socket, _): (WebSocketStream<TcpStream>, _) =
        client_async(format!("ws://{address}/play/socket"), stream).await?;
    let Some(token) = token else {
        sleep(PATIENCE).await;
        return Ok(());
    };
    socket.send(Message::text(json!({ "type": "join", "token": token }).to_string())).await?;
    for k in 0_u64.. {
        match kind {
            Kind::Pings => socket.send(Message::Ping(vec![0; 125].into())).await?,
            _ => {
                let away = json!({ "type": "away", "away": k.is_multiple_of(2) });
                let message = if k.is_multiple_of(3) { json!({ "type": "ready" }) } else { away };
                socket.send(Message::text(message.to_string())).await?;
                sleep(Duration::from_millis(20)).await;
            }
        }
    }
    Ok(())
}
