//! Why motion cannot be read, each as one plain sentence.

use thiserror::Error;

/// Why a video or table has no motion that can be read.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum TrackError {
    /// A frame is too small or too large.
    #[error("a frame of {width} × {height} pixels cannot be tracked; each side must be 32 to 4096 pixels")]
    Size {
        /// Width (pixels).
        width: usize,
        /// Height (pixels).
        height: usize,
    },
    /// A frame has another size than those before it.
    #[error("frame {frame} has another size than the frames before it")]
    Resized {
        /// Its number, from 0.
        frame: usize,
    },
    /// There is no arena in the picture.
    #[error(
        "frame {frame} shows no arena: a square with black lines as edges, at least a quarter as wide as the picture"
    )]
    NoArena {
        /// The number of the frame, from 0.
        frame: usize,
    },
    /// Inner walls that no layout has.
    #[error("the inner walls in the picture are those of no layout (docs/reference/formats/events.md)")]
    Walls,
    /// A body of which few pixels are in sight.
    #[error(
        "a body shows few pixels of its colour, so that it cannot be told whether others cover a part of it"
    )]
    Covered,
    /// Other bodies than two agents and up to two objects.
    #[error(
        "the picture shows {agents} trapezoids and {objects} discs of a colour of their own, not two agents and up to two objects"
    )]
    Bodies {
        /// Number of trapezoids.
        agents: usize,
        /// Number of discs.
        objects: usize,
    },
    /// No shapes that can be followed.
    #[error("the video has no shapes to follow: {0}")]
    Shapes(String),
    /// A body disappeared for long.
    #[error("the {colour} body was not found for {seconds:.1} s from {start:.1} s on")]
    Lost {
        /// Its colour.
        colour: String,
        /// Time at which it disappeared (s).
        start: f64,
        /// Time for which it was not found (s).
        seconds: f64,
    },
    /// Time does not go on evenly.
    #[error(
        "the time from frame to frame varies ({least:.4} to {greatest:.4} s); convert the video to a constant rate first"
    )]
    Uneven {
        /// Shortest time between two frames (s).
        least: f64,
        /// Longest time between two frames (s).
        greatest: f64,
    },
    /// Too few or too many frames a second.
    #[error("{0:.1} frames a second are too few or too many; there must be 4 to 240")]
    Rate(f64),
    /// Less than one step.
    #[error("{frames} frames last {seconds:.2} s; a track needs at least 0.25 s")]
    Short {
        /// Number of frames.
        frames: usize,
        /// Time that they last (s).
        seconds: f64,
    },
    /// A video of more than an hour.
    #[error("a video may last at most {0} s")]
    Long(u32),
    /// `--map` names something that is not there.
    #[error("{0}")]
    Map(String),
    /// A table that cannot be read.
    #[error("{0}")]
    Table(String),
}
