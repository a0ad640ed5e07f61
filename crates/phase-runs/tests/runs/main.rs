//! Commands as functions, tested module by module.

mod captions;
mod effort;
mod render;
mod scenes;
mod track;
