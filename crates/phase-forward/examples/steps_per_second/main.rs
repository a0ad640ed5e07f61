//! Steps a second of the kernel and of rapier2d, on one core.
//!
//! `cargo run --release -p phase-forward --example steps_per_second -- [--json] [EVENTS.json]`
//!
//! From states of six events, one of each kind, simulated here, and of the recordings of a file if one is
//! given: eight worlds begin in each state, and in each of them both agents act at random for ten steps. What
//! is stepped is the same in every column. Time is that of the processor where the system reports it.

mod measure;
mod starts;

use measure::{Rates, measure};
use std::path::Path;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let json = arguments.iter().any(|argument| argument == "--json");
    let file = arguments.iter().find(|argument| !argument.starts_with("--"));
    let mut reports = vec![("generated", measure(&starts::generated()))];
    if let Some(file) = file {
        match starts::recorded(Path::new(file)) {
            Ok(recorded) => reports.push(("recordings", measure(&recorded))),
            Err(error) => {
                eprintln!("error: {error}");
                std::process::exit(2);
            }
        }
    }
    if json {
        let report: serde_json::Map<String, serde_json::Value> =
            reports.iter().map(|(name, rates)| ((*name).to_owned(), rates.to_json())).collect();
        println!("{}", serde_json::Value::Object(report));
        return;
    }
    println!("steps a second, one core, random actions, eight worlds from each state");
    for (name, Rates { exact, coarse, rapier, states }) in &reports {
        println!("{name} ({states} states)");
        println!("  exact:  {exact:>9.0}");
        println!("  coarse: {coarse:>9.0}");
        println!("  rapier: {rapier:>9.0}");
    }
}
