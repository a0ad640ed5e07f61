//! From pixels to motion: frames of a video in, tracks of its bodies out.
//!
//! A [`Tracker`] takes one [`Picture`] after another. From the first that shows an arena it reads the arena's
//! frame, inner walls, landmarks and colours, and finds the bodies; from then on it follows them. The
//! [`Track`] that it makes has every body's pose in every frame with its uncertainty, and
//! [`Track::rows`] turns that into the rows of an event at 4 Hz.
//!
//! Key design decision: analysis by synthesis. A pose is right if the body, drawn there over the ground and
//! under the bodies above it, gives the pixels that were seen; Gauss-Newton steps move it until it does. So
//! positions are as exact as the grey of edges, what other bodies hide is left out instead of missed, and
//! colours tell identities apart, so that they cannot be swapped. The trade-off is that it knows discs and an
//! agent's trapezoid alone. For videos of anything else there are a [`Survey`] and a [`ShapeTracker`], which
//! follow shapes of any form over a plain ground, less exactly and without headings.
//!
//! [`table()`] makes the same of positions in a table. Nothing is decoded here: no files, no video formats.
//!
//! ```
//! use phase_track::{TableOptions, table};
//!
//! let text = "time,body,x,y\n0,red,8,8\n1,red,12,8\n0,green,20,20\n1,green,20,20\n";
//! let (event, tracking) = table(text.as_bytes(), "csv", &TableOptions::default())?;
//! assert_eq!((event.steps(), tracking.frames), (4, 2));
//! assert_eq!(event.rows()[2][0].position.x, 10.0);
//! # Ok::<(), phase_track::TrackError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod arena;
mod detect;
mod error;
mod event;
mod fit;
mod picture;
mod rows;
mod shape;
mod shapes;
mod squares;
mod table;
mod tracker;
mod view;

pub use error::TrackError;
pub use event::{Role, Roles};
pub use picture::{MOST_PIXELS_ACROSS, Picture};
pub use rows::{BodyRows, FrameMeaning};
pub use shape::{Form, Pose};
pub use shapes::{Shape, ShapeTrack, ShapeTracker, Survey};
pub use table::{TableOptions, table};
pub use tracker::{Measured, Moment, Track, TrackedBody, Tracker};
pub use view::View;
