//! Runs of a target without coverage guidance, on any toolchain.

use crate::{mutate::mutated, seeds::seeds, targets::Check};
use phase_model::random::{Purpose, stream};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// An input on which a target panicked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Failure {
    /// The input.
    pub input: Vec<u8>,
    /// Message of the panic.
    pub message: String,
}

/// Runs a target once.
///
/// # Errors
/// If it panics.
pub fn run_once(check: Check, input: &[u8]) -> Result<(), Failure> {
    catch_unwind(AssertUnwindSafe(|| check(input))).map_err(|panic| {
        let message = panic.downcast_ref::<String>().cloned();
        let message = message.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        Failure { input: input.to_vec(), message: message.unwrap_or_default() }
    })
}

/// Runs a target on its seeds and on a corpus, and then on random mutations of both until `goes_on` returns
/// false. Returns the number of executions.
///
/// # Errors
/// The first failure.
pub fn run(
    (name, check): (&str, Check),
    corpus: Vec<Vec<u8>>,
    seed: u64,
    mut goes_on: impl FnMut() -> bool,
) -> Result<u64, Failure> {
    let mut inputs = seeds(name);
    inputs.extend(corpus);
    let mut executions = 0;
    for input in &inputs {
        run_once(check, input)?;
        executions += 1;
    }
    let mut random = stream(seed, Purpose::Scene, 0);
    while goes_on() {
        run_once(check, &mutated(&inputs, &mut random))?;
        executions += 1;
    }
    Ok(executions)
}
