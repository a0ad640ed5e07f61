//! `golden`: runs the golden tests of all crates, or rewrites the values that they compare with; also those of the engines and of
//! events as another machine.

mod machine;

use crate::error::XtaskError;
use clap::Args;
use machine::Machine;
use phase_cli::console::print_result;
use phase_golden::{BLESS, table::differences};
use std::{
    collections::{BTreeMap, BTreeSet},
    env, fs, io,
    path::{Path, PathBuf},
    process::Command,
};

/// Options of `golden`.
#[derive(Args, Debug)]
pub struct GoldenOptions {
    /// Rewrite the golden values and print every line that changed
    #[arg(long)]
    pub bless: bool,
    /// Run those of the engines, of events and of an inference as another machine does, by an emulator; compare them with the same values
    #[arg(long, value_enum, conflicts_with = "bless")]
    pub machine: Option<Machine>,
}

/// Packages whose golden tests other machines run: both engines, whole events, an inference. The one that is left needs other processes,
/// which not every machine has.
const ELSEWHERE: [&str; 4] = ["phase-forward", "phase-sim", "phase-simple", "phase-world"];

/// Runs every test named `golden` of the workspace that this program was built from. With `--bless` their files are
/// rewritten and every line that changed is printed.
///
/// # Errors
/// [`XtaskError`] if a value differs, or if a file or cargo cannot be used.
pub fn run(options: &GoldenOptions) -> Result<(), XtaskError> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    let mut packages = packages(root)?;
    if options.machine.is_some() {
        packages.retain(|package| ELSEWHERE.contains(&package.name()));
    }
    let before = tables(root, &packages)?;
    // Cargo names the executable that started this one.
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut tests = Command::new(cargo);
    tests.current_dir(root).args(["test", "--test", "golden"]);
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
    let status = tests.status().map_err(XtaskError::Cargo)?;
    if !status.success() {
        return Err(XtaskError::GoldenTests);
    }
    let after = tables(root, &packages)?;
    let changed = changes(&before, &after);
    for line in &changed {
        print_result(line);
    }
    match (options.bless, changed.is_empty()) {
        (true, true) => print_result("golden values: nothing changed"),
        (true, false) => print_result("golden values rewritten; say why in CHANGELOG.md"),
        (false, _) => print_result("golden values: all as recorded"),
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

fn packages(root: &Path) -> Result<Vec<Package>, XtaskError> {
    let mut folders = vec![root.join("xtask")];
    folders.extend(entries(&root.join("crates"))?);
    folders.retain(|folder| folder.join("tests/golden.rs").is_file());
    folders.sort();
    Ok(folders.into_iter().map(Package).collect())
}

/// The text of every golden file, by its path relative to the workspace.
fn tables(root: &Path, packages: &[Package]) -> Result<BTreeMap<String, String>, XtaskError> {
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

fn entries(folder: &Path) -> Result<Vec<PathBuf>, XtaskError> {
    let read = || fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>();
    read().map_err(|source| unreadable(folder, source))
}

fn unreadable(file: &Path, source: io::Error) -> XtaskError {
    XtaskError::Unreadable { file: file.to_owned(), source }
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
