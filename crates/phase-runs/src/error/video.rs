//! Videos that cannot be tracked.

use phase_track::TrackError;
use std::io;
use thiserror::Error;

/// Why a video cannot be tracked.
#[derive(Debug, Error)]
pub enum VideoError {
    /// Its pictures show nothing that can be tracked.
    #[error(transparent)]
    Track(#[from] TrackError),
    /// Neither an arena with agents nor shapes that can be followed.
    #[error("{why}; nor can it be read as a video of other shapes: {error}")]
    Foreign {
        /// Why it is no video of an arena.
        why: TrackError,
        /// Why it is no video of shapes.
        error: TrackError,
    },
    /// It is none, or damaged.
    #[error("is no video that can be read: {0}")]
    Unreadable(String),
    /// The program `ffmpeg` is needed to decode it, and is not there.
    #[error(
        "{0}; other videos than H.264 in .mp4, PNG and GIF need the program ffmpeg, which is not installed"
    )]
    NoFfmpeg(String),
    /// Reading failed.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// A stop was requested.
    #[error("was not read to its end")]
    Interrupted,
}
