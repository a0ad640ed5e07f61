//! The sets of scenes that come with the source.

use clap::ValueEnum;
use std::path::{Path, PathBuf};

/// A choice among the bundled scenes.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum SceneSet {
    /// Designed by hand: data/behaviour
    #[default]
    First,
    /// Drawn from the sampler: data/behaviour-drawn
    Drawn,
    /// Both
    All,
}

impl SceneSet {
    /// The name used on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Drawn => "drawn",
            Self::All => "all",
        }
    }

    /// The folders of the scenes, each with one file for each part of the table.
    #[must_use]
    pub fn folders(self) -> Vec<PathBuf> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new("."));
        let names = match self {
            Self::First => &["data/behaviour"][..],
            Self::Drawn => &["data/behaviour-drawn"],
            Self::All => &["data/behaviour", "data/behaviour-drawn"],
        };
        names.iter().map(|name| root.join(name)).collect()
    }
}
