//! Places of results: not in the folder of a dataset, which holds what its manifest says and nothing
//! else.

use clap::ArgMatches;
use phase_dataset::manifest::{DATASET_FORMAT, MANIFEST_FILE};
use std::path::{Path, PathBuf};

/// The name of the option for a file or folder of results.
const OUT: &str = "out";

/// Checks that the results of a command do not lie within a dataset. `matches` are those of a program.
///
/// # Errors
/// A sentence.
pub(crate) fn check(matches: &ArgMatches) -> Result<(), String> {
    let mut leaf = matches;
    while let Some((_, inner)) = leaf.subcommand() {
        leaf = inner;
    }
    let Ok(Some(out)) = leaf.try_get_one::<PathBuf>(OUT) else { return Ok(()) };
    match out.ancestors().skip(1).find_map(place) {
        Some(parent) => outside(out, &parent),
        None => Ok(()),
    }
}

/// Checks that a folder to which files are added is not that of a dataset.
///
/// # Errors
/// A sentence.
pub(crate) fn check_itself(out: &Path) -> Result<(), String> {
    place(out).map_or(Ok(()), |folder| outside(out, &folder))
}

/// The path of a folder that exists, without links.
fn place(folder: &Path) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.canonicalize().ok()
}

fn outside(out: &Path, folder: &Path) -> Result<(), String> {
    match folder.ancestors().find(|folder| is_dataset(folder)) {
        Some(dataset) => {
            let rule = "which holds what its manifest says and nothing else; choose another place";
            Err(format!("--out {}: would lie in the dataset {}, {rule}", out.display(), dataset.display()))
        }
        None => Ok(()),
    }
}

/// Other programs have files of this name, too.
fn is_dataset(folder: &Path) -> bool {
    let manifest = phase_files::json::read(&folder.join(MANIFEST_FILE));
    manifest.is_ok_and(|manifest| manifest["format"] == DATASET_FORMAT)
}
