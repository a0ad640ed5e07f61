//! Tests of phase-render, one module for each of the crate's; together in one binary so that they share a
//! scene to draw and a reader of .mp4 boxes.

mod captions;
mod common;
mod font;
mod layouts;
mod legend;
mod mp4;
mod overlay;
mod palettes;
mod sheet;
mod stage;
mod video;
mod yuv;
