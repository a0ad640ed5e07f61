//! Tests of phase-render, one module for each of the crate's; together in one binary so that they share a
//! scene to draw and a reader of .mp4 boxes.

mod common;
mod font;
mod mp4;
mod overlay;
mod sheet;
mod stage;
mod video;
mod yuv;
