//! Faults on demand: a program that stops, or finds its disk full, at a chosen step of writing its files.
//!
//! The environment variable [`VARIABLE`] asks for one: `kill@N` ends the process at step N as a signal would,
//! with nothing put in order; `full@N` makes step N and all later ones fail as on a full disk. Every file
//! takes four steps: to create it, to write and sync it, to give it its name, and to go on from there;
//! removing something takes one. Without the variable, and it is never set but by tests, nothing happens.

use std::{
    io,
    sync::{
        OnceLock,
        atomic::{AtomicU64, Ordering},
    },
};

/// Name of the environment variable.
pub const VARIABLE: &str = "PHASE_FAULT";
/// The exit code of a process that was ended, which is that of one killed by a signal.
pub const KILLED: i32 = 137;

#[derive(Clone, Copy, Debug)]
enum Fault {
    Kill(u64),
    Full(u64),
}

impl Fault {
    fn of_environment() -> Option<Self> {
        let text = std::env::var(VARIABLE).ok()?;
        let (what, number) = text.split_once('@')?;
        let number = number.parse().ok()?;
        match what {
            "kill" => Some(Self::Kill(number)),
            "full" => Some(Self::Full(number)),
            _ => None,
        }
    }
}

/// A step of writing.
///
/// # Errors
/// That the disk is full, if such a fault was asked for.
pub(crate) fn step() -> io::Result<()> {
    static FAULT: OnceLock<Option<Fault>> = OnceLock::new();
    static STEPS: AtomicU64 = AtomicU64::new(0);
    let Some(fault) = FAULT.get_or_init(Fault::of_environment) else { return Ok(()) };
    let number = STEPS.fetch_add(1, Ordering::Relaxed) + 1;
    match *fault {
        Fault::Kill(at) if number == at => std::process::exit(KILLED),
        Fault::Full(at) if number >= at => Err(io::ErrorKind::StorageFull.into()),
        _ => Ok(()),
    }
}
