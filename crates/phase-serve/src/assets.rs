//! The pages, as files.

use crate::App;
use axum::{
    body::Bytes,
    extract::{Request, State},
    http::{HeaderValue, Method, StatusCode, header},
    response::{IntoResponse, Redirect, Response},
};
use sha2::{Digest as _, Sha256};
use std::{collections::HashMap, sync::Arc};

/// The files by path, `/` first.
#[derive(Debug, Default)]
pub(crate) struct Assets(HashMap<String, Asset>);

#[derive(Debug)]
struct Asset {
    bytes: Bytes,
    kind: &'static str,
    /// Changes with the contents, so that browsers keep files and still notice a new version.
    tag: HeaderValue,
}

impl Assets {
    /// Adds a file.
    pub(crate) fn add(&mut self, path: String, bytes: Bytes) {
        let digest = Sha256::digest(&bytes);
        let tag: String = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        // Hexadecimal digits are valid in a header.
        let tag = HeaderValue::try_from(format!("\"{tag}\"")).unwrap_or(HeaderValue::from_static("\"\""));
        let kind = kind(&path);
        self.0.insert(path, Asset { bytes, kind, tag });
    }
}

/// The type of a file, by its ending.
pub(crate) fn kind(path: &str) -> &'static str {
    match path.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js" | "mjs") => "text/javascript; charset=utf-8",
        Some("json") => "application/json",
        Some("svg") => "image/svg+xml",
        Some("wasm") => "application/wasm",
        Some("mp4") => "video/mp4",
        _ => "application/octet-stream",
    }
}

/// Answers with a file.
pub(crate) async fn file(State(app): State<Arc<App>>, request: Request) -> Response {
    if !matches!(*request.method(), Method::GET | Method::HEAD) {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    let path = request.uri().path();
    let name = if path.ends_with('/') { format!("{path}index.html") } else { path.to_owned() };
    let Some(asset) = app.assets.0.get(&name) else {
        // A folder without its last stroke, so that the relative links of its page are right.
        let folder = format!("{path}/index.html");
        if app.assets.0.contains_key(&folder) {
            return Redirect::permanent(&format!("{path}/")).into_response();
        }
        return (StatusCode::NOT_FOUND, "There is nothing of this name.\n").into_response();
    };
    let headers = [
        (header::CONTENT_TYPE, HeaderValue::from_static(asset.kind)),
        (header::ETAG, asset.tag.clone()),
        (header::CACHE_CONTROL, HeaderValue::from_static("no-cache")),
    ];
    if request.headers().get(header::IF_NONE_MATCH) == Some(&asset.tag) {
        return (StatusCode::NOT_MODIFIED, headers).into_response();
    }
    (headers, asset.bytes.clone()).into_response()
}
