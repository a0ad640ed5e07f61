//! Tracks of videos, tested module by module.

mod shapes;
mod table;
mod video;
