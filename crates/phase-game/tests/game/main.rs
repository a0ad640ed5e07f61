//! A whole game, told what happens and what time it is.

mod anything;
mod journal;
mod messages;
mod room;
mod support;
