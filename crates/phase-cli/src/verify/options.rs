//! The options of `verify`.

use crate::{output::Output, parallel::Jobs};
use clap::{Args, value_parser};
use phase_runs::verify::Checks;
use std::path::PathBuf;

/// Options of `verify`.
#[derive(Args, Debug)]
pub struct Verify {
    /// Folder of a finished dataset
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Checks beside the files themselves.
    #[command(flatten)]
    pub checks: CheckOptions,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of files at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Checks beside the files themselves.
#[derive(Args, Clone, Debug, Default)]
pub struct CheckOptions {
    /// SHA-256 of manifest.json, as gen-dataset and verify print it, from where you trust it: then no change
    /// at all goes unnoticed
    #[arg(long, value_name = "SHA256", value_parser = digest)]
    pub digest: Option<String>,
    /// Derive again what follows from the recorded actions and from the preset: motion in the engine named,
    /// labels, scenes, seeds and splits, videos, and every file that describes the whole. Takes about a
    /// second a video, and the same version of the program that made the dataset
    #[arg(long)]
    pub replay: bool,
    /// Simulate N events again, thoughts and all, and compare the bytes; `all` for all of them. Takes as long
    /// as making them
    #[arg(long, value_name = "N", value_parser = amount)]
    pub resimulate: Option<usize>,
    /// Choice of the events that --resimulate takes: another seed takes others
    #[arg(long, value_name = "S", default_value_t = 0, requires = "resimulate",
        value_parser = value_parser!(u64))]
    pub resimulate_seed: u64,
    /// File of the preset for --replay, if it is not one that comes with the program
    #[arg(long, value_name = "FILE", requires = "replay")]
    pub preset: Option<PathBuf>,
}

impl From<&CheckOptions> for Checks {
    fn from(options: &CheckOptions) -> Self {
        Self {
            digest: options.digest.clone(),
            replay: options.replay,
            resimulate: options.resimulate,
            resimulate_seed: options.resimulate_seed,
            preset: options.preset.clone(),
        }
    }
}

/// Reads a checksum.
fn digest(text: &str) -> Result<String, String> {
    let text = text.trim().to_ascii_lowercase();
    let fits = text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    if fits { Ok(text) } else { Err("a SHA-256 has 64 hexadecimal digits".into()) }
}

/// Reads a number of events, or all of them.
fn amount(text: &str) -> Result<usize, String> {
    match text {
        "all" => Ok(usize::MAX),
        _ => text.parse().map_err(|_| "a number of events is needed, or `all`".into()),
    }
}
