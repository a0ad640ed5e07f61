//! Errors between a state and a file.

use thiserror::Error;

/// Reason why a frame, a contact sheet or a video could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The style asks for a picture that is too small, too large, or all margin.
    #[error("style: {field} must be {rule}, not {found}")]
    Style {
        /// The field of [`crate::Style`].
        field: &'static str,
        /// The range that it must be in.
        rule: String,
        /// Its value.
        found: u32,
    },
    /// A width or height of a video is odd: H.264 keeps one colour for each 2 × 2 pixels.
    #[error("video width and height must be even, not {width} x {height}; choose an even Style::side")]
    OddSize {
        /// Width asked for (pixels).
        width: u32,
        /// Height asked for (pixels).
        height: u32,
    },
    /// A width or height of a video is outside of what the encoder takes.
    #[error("video width and height must be 16 to 2160 pixels, not {width} x {height}")]
    VideoSize {
        /// Width asked for (pixels).
        width: u32,
        /// Height asked for (pixels).
        height: u32,
    },
    /// The frame rate of a video is 0 or too high.
    #[error("frames per second must be 1 to 120, not {0}")]
    FrameRate(u32),
    /// A frame differs in size from the video or from the other frames of a contact sheet.
    #[error("frame {index} is {found_width} x {found_height} pixels, but {width} x {height} are needed")]
    FrameSize {
        /// Position of the frame, from 0.
        index: usize,
        /// Width of the frame (pixels).
        found_width: u32,
        /// Height of the frame (pixels).
        found_height: u32,
        /// The width needed (pixels).
        width: u32,
        /// The height needed (pixels).
        height: u32,
    },
    /// There is no frame to make a video or a contact sheet of.
    #[error("a {0} needs at least one frame")]
    NoFrames(&'static str),
    /// A contact sheet without columns, or one too large to be a picture.
    #[error(
        "a contact sheet of {frames} frames in {columns} columns cannot be drawn; choose 1 or more columns and fewer or smaller frames"
    )]
    Sheet {
        /// Number of frames.
        frames: usize,
        /// Number of columns.
        columns: usize,
    },
    /// The embedded font could not be parsed.
    #[error("the embedded font cannot be parsed")]
    Font,
    /// The layout to draw does not exist.
    #[error(transparent)]
    Layout(#[from] phase_model::LayoutError),
    /// The video encoder returned nothing for a frame.
    #[error("the video encoder skipped frame {0}")]
    SkippedFrame(usize),
    /// The video encoder failed.
    #[cfg(feature = "video")]
    #[error("encoding the video failed")]
    Encoder(#[from] openh264::Error),
    /// The .mp4 could not be put together or written.
    #[cfg(feature = "video")]
    #[error("writing the .mp4 failed: {0}")]
    Container(#[from] muxide::api::MuxerError),
    /// The .png could not be put together.
    #[error("encoding the .png failed: {0}")]
    Png(#[source] Box<dyn core::error::Error + Send + Sync>),
}
