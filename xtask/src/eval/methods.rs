//! The methods there are, by name. Whoever has a new one adds its name and a line here.

use super::simple::{Cue, Simple};
use phase_eval::{
    Forecaster, Recogniser,
    plain::{Chance, ConstantVelocity, Still},
};

/// Names of the methods for goals and relations.
pub const RECOGNISERS: [&str; 7] =
    ["simple", "simple-initial", "simple-global", "simple-local", "simple-published", "cue", "chance"];
/// Names of the methods for trajectories.
pub const FORECASTERS: [&str; 4] = ["simple", "simple-published", "constant-velocity", "still"];

/// A method for goals and relations; `None` if there is none of this name.
#[must_use]
pub fn recogniser(name: &str) -> Option<Box<dyn Recogniser>> {
    match name {
        "chance" => Some(Box::new(Chance)),
        "cue" => Some(Box::new(Cue)),
        _ => Simple::of(name).map(|simple| Box::new(simple) as Box<dyn Recogniser>),
    }
}

/// A method for trajectories; `None` if there is none of this name.
#[must_use]
pub fn forecaster(name: &str) -> Option<Box<dyn Forecaster>> {
    match name {
        "constant-velocity" => Some(Box::new(ConstantVelocity)),
        "still" => Some(Box::new(Still)),
        _ => Simple::of(name).map(|simple| Box::new(simple) as Box<dyn Forecaster>),
    }
}
