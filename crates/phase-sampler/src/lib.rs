//! Scenes for every kind of PHASE event.
