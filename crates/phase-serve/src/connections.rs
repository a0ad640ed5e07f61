//! Connections: how many there may be, and for how long each may wait.
//!
//! Clients that do not behave are told from others by what they keep waiting. Where a place is needed, the
//! connection that has been silent for longest leaves, one of the address that has most; so nobody is refused
//! because others are silent.

use crate::{
    limits::{Bucket, network},
    log,
    places::{Guest, Places},
};
use axum::{Router, body::Body, extract::ConnectInfo};
use core::{
    pin::{Pin, pin},
    task::{Context, Poll, ready},
    time::Duration,
};
use hyper::{Request, body::Incoming, server::conn::http1, service::service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use std::{
    future::Future,
    io::{self, IoSlice},
    net::SocketAddr,
    sync::Arc,
    time::Instant,
};
use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    net::{TcpListener, TcpStream},
    sync::watch,
    task::JoinSet,
    time::{Sleep, sleep},
};
use tower_service::Service as _;

/// Connections at the same time, but for those of players. With two players and a journal for each of 200
/// rooms this stays below the 1024 files that systems let a program open unless told otherwise.
const CONNECTIONS: usize = 320;
/// Of them those of one address. A class may sit behind one.
const CONNECTIONS_OF_ADDRESS: usize = 100;
/// Time in which the head of a request has to come, and for which a connection may be idle.
const HEAD_TIME: Duration = Duration::from_secs(15);
/// Time after which a client that takes nothing of what is sent to it is gone.
const STALLED: Duration = Duration::from_secs(15);
/// Bytes of a connection that are read at once, and then in a second. Something small, such as an empty
/// fragment of a message, is work all the same.
const BYTES: (f64, f64) = (1024.0 * 1024.0, 256.0 * 1024.0);
/// Largest head of a request (bytes).
const LARGEST_HEAD: usize = 16 * 1024;
/// Time in which open connections have to end when the server stops.
const PATIENCE: Duration = Duration::from_secs(5);
/// Pause after the system has no connection to give.
const PAUSE: Duration = Duration::from_millis(100);

/// Answers connections until it is told to stop; then those that are open have a moment to end.
/// `behind_proxy`: all of them come from one address, which is nobody's.
pub(crate) async fn serve(
    listener: TcpListener,
    router: Router,
    behind_proxy: bool,
    stop: watch::Receiver<bool>,
) {
    let of_address = if behind_proxy { CONNECTIONS } else { CONNECTIONS_OF_ADDRESS };
    let places = Arc::new(Places::new(CONNECTIONS, of_address));
    let mut open = JoinSet::new();
    let mut stopped = stop.clone();
    loop {
        tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok((stream, peer)) => {
                    let guest = places.enter(network(peer.ip()));
                    open.spawn(answer(stream, peer, guest, router.clone(), stop.clone()));
                }
                // It was gone before it was accepted.
                Err(error) if error.kind() == io::ErrorKind::ConnectionAborted => {}
                Err(error) => {
                    log::failure(&error);
                    places.make_room();
                    sleep(PAUSE).await;
                }
            },
            Some(_) = open.join_next() => {}
            _ = stopped.wait_for(|stop| *stop) => break,
        }
    }
    drop(listener);
    // Connections that do not end by themselves are cut.
    let ended = async { while open.join_next().await.is_some() {} };
    let _ = tokio::time::timeout(PATIENCE, ended).await;
}

/// Answers the requests of one connection.
async fn answer(
    stream: TcpStream,
    peer: SocketAddr,
    guest: Guest,
    router: Router,
    mut stop: watch::Receiver<bool>,
) {
    let guest = Arc::new(guest);
    // Steps are small and late ones are of no use; without it they are only sent together.
    let _ = stream.set_nodelay(true);
    let io = TokioIo::new(Watched {
        stream,
        guest: Arc::downgrade(&guest),
        stalled: None,
        bucket: Bucket::new(BYTES.0, BYTES.1, Instant::now()),
        pause: None,
    });
    let service = service_fn(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(ConnectInfo(peer));
        // It is always ready.
        router.clone().call(request.map(Body::new))
    });
    let mut connection = pin!(
        http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(HEAD_TIME)
            .max_buf_size(LARGEST_HEAD)
            .serve_connection(io, service)
            .with_upgrades()
    );
    let stopped = stop.wait_for(|stop| *stop);
    tokio::select! {
        // How it ended concerns the client alone. One that becomes a player's leaves here.
        _ = connection.as_mut() => return,
        () = guest.asked_to_leave() => return,
        _ = stopped => {}
    }
    connection.as_mut().graceful_shutdown();
    let _ = connection.await;
}

/// A stream that knows when it was last used, reads no more than [`BYTES`], and fails if what is sent is not
/// taken.
struct Watched {
    stream: TcpStream,
    guest: std::sync::Weak<Guest>,
    stalled: Option<Pin<Box<Sleep>>>,
    bucket: Bucket,
    /// The time until more is read.
    pause: Option<Pin<Box<Sleep>>>,
}

impl Watched {
    fn used(&mut self) {
        self.stalled = None;
        if let Some(guest) = self.guest.upgrade() {
            guest.used();
        }
    }

    /// The result of an attempt to write, and an error in place of waiting for longer than [`STALLED`].
    fn written<T>(&mut self, context: &mut Context<'_>, result: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if result.is_ready() {
            self.used();
            return result;
        }
        let stalled = self.stalled.get_or_insert_with(|| Box::pin(sleep(STALLED)));
        ready!(stalled.as_mut().poll(context));
        Poll::Ready(Err(io::ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Watched {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        if let Some(pause) = &mut self.pause {
            ready!(pause.as_mut().poll(context));
            self.pause = None;
        }
        let before = buffer.filled().len();
        let result = Pin::new(&mut self.stream).poll_read(context, buffer);
        let pause = self.bucket.spend(buffer.filled().len() - before, Instant::now());
        self.pause = (!pause.is_zero()).then(|| Box::pin(sleep(pause)));
        if let (true, Some(guest)) = (result.is_ready(), self.guest.upgrade()) {
            guest.used();
        }
        result
    }
}

impl AsyncWrite for Watched {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let result = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.written(context, result)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let result = Pin::new(&mut self.stream).poll_write_vectored(context, slices);
        self.written(context, result)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
