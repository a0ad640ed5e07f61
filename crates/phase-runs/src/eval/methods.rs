//! The methods by name. A new method is added here.

use super::{intents::IntentReader, networks};
use crate::{effort::MindChoice, error::RunError};
use phase_eval::trivial::{BeliefRule, Chance, ConstantVelocity, Stationary};
use phase_event::{BeliefReader, Forecaster, Recogniser};
use phase_files::{
    checksum::{hexadecimal, sha256},
    json,
};
use phase_simple::{IntentGuess, IntentNetwork, Models, MotionCue, Simple};
use std::{path::Path, sync::Arc};

/// Names of the methods for goals and relations beside the variants of SIMPLE.
const OTHER_RECOGNISERS: [&str; 6] =
    ["intent-network", "cue", "two-level-lstm", "arg", "socialgnn", "chance"];
/// Names of the methods for trajectories.
pub const FORECASTERS: [&str; 6] =
    ["simple", "simple-published", "social-lstm", "stgat", "constant-velocity", "still"];

/// Names of the methods for beliefs.
pub const BELIEF_READERS: [&str; 6] =
    ["simple", "belief-network", "last-seen", "own-belief", "true-state", "first-state"];

/// Names of the methods for believed intents.
pub const INTENT_READERS: [&str; 3] = ["simple-knowledge", "simple", "even"];

/// Names of the methods for goals and relations.
#[must_use]
pub fn recognisers() -> Vec<&'static str> {
    Simple::NAMES.into_iter().chain(OTHER_RECOGNISERS).collect()
}

/// Whether a method imagines minds, which can then be chosen.
#[must_use]
pub fn has_minds(name: &str) -> bool {
    Simple::NAMES.contains(&name)
}

/// A method for goals and relations; networks with the weights of a file or, without one, the bundled ones,
/// SIMPLE with these minds.
///
/// # Errors
/// If there is none of this name in this build, or the file cannot be used.
pub fn recogniser(
    name: &str,
    weights: Option<&Path>,
    minds: &MindChoice,
) -> Result<Box<dyn Recogniser>, RunError> {
    let simple = simple(name, minds)?;
    if let Some(network) = networks::recogniser(name, weights)? {
        return Ok(network);
    }
    if name == "intent-network" {
        return Ok(Box::new(intent_guess(weights)?));
    }
    no_weights(name, weights)?;
    match name {
        "chance" => Ok(Box::new(Chance)),
        "cue" => Ok(Box::new(MotionCue)),
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
    minds: &MindChoice,
) -> Result<Box<dyn Forecaster>, RunError> {
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

/// A method for beliefs; see [`recogniser`].
///
/// # Errors
/// If there is none of this name in this build, or the file cannot be used.
pub fn belief_reader(
    name: &str,
    weights: Option<&Path>,
    minds: &MindChoice,
) -> Result<Box<dyn BeliefReader>, RunError> {
    let simple = simple(name, minds)?;
    if let Some(network) = networks::belief_reader(name, weights)? {
        return Ok(network);
    }
    no_weights(name, weights)?;
    match name {
        "last-seen" => Ok(Box::new(BeliefRule::LastSeen)),
        "own-belief" => Ok(Box::new(BeliefRule::OwnBelief)),
        "true-state" => Ok(Box::new(BeliefRule::TrueState)),
        "first-state" => Ok(Box::new(BeliefRule::FirstState)),
        _ => Ok(Box::new(simple.ok_or_else(|| no_such(name))?)),
    }
}

/// A method for believed intents; see [`recogniser`]. None has weights.
pub(crate) fn intent_reader(
    name: &str,
    weights: Option<&Path>,
    minds: &MindChoice,
) -> Result<Box<IntentReader>, RunError> {
    let simple = simple(name, minds)?;
    no_weights(name, weights)?;
    Ok(Box::new(match name {
        "even" => IntentReader::Even,
        _ => IntentReader::Simple(Box::new(simple.ok_or_else(|| no_such(name))?)),
    }))
}

/// SIMPLE with these minds; `None` for other methods, for which none can be chosen.
fn simple(name: &str, minds: &MindChoice) -> Result<Option<Simple>, RunError> {
    if !has_minds(name) {
        let rule = || {
            RunError::Usage(format!("--minds, --one-way-turns, --simulations: method {name:?} has no minds"))
        };
        return if minds.is_default() { Ok(None) } else { Err(rule()) };
    }
    let simple = Simple::named(name, &Arc::new(Models::bundled()?));
    Ok(simple.map(|simple| minds.imagined_by(simple)))
}

/// The intent network alone, with the weights of a file or the bundled ones.
fn intent_guess(weights: Option<&Path>) -> Result<IntentGuess, RunError> {
    let given = weights.map(json::bytes).transpose()?;
    let bytes = given.as_deref().unwrap_or(IntentNetwork::BUNDLED_WEIGHTS);
    let file = || weights.map_or_else(|| "data/intent-network.safetensors".into(), Path::to_owned);
    let network = IntentNetwork::from_safetensors(bytes)
        .map_err(|source| RunError::IntentNetwork { file: file(), source })?;
    Ok(IntentGuess::new(Arc::new(network), hexadecimal(&sha256(bytes))))
}

fn no_weights(name: &str, weights: Option<&Path>) -> Result<(), RunError> {
    match weights {
        Some(_) => Err(RunError::Usage(format!("--weights: method {name:?} is no neural network"))),
        None => Ok(()),
    }
}

fn no_such(name: &str) -> RunError {
    RunError::Usage(format!("--method: there is no method {name:?}"))
}
