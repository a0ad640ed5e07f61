//! Mean discounted returns of whole episodes on published problems, over numbers of simulations.
//!
//! ```sh
//! cargo run --release -p phase-pomcp --example anchors -- rocksample-15-15 --simulations 1024,4096
//! ```
//!
//! docs/how-to/planning.md has the results beside published ones. Episodes are spread over all threads;
//! episode k has seed `--seed` + k in every row, so that all rows share the start states, and results do not
//! depend on the number of threads.

mod episodes;
mod layouts;
mod light_dark;
mod rocksample;
mod tag;
mod tiger;
mod tour;

use clap::{Parser, ValueEnum};
use episodes::{Row, RowSettings};
use rocksample::RockSample;
use serde_json::json;
use std::{error::Error, process::ExitCode};

#[derive(Debug, Parser)]
struct Arguments {
    /// The problem.
    #[arg(value_enum)]
    problem: Name,
    /// Numbers of simulations per decision, one row each.
    #[arg(long, value_delimiter = ',', default_values_t = [64, 256, 1024])]
    simulations: Vec<usize>,
    /// Episodes per row.
    #[arg(long, default_value_t = 200)]
    episodes: u64,
    /// Seed of the first episode.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Let each search go on in the part of the tree that the last step led to.
    #[arg(long)]
    reuse: bool,
    /// The exploration rate `c_init` of the searches, in place of the problem's own.
    #[arg(long)]
    exploration: Option<f64>,
    /// Particles of a belief.
    #[arg(long, default_value_t = 1000)]
    particles: usize,
    /// Print one JSON object instead of a table.
    #[arg(long)]
    json: bool,
}

/// The problems. `layouts.rs` tells how layouts of the same size differ.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Name {
    Tiger,
    #[value(name = "rocksample-7-8")]
    RockSample7,
    #[value(name = "rocksample-11-11")]
    RockSample11,
    /// The layout of DESPOT.jl.
    #[value(name = "rocksample-15-15")]
    RockSample15,
    /// Another layout for each episode, with uniformly sampled rocks.
    #[value(name = "rocksample-15-15-random")]
    RockSample15Random,
    Tag,
    /// Observations are real numbers, and branches widen progressively.
    LightDark,
    /// Every observation has a branch of its own.
    LightDarkUnwidened,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error + Send + Sync>> {
    let name =
        arguments.problem.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
    if !arguments.json {
        println!("{name}: mean discounted return of {} episodes, 95 % interval", arguments.episodes);
        println!("simulations          return  simulations/s");
    }
    let mut rows = Vec::new();
    for &simulations in &arguments.simulations {
        let settings = RowSettings {
            simulations,
            episodes: arguments.episodes,
            seed: arguments.seed,
            reuse: arguments.reuse,
            exploration: arguments.exploration,
            particles: arguments.particles,
        };
        let row = row(arguments.problem, &settings)?;
        if !arguments.json {
            let Row { mean, half_width, speed, .. } = row;
            // One episode has no interval.
            let half_width = if half_width.is_nan() { "–".into() } else { format!("{half_width:.2}") };
            println!("{simulations:11}  {mean:6.2} ± {half_width:>5}  {speed:13.0}");
        }
        rows.push(row);
    }
    if arguments.json {
        let rows: Vec<_> = rows
            .iter()
            .map(|row| {
                json!({
                    "simulations": row.simulations,
                    "mean": row.mean,
                    "half_width_95": row.half_width,
                    "simulations_per_second": row.speed,
                    "steps_per_episode": row.steps,
                })
            })
            .collect();
        let Arguments { episodes, seed, reuse, exploration, particles, .. } = *arguments;
        let printed = json!({
            "problem": name, "episodes": episodes, "seed": seed, "reuse": reuse,
            "exploration": exploration, "particles": particles, "rows": rows,
        });
        println!("{printed}");
    }
    Ok(())
}

fn row(name: Name, settings: &RowSettings) -> Result<Row, Box<dyn Error + Send + Sync>> {
    match name {
        Name::Tiger => settings.row(|_| tiger::Tiger),
        Name::RockSample7 => settings.row(|_| RockSample::new(&layouts::SARSOP_7_8)),
        Name::RockSample11 => settings.row(|_| RockSample::new(&layouts::SARSOP_11_11)),
        Name::RockSample15 => settings.row(|_| RockSample::new(&layouts::DESPOT_JL_15_15)),
        Name::RockSample15Random => settings.row(|random| RockSample::new(layouts::random(15, random))),
        Name::Tag => settings.row(|_| tag::Tag::new()),
        Name::LightDark => settings.row(|_| light_dark::LightDark::new(true)),
        Name::LightDarkUnwidened => settings.row(|_| light_dark::LightDark::new(false)),
    }
}
