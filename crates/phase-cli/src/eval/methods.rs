//! The methods by name. A new method is added here.

use super::{
    intent_guess::IntentGuess,
    networks,
    simple::{Cue, Simple},
};
use crate::{effort::MindOptions, error::CliError};
use phase_eval::{
    Forecaster, Recogniser,
    trivial::{Chance, ConstantVelocity, Stationary},
};
use std::path::Path;

/// Names of the methods for goals and relations.
pub const RECOGNISERS: [&str; 16] = [
    "simple",
    "simple-unguided",
    "simple-points",
    "simple-initial",
    "simple-global",
    "simple-local",
    "simple-published",
    "simple-published-global",
    "simple-published-initial",
    "simple-published-dynamics",
    "intent-network",
    "cue",
    "two-level-lstm",
    "arg",
    "socialgnn",
    "chance",
];
/// Names of the methods for trajectories.
pub const FORECASTERS: [&str; 6] =
    ["simple", "simple-published", "social-lstm", "stgat", "constant-velocity", "still"];

/// A method for goals and relations; networks with the weights of a file or, without one, the bundled ones, SIMPLE with these
/// minds.
///
/// # Errors
/// If there is none of this name in this build, or the file cannot be used.
pub fn recogniser(
    name: &str,
    weights: Option<&Path>,
    minds: &MindOptions,
) -> Result<Box<dyn Recogniser>, CliError> {
    let simple = simple(name, minds)?;
    if let Some(network) = networks::recogniser(name, weights)? {
        return Ok(network);
    }
    if name == "intent-network" {
        return Ok(Box::new(IntentGuess::open(weights)?));
    }
    no_weights(name, weights)?;
    match name {
        "chance" => Ok(Box::new(Chance)),
        "cue" => Ok(Box::new(Cue)),
        _ => Ok(Box::new(simple.ok_or_else(|| no_such(name))?)),
    }
}

/// A method for trajectories; see [`recogniser`].
///
/// # Errors
/// If there is none of this name in this build, or the file cannot be used.
pub fn forecaster(
    name: &str,
    weights: Option<&Path>,
    minds: &MindOptions,
) -> Result<Box<dyn Forecaster>, CliError> {
    let simple = simple(name, minds)?;
    if let Some(network) = networks::forecaster(name, weights)? {
        return Ok(network);
    }
    no_weights(name, weights)?;
    match name {
        "constant-velocity" => Ok(Box::new(ConstantVelocity)),
        "still" => Ok(Box::new(Stationary)),
        _ => Ok(Box::new(simple.ok_or_else(|| no_such(name))?)),
    }
}

/// SIMPLE with these minds; `None` for other methods, for which none can be chosen.
fn simple(name: &str, minds: &MindOptions) -> Result<Option<Simple>, CliError> {
    match Simple::of(name) {
        None if !minds.are_default() => {
            Err(CliError::Usage(format!("--minds, --one-way-turns: method {name:?} has no minds")))
        }
        simple => Ok(simple.map(|simple| simple.with_minds(minds))),
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
