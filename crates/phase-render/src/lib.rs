//! PHASE events as frames and video.
//!
//! A [`SceneRenderer`] knows what does not change in an event (walls, landmarks, radii, colours) and turns
//! each [`phase_model::State`] into a [`Frame`]; a [`VideoEncoder`] turns frames into an H.264 .mp4 that
//! browsers play and seek in. With an [`Overlay`] a frame also shows what one agent sees and believes, and
//! [`side_by_side`] joins the views of both. Text is drawn in an embedded font ([`SizedFont`]); colours are a
//! [`Palette`].
//!
//! Key design decision: pixels are the whole interface. Drawing and encoding meet in a [`Frame`] and do not
//! depend on each other, and neither accesses a file or a clock. Everything is drawn and encoded on one
//! thread in a fixed order, so the same states give the same bytes. The trade-off is that a frame costs a
//! full picture in memory, and that one video cannot use more than one core; many videos can.
//!
//! ```
//! use phase_model::{AgentBody, Body, PhysicsConfig, State, Vec2};
//! use phase_render::{SceneRenderer, Style, VideoEncoder};
//!
//! let agent = AgentBody { radius: 0.8, max_force: 300.0 };
//! let physics =
//!     PhysicsConfig { walls: vec![], agents: [agent; 2], object_radii: [0.0; 2], object_count: 0 };
//! let renderer = SceneRenderer::new(&physics, Style::default())?;
//! let mut video = VideoEncoder::new(Vec::new(), renderer.width(), renderer.height(), 20)?;
//! for tick in 0..3 {
//!     let mut state = State::new([Body::default(); 4]);
//!     state.bodies[0] = Body::at_rest(Vec2::new(10.0 + tick as f32, 8.0), 0.0);
//!     state.bodies[1] = Body::at_rest(Vec2::new(20.0, 16.0), 1.0);
//!     video.push(&renderer.frame(&state, None))?;
//! }
//! let mp4: Vec<u8> = video.finish()?;
//! assert_eq!(&mp4[4..8], b"ftyp");
//! # Ok::<(), phase_render::RenderError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod annotation;
pub mod caption;
pub mod error;
pub mod font;
pub mod frame;
pub mod layouts;
pub mod legend;
pub mod overlay;
pub mod palette;
pub mod renderer;
pub mod sheet;
pub mod style;
pub mod text;
#[cfg(feature = "video")]
pub mod video;
#[cfg(feature = "video")]
pub mod yuv;

mod bodies;
mod painter;

pub use annotation::{Annotation, Course};
pub use caption::Caption;
pub use error::RenderError;
pub use frame::Frame;
pub use layouts::layout_chart;
pub use overlay::Overlay;
pub use palette::{Colour, Palette, PaletteName};
pub use renderer::SceneRenderer;
pub use sheet::{contact_sheet, side_by_side};
pub use style::Style;
pub use text::SizedFont;
#[cfg(feature = "video")]
pub use video::VideoEncoder;
