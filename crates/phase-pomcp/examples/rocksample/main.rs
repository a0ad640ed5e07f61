//! RockSample[7,8] (Smith & Simmons 2004): returns of whole episodes with growing numbers of simulations.
//!
//! Run it with `cargo run --release -p phase-pomcp --example rocksample -- [EPISODES [SEED]]`.

mod problem;
#[path = "../support/mod.rs"]
mod support;

use phase_pomcp::{PomcpError, PomcpSettings};
use problem::RockSample;

/// The advantage of checking is a few hundredths of the best rock's reward, so a small exploration rate is
/// needed.
const SETTINGS: PomcpSettings = PomcpSettings {
    stop_when_decided: false,
    convergence: 0.0,
    untried_first: true,
    batch: 1,
    simulations: 1000,
    rollout_steps: 30,
    c_init: 0.5,
    c_base: 1e6,
    horizon: usize::MAX,
    normalise_values: true,
};

fn main() -> Result<(), PomcpError> {
    let (episodes, seed) = support::arguments(500);
    support::table(&RockSample, SETTINGS, &[16, 64, 256, 1024, 4096, 16384], episodes, seed)?;
    println!(
        "published (Silver & Veness 2010): POMCP 20.71 ± 0.21, AEMS2 21.37, HSVI-BFS 21.46, SARSOP 21.39"
    );
    Ok(())
}
