//! Videos, whole or in part: browsers ask for ranges of bytes (RFC 9110, section 14).

use crate::{App, error::ApiError};
use axum::{
    body::{Body, Bytes},
    extract::{Path, State},
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use futures_util::stream;
use phase_files::regular;
use std::{
    fs::File,
    io::{self, Read as _, Seek as _, SeekFrom},
    sync::Arc,
};

/// Bytes read at once.
const PIECE: u64 = 256 * 1024;

/// Part of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Part {
    from: u64,
    length: u64,
}

/// Answers with a video, or with the part that is asked for.
pub(super) async fn video(
    State(app): State<Arc<App>>,
    Path((study, name)): Path<(String, String)>,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    let running = app.studies.get(&study)?;
    let file = name.strip_suffix(".mp4").and_then(|name| running.videos.get(name));
    let file = file.cloned().ok_or_else(ApiError::missing)?;
    let opened = tokio::task::spawn_blocking(move || {
        let opened = regular::open(&file).map_err(|error| ApiError::failed(&error))?;
        let about = opened.metadata().map_err(|error| ApiError::failed(&error))?;
        Ok::<_, ApiError>((opened, about.len()))
    });
    let (mut file, length) = opened.await.map_err(|error| ApiError::failed(&error))??;
    let asked = headers.get(header::RANGE).and_then(|value| value.to_str().ok());
    let (status, part) = match asked.map_or(Asked::Whole, |asked| range(asked, length)) {
        Asked::Whole => (StatusCode::OK, Part { from: 0, length }),
        Asked::Part(part) => (StatusCode::PARTIAL_CONTENT, part),
        Asked::Nothing => {
            let range = [(header::CONTENT_RANGE, format!("bytes */{length}"))];
            return Ok((StatusCode::RANGE_NOT_SATISFIABLE, range).into_response());
        }
    };
    file.seek(SeekFrom::Start(part.from)).map_err(|error| ApiError::failed(&error))?;
    let mut response = Response::new(pieces(file, part.length));
    *response.status_mut() = status;
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("video/mp4"));
    headers.insert(header::ACCEPT_RANGES, HeaderValue::from_static("bytes"));
    headers.insert(header::CONTENT_LENGTH, part.length.into());
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("private, max-age=3600"));
    if status == StatusCode::PARTIAL_CONTENT {
        let range = format!("bytes {}-{}/{length}", part.from, part.from + part.length - 1);
        // Digits and these signs are valid in a header.
        headers.extend(HeaderValue::try_from(range).map(|range| (header::CONTENT_RANGE, range)));
    }
    Ok(response)
}

/// The part of a file that a request wants.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Asked {
    Whole,
    Part(Part),
    /// A range that lies outside of the file.
    Nothing,
}

/// The part that a `Range` asks for. Several ranges at once, other units and what cannot be read are answered
/// with the whole, as the RFC allows.
fn range(asked: &str, length: u64) -> Asked {
    let Some((from, to)) = asked.strip_prefix("bytes=").and_then(|range| range.trim().split_once('-')) else {
        return Asked::Whole;
    };
    let number = |text: &str| {
        text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse::<u64>().ok()).flatten()
    };
    let (from, to) = match (from, to) {
        ("", last) => match number(last) {
            Some(last) => (length.saturating_sub(last), length.saturating_sub(u64::from(last > 0))),
            None => return Asked::Whole,
        },
        (from, "") => match number(from) {
            Some(from) => (from, length.saturating_sub(1)),
            None => return Asked::Whole,
        },
        (from, to) => match (number(from), number(to)) {
            (Some(from), Some(to)) if from <= to => (from, to.min(length.saturating_sub(1))),
            _ => return Asked::Whole,
        },
    };
    if from >= length || to < from {
        return Asked::Nothing;
    }
    Asked::Part(Part { from, length: to - from + 1 })
}

/// The next bytes of a file, a piece at a time.
fn pieces(file: File, length: u64) -> Body {
    Body::from_stream(stream::unfold((Some(file), length), |(file, left)| async move {
        let mut file = file.filter(|_| left > 0)?;
        let read = tokio::task::spawn_blocking(move || {
            let mut piece = Vec::new();
            file.by_ref().take(left.min(PIECE)).read_to_end(&mut piece)?;
            Ok::<_, io::Error>((file, piece))
        });
        match read.await.map_err(io::Error::other).and_then(|read| read) {
            // Shorter than it was: the connection ends, and the browser asks again.
            Ok((_, piece)) if piece.is_empty() => Some((Err(io::ErrorKind::UnexpectedEof.into()), (None, 0))),
            Ok((file, piece)) => {
                let left = left - piece.len() as u64;
                Some((Ok(Bytes::from(piece)), (Some(file), left)))
            }
            Err(error) => Some((Err(error), (None, 0))),
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_those_of_the_rfc() {
        let part = |from, length| Asked::Part(Part { from, length });
        // RFC 9110, section 14.1.2, with a representation of 10000 bytes.
        assert_eq!(range("bytes=0-499", 10_000), part(0, 500));
        assert_eq!(range("bytes=500-999", 10_000), part(500, 500));
        assert_eq!(range("bytes=-500", 10_000), part(9500, 500));
        assert_eq!(range("bytes=9500-", 10_000), part(9500, 500));
        assert_eq!(range("bytes=0-0", 10_000), part(0, 1));
        assert_eq!(range("bytes=9500-99999999999999999999", 10_000), Asked::Whole);
        assert_eq!(range("bytes=9500-20000", 10_000), part(9500, 500));
        assert_eq!(range("bytes=-20000", 10_000), part(0, 10_000));
        assert_eq!(range("bytes=10000-", 10_000), Asked::Nothing);
        assert_eq!(range("bytes=-0", 10_000), Asked::Nothing);
        assert_eq!(range("bytes=0-", 0), Asked::Nothing);
        for other in ["bytes=0-0,-1", "items=0-5", "bytes=5-2", "bytes=a-b", "bytes", "bytes=+1-2", "bytes=-"]
        {
            assert_eq!(range(other, 10_000), Asked::Whole, "{other}");
        }
    }
}
