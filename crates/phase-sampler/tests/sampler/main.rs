//! Scenes, tested module by module.

mod contrast;
mod recipe;
mod stage;
