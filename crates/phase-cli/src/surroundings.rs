//! Places of results: not in the folder of a dataset, which holds what its manifest says and nothing
//! else.

use clap::ArgMatches;
use phase_dataset::manifest::{DATASET_FORMAT, MANIFEST_FILE};
use std::path::{Path, PathBuf};

/// The name that means stdout where a file may be named.
pub(crate) const STDOUT: &str = "-";
/// The options that name files or folders of results.
const OUTPUTS: [&str; 5] = ["out", "json", "figures", "make", "shapes"];

/// Checks that the results of a command do not lie within a dataset. `matches` are those of a program.
///
/// # Errors
/// A sentence.
pub(crate) fn check(matches: &ArgMatches) -> Result<(), String> {
    let mut leaf = matches;
    while let Some((_, inner)) = leaf.subcommand() {
        leaf = inner;
    }
    for option in OUTPUTS {
        let Ok(Some(out)) = leaf.try_get_one::<PathBuf>(option) else { continue };
        if out == Path::new(STDOUT) {
            continue;
        }
        if let Some(parent) = out.ancestors().skip(1).find_map(place) {
            outside(option, out, &parent)?;
        }
    }
    Ok(())
}

/// Checks that a folder to which files are added is not that of a dataset.
///
/// # Errors
/// A sentence.
pub(crate) fn check_itself(out: &Path) -> Result<(), String> {
    place(out).map_or(Ok(()), |folder| outside("out", out, &folder))
}

/// Whether a file lies in a folder, not in one below it.
pub(crate) fn is_in(file: &Path, folder: &Path) -> bool {
    place(folder).is_some_and(|folder| file.parent().and_then(place) == Some(folder))
}

/// The path of a folder that exists, without links.
fn place(folder: &Path) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.canonicalize().ok()
}

fn outside(option: &str, out: &Path, folder: &Path) -> Result<(), String> {
    match folder.ancestors().find(|folder| is_dataset(folder)) {
        Some(dataset) => {
            let rule = "which holds what its manifest says and nothing else; choose another place";
            Err(format!(
                "--{option} {}: would lie in the dataset {}, {rule}",
                out.display(),
                dataset.display()
            ))
        }
        None => Ok(()),
    }
}

/// Other programs have files of this name, too.
fn is_dataset(folder: &Path) -> bool {
    let manifest = phase_files::json::read(&folder.join(MANIFEST_FILE));
    manifest.is_ok_and(|manifest| manifest["format"] == DATASET_FORMAT)
}
