//! Security of the pages: headers of every answer, and checks of the origin of requests.

use crate::{App, error::ApiError, limits::network};
use axum::{
    body::{Body, to_bytes},
    extract::{ConnectInfo, Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header, uri::Authority},
    middleware::Next,
    response::{IntoResponse as _, Response},
};
use std::{
    net::{IpAddr, SocketAddr},
    sync::Arc,
    time::{Duration, Instant},
};

/// Largest body of a request (bytes): an answer, not a file.
const LARGEST_BODY: usize = 64 * 1024;
/// Time in which the body of a request has to come.
const BODY_TIME: Duration = Duration::from_secs(10);

/// Pages run no script and use no style but their own, and nothing comes from elsewhere.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; media-src 'self'; \
                      connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'";
/// The playground also runs WebAssembly, in workers.
const PLAYGROUND_POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; \
                                 img-src 'self' data: blob:; connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'";

/// Refuses requests that come too often, or through a name that is not the server's; adds what protects the
/// pages.
pub(crate) async fn guard(
    State(app): State<Arc<App>>,
    ConnectInfo(peer): ConnectInfo<SocketAddr>,
    mut request: Request,
    next: Next,
) -> Response {
    let address = client(&app, peer, request.headers());
    request.extensions_mut().insert(Client(address));
    let playground = request.uri().path().starts_with("/playground/");
    let mut response = if !app.requests.take(address, Instant::now()) {
        ApiError::new(StatusCode::TOO_MANY_REQUESTS, "too many requests; wait a moment").into_response()
    } else if !app.settings.is_known_host(request.headers()) {
        // Otherwise a page elsewhere could point its own name at this server and read what it answers (DNS
        // rebinding).
        ApiError::new(StatusCode::MISDIRECTED_REQUEST, "this server does not have this name").into_response()
    } else if let Some(_doing) = app.answering.begin(address) {
        match whole(request).await {
            Ok(request) => next.run(request).await,
            Err(error) => error.into_response(),
        }
    } else {
        ApiError::new(StatusCode::TOO_MANY_REQUESTS, "too many requests at once; wait a moment")
            .into_response()
    };
    let policy = if playground { PLAYGROUND_POLICY } else { POLICY };
    let headers = response.headers_mut();
    let fixed = [
        (header::CONTENT_SECURITY_POLICY, policy),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (HeaderName::from_static("permissions-policy"), "camera=(), microphone=(), geolocation=()"),
    ];
    for (name, value) in fixed {
        headers.insert(name, HeaderValue::from_static(value));
    }
    // What is not a file is about this moment.
    headers.entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    response
}

/// A request once all of it is here.
async fn whole(request: Request) -> Result<Request, ApiError> {
    let (head, body) = request.into_parts();
    let refused = |status, sentence: &str| Err(ApiError::new(status, sentence));
    match tokio::time::timeout(BODY_TIME, to_bytes(body, LARGEST_BODY)).await {
        Ok(Ok(bytes)) => Ok(Request::from_parts(head, Body::from(bytes))),
        Ok(Err(_)) => {
            refused(StatusCode::PAYLOAD_TOO_LARGE, "what was sent is too large, or was not sent whole")
        }
        Err(_) => refused(StatusCode::REQUEST_TIMEOUT, "what was sent took too long"),
    }
}

/// The address of who asks, or what stands for it: see [`network`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Client(pub(crate) IpAddr);

/// Behind a proxy, the address that the proxy saw: the last one of the list, since those before it are told
/// by the client.
fn client(app: &App, peer: SocketAddr, headers: &HeaderMap) -> IpAddr {
    let forwarded = || {
        let value = headers.get_all("x-forwarded-for").iter().next_back()?.to_str().ok()?;
        value.rsplit(',').next()?.trim().parse().ok()
    };
    let address = if app.settings.behind_proxy { forwarded() } else { None };
    network(address.unwrap_or(peer.ip()))
}

/// The host that a request names.
pub(crate) fn host(headers: &HeaderMap) -> Option<Authority> {
    headers.get(header::HOST)?.to_str().ok()?.parse().ok()
}

/// Whether a page of this server opens a socket: browsers send their page's origin, and let any page open
/// sockets anywhere. Programs send none.
pub(crate) fn same_origin(headers: &HeaderMap) -> bool {
    let Some(origin) = headers.get(header::ORIGIN) else { return true };
    let origin = origin.to_str().ok().and_then(|origin| origin.split_once("://"));
    match (origin, host(headers)) {
        (Some((_, origin)), Some(host)) => origin.eq_ignore_ascii_case(host.as_str()),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_of_others_open_no_sockets() {
        let with = |host: &'static str, origin: Option<&'static str>| {
            let mut headers = HeaderMap::new();
            headers.insert(header::HOST, HeaderValue::from_static(host));
            if let Some(origin) = origin {
                headers.insert(header::ORIGIN, HeaderValue::from_static(origin));
            }
            same_origin(&headers)
        };
        assert!(with("localhost:8017", None));
        assert!(with("localhost:8017", Some("http://localhost:8017")));
        assert!(with("phase.example", Some("https://phase.example")));
        for origin in
            ["https://evil.example", "http://localhost:8018", "null", "http://localhost:8017.evil.example"]
        {
            assert!(!with("localhost:8017", Some(origin)), "{origin}");
        }
    }
}
