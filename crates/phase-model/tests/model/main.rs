//! The vocabulary, tested module by module.

mod definitions;
mod geometry;
mod id;
mod json;
mod judgement;
mod layout;
mod path;
mod random;
mod scene;
mod scene_json;
mod warnings;
mod words;
