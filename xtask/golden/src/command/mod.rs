//! `golden`: runs the golden tests of all crates, or rewrites the values that they compare with; also those
//! of the engines and of events as another machine.

mod machine;

use crate::{BLESS, table::differences};
use clap::{Args, Parser, Subcommand};
use machine::Machine;
use std::{
    collections::{BTreeMap, BTreeSet},
    env, fs,
    io::{self, Write},
    path::{Path, PathBuf},
    process,
};
use thiserror::Error;

/// Golden values
#[derive(Parser, Debug)]
#[command(version, name = "cargo xtask", bin_name = "cargo xtask")]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Have cargo print nothing but errors
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Have cargo print more
    #[arg(long, short, global = true)]
    verbose: bool,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Run the golden tests of all crates, or rewrite the values that they compare with
    Golden(GoldenOptions),
}

/// Reason that golden values could not be compared, or are others. The text is one plain sentence.
#[derive(Debug, Error)]
pub enum GoldenError {
    /// A file or folder of the workspace cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Unreadable {
        /// The file or folder.
        file: PathBuf,
        /// Reason that the system gives.
        source: io::Error,
    },
    /// Cargo cannot be started.
    #[error("cargo cannot be started: {0}")]
    Cargo(#[source] io::Error),
    /// A golden test failed; it has reported the differences.
    #[error("golden values differ from what is computed, or their tests cannot be built; see above")]
    Tests,
}

/// Options of `golden`.
#[derive(Args, Debug)]
struct GoldenOptions {
    /// Rewrite the golden values and print every line that changed
    #[arg(long)]
    bless: bool,
    /// Run those of the engines, of events and of an inference as another machine does, by an emulator;
    /// compare them with the same values
    #[arg(long, value_enum, conflicts_with = "bless")]
    machine: Option<Machine>,
}

/// Packages whose golden tests other machines run: both engines, whole events, an inference. The one that is
/// left needs other processes, which not every machine has.
const ELSEWHERE: [&str; 4] = ["phase-forward", "phase-sim", "phase-simple", "phase-world"];

impl Cli {
    /// Runs the command.
    ///
    /// # Errors
    /// [`GoldenError`] if a value differs, or if a file or cargo cannot be used.
    pub fn run(&self) -> Result<(), GoldenError> {
        let Command::Golden(options) = &self.command;
        let verbosity = [(self.quiet, "--quiet"), (self.verbose, "--verbose")];
        run(options, verbosity.into_iter().filter_map(|(given, word)| given.then_some(word)))
    }
}

/// Runs every test named `golden` of the workspace that this program was built from. With `--bless` their
/// files are rewritten and every line that changed is printed.
///
/// # Errors
/// [`GoldenError`] if a value differs, or if a file or cargo cannot be used.
fn run(options: &GoldenOptions, verbosity: impl Iterator<Item = &'static str>) -> Result<(), GoldenError> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new("."));
    let mut packages = packages(root)?;
    if options.machine.is_some() {
        packages.retain(|package| ELSEWHERE.contains(&package.name()));
    }
    let before = tables(root, &packages)?;
    // Cargo names the executable that started this one.
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut tests = process::Command::new(cargo);
    tests.current_dir(root).args(["test", "--test", "golden"]).args(verbosity);
    for package in &packages {
        tests.args(["--package", package.name()]);
    }
    if let Some(machine) = options.machine {
        machine.prepare(root, &mut tests);
    }
    if options.bless {
        tests.env(BLESS, "1");
    } else {
        tests.env_remove(BLESS);
    }
    let status = tests.status().map_err(GoldenError::Cargo)?;
    if !status.success() {
        return Err(GoldenError::Tests);
    }
    let after = tables(root, &packages)?;
    let changed = changes(&before, &after);
    let summary = match (options.bless, changed.is_empty()) {
        (true, true) => "golden values: nothing changed",
        (true, false) => "golden values rewritten; say why in CHANGELOG.md",
        (false, _) => "golden values: all as recorded",
    };
    let mut out = io::stdout();
    for line in changed.iter().map(String::as_str).chain([summary]) {
        // A closed pipe ends nothing.
        let _ = writeln!(out, "{line}");
    }
    Ok(())
}

/// A package with golden tests, by the folder that it lies in.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Package(PathBuf);

impl Package {
    /// Packages have the names of their folders.
    fn name(&self) -> &str {
        self.0.file_name().and_then(|name| name.to_str()).unwrap_or_default()
    }
}

fn packages(root: &Path) -> Result<Vec<Package>, GoldenError> {
    let mut folders = vec![root.join("xtask")];
    folders.extend(entries(&root.join("crates"))?);
    folders.retain(|folder| folder.join("tests/golden.rs").is_file());
    folders.sort();
    Ok(folders.into_iter().map(Package).collect())
}

/// The text of every golden file, by its path relative to the workspace.
fn tables(root: &Path, packages: &[Package]) -> Result<BTreeMap<String, String>, GoldenError> {
    let mut tables = BTreeMap::new();
    for package in packages {
        let folder = package.0.join("tests/golden");
        for file in if folder.is_dir() { entries(&folder)? } else { Vec::new() } {
            let text = fs::read_to_string(&file).map_err(|source| unreadable(&file, source))?;
            let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().into_owned();
            tables.insert(name, text);
        }
    }
    Ok(tables)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, GoldenError> {
    let read = || fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>();
    read().map_err(|source| unreadable(folder, source))
}

fn unreadable(file: &Path, source: io::Error) -> GoldenError {
    GoldenError::Unreadable { file: file.to_owned(), source }
}

/// Every file that changed and the lines in which it did.
fn changes(before: &BTreeMap<String, String>, after: &BTreeMap<String, String>) -> Vec<String> {
    let names: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
    let text = |tables: &BTreeMap<String, String>, name: &str| tables.get(name).cloned().unwrap_or_default();
    let mut changes = Vec::new();
    for name in names {
        let lines = differences(&text(before, name), &text(after, name));
        if !lines.is_empty() {
            changes.push(format!("{name}:"));
            changes.extend(lines);
        }
    }
    changes
}
