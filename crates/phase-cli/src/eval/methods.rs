//! The methods by name. A new method is added here.

use super::{
    networks,
    simple::{Cue, Simple},
};
use crate::error::CliError;
use phase_eval::{
    Forecaster, Recogniser,
    trivial::{Chance, ConstantVelocity, Stationary},
};
use std::path::Path;

/// Names of the methods for goals and relations.
pub const RECOGNISERS: [&str; 9] = [
    "simple",
    "simple-initial",
    "simple-global",
    "simple-local",
    "simple-published",
    "cue",
    "two-level-lstm",
    "arg",
    "chance",
];
/// Names of the methods for trajectories.
pub const FORECASTERS: [&str; 6] =
    ["simple", "simple-published", "social-lstm", "stgat", "constant-velocity", "still"];

/// A method for goals and relations; networks with the weights of a file or, without one, the bundled ones.
///
/// # Errors
/// If there is none of this name in this build, or the file cannot be used.
pub fn recogniser(name: &str, weights: Option<&Path>) -> Result<Box<dyn Recogniser>, CliError> {
    if let Some(network) = networks::recogniser(name, weights)? {
        return Ok(network);
    }
    no_weights(name, weights)?;
    match name {
        "chance" => Ok(Box::new(Chance)),
        "cue" => Ok(Box::new(Cue)),
        _ => Ok(Box::new(Simple::of(name).ok_or_else(|| no_such(name))?)),
    }
}

/// A method for trajectories; see [`recogniser`].
///
/// # Errors
/// If there is none of this name in this build, or the file cannot be used.
pub fn forecaster(name: &str, weights: Option<&Path>) -> Result<Box<dyn Forecaster>, CliError> {
    if let Some(network) = networks::forecaster(name, weights)? {
        return Ok(network);
    }
    no_weights(name, weights)?;
    match name {
        "constant-velocity" => Ok(Box::new(ConstantVelocity)),
        "still" => Ok(Box::new(Stationary)),
        _ => Ok(Box::new(Simple::of(name).ok_or_else(|| no_such(name))?)),
    }
}

fn no_weights(name: &str, weights: Option<&Path>) -> Result<(), CliError> {
    match weights {
        Some(_) => Err(CliError::Usage(format!("--weights: method {name:?} is no neural network"))),
        None => Ok(()),
    }
}

fn no_such(name: &str) -> CliError {
    CliError::Usage(format!("--method: there is no method {name:?}"))
}
