//! Errors, of the program and of requests over HTTP.

use axum::{
    Json,
    http::StatusCode,
    response::{IntoResponse, Response},
};
use phase_files::{FileError, WriteError, folder::FolderError};
use serde_json::json;
use std::{io, net::SocketAddr, path::PathBuf};
use thiserror::Error;

/// Why the server cannot start, or had to stop.
#[derive(Debug, Error)]
pub enum ServeError {
    /// The address cannot be listened on.
    #[error("cannot listen on {address}: {}", reason(source))]
    Listen {
        /// The address.
        address: SocketAddr,
        /// Why.
        #[source]
        source: io::Error,
    },
    /// The server's folder is another one's, or cannot be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A folder or file of the server cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A folder of the server cannot be read.
    #[error("{}: cannot be read", path.display())]
    Read {
        /// It.
        path: PathBuf,
        /// Why.
        #[source]
        source: io::Error,
    },
    /// The configuration of a study cannot be used.
    #[error("{}: {rule}", file.display())]
    Study {
        /// The file.
        file: PathBuf,
        /// The rule that the setting breaks.
        rule: String,
    },
    /// The answers of a study cannot be used.
    #[error(transparent)]
    Answers(#[from] phase_study::store::StoreError),
    /// There are no random numbers for tokens.
    #[error("the operating system has no random numbers")]
    Random(#[from] getrandom::Error),
    /// The runtime failed.
    #[error("the server failed")]
    Runtime(#[source] io::Error),
}

/// The usual reasons in words.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::AddrInUse => "another program uses it".into(),
        io::ErrorKind::AddrNotAvailable => "this machine has no such address".into(),
        io::ErrorKind::PermissionDenied => "it needs more rights".into(),
        kind => kind.to_string(),
    }
}

/// Why a request was not answered as hoped; one sentence, as `{"error": …}`.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("{sentence}")]
pub(crate) struct ApiError {
    /// The status.
    pub(crate) status: StatusCode,
    /// The problem, as a sentence for the client.
    pub(crate) sentence: String,
}

impl ApiError {
    /// An error of a status.
    #[must_use]
    pub(crate) fn new(status: StatusCode, sentence: impl Into<String>) -> Self {
        Self { status, sentence: sentence.into() }
    }

    /// An answer with status 400, because of a mistake in the request.
    #[must_use]
    pub(crate) fn bad(sentence: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, sentence)
    }

    /// Nothing is there.
    #[must_use]
    pub(crate) fn missing() -> Self {
        Self::new(StatusCode::NOT_FOUND, "there is nothing of this name")
    }

    /// Too much is going on.
    #[must_use]
    pub(crate) fn busy(sentence: impl Into<String>) -> Self {
        Self::new(StatusCode::SERVICE_UNAVAILABLE, sentence)
    }

    /// The server failed; the reason goes to its log.
    #[must_use]
    pub(crate) fn failed(reason: &dyn std::error::Error) -> Self {
        crate::log::failure(reason);
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, "the server failed; its log says why")
    }
}

impl IntoResponse for ApiError {
    fn into_response(self) -> Response {
        (self.status, Json(json!({ "error": self.sentence }))).into_response()
    }
}
