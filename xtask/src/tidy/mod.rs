//! `tidy`: project rules that the compiler cannot check.

mod figures;
mod layers;
mod modules;
mod readmes;
mod scan;
mod sources;
pub(crate) mod texts;
mod unit_tests;
mod words;

pub use layers::layers;

use crate::{error::XtaskError, results::root};
use clap::Args;
use phase_cli::{console::print_message, output::print_result};
use scan::Source;
use std::{
    fmt, fs, io,
    path::{Path, PathBuf},
};

/// A rule that is broken somewhere.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Finding {
    /// The file, relative to the workspace.
    pub file: PathBuf,
    /// The line, from 1.
    pub line: usize,
    /// The rule that is broken, in a sentence.
    pub rule: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}: {}", self.file.display(), self.line, self.rule)
    }
}

/// Options of `tidy`.
#[derive(Args, Debug)]
pub struct Tidy {
    /// Print figures of every package (lines, tests, documentation) beside their goals, and check nothing
    #[arg(long)]
    pub figures: bool,
}

/// Runs the command on the workspace this program was built from.
///
/// # Errors
/// [`XtaskError::Untidy`] if a rule is broken.
pub fn run(options: &Tidy) -> Result<(), XtaskError> {
    if options.figures {
        print_result(figures::table(&mut Workspace { root: root().to_owned(), findings: Vec::new() }))?;
        return Ok(());
    }
    let findings = check(root());
    for finding in &findings {
        print_message(finding);
    }
    if findings.is_empty() {
        print_result("tidy")?;
        Ok(())
    } else {
        Err(XtaskError::Untidy(findings.len()))
    }
}

/// Everything that is wrong in a workspace, in the order of files and lines.
#[must_use]
pub fn check(root: &Path) -> Vec<Finding> {
    let mut workspace = Workspace { root: root.to_owned(), findings: Vec::new() };
    layers::check(&mut workspace);
    modules::check(&mut workspace);
    readmes::check(&mut workspace);
    sources::check(&mut workspace);
    texts::check(&mut workspace);
    unit_tests::check(&mut workspace);
    words::check(&mut workspace);
    let mut findings = workspace.findings;
    findings.sort();
    findings.dedup();
    findings
}

/// The folder of chores, with packages of people who work on PHASE below it.
const XTASK: &str = "xtask";
/// A manifest without code, so it has no layer.
const NO_CODE: &str = "workspace-hack";

/// A package of the workspace.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Package {
    name: String,
    /// Relative to the workspace.
    folder: PathBuf,
}

impl Package {
    fn manifest(&self) -> PathBuf {
        self.folder.join("Cargo.toml")
    }

    /// Whether it may still break a rule: `exempt.txt` has a line for each package and rule.
    fn is_exempt(&self, rule: &str) -> bool {
        include_str!("exempt.txt").lines().any(|line| line == format!("{} {rule}", self.name))
    }

    /// Whether it is below `xtask/`, so that only people who work on PHASE have it.
    fn is_of_xtask(&self) -> bool {
        self.folder.starts_with(XTASK)
    }
}

/// A workspace and what was found in it so far.
struct Workspace {
    root: PathBuf,
    findings: Vec<Finding>,
}

impl Workspace {
    fn report(&mut self, file: impl Into<PathBuf>, line: usize, rule: impl Into<String>) {
        self.findings.push(Finding { file: file.into(), line, rule: rule.into() });
    }

    /// The text of a file. An unreadable file is a finding; then nothing else is reported for it.
    fn read(&mut self, file: &Path) -> Option<String> {
        let text = fs::read_to_string(self.root.join(file));
        text.map_err(|error| self.report(file, 1, format!("cannot be read: {error}"))).ok()
    }

    /// The packages in `crates/`, and those in `xtask/`, which `phase-` precedes in their names, sorted.
    fn packages(&self) -> Vec<Package> {
        let mut packages = Vec::new();
        for (parent, prefix) in [("crates", ""), (XTASK, "phase-")] {
            let entries = fs::read_dir(self.root.join(parent)).into_iter().flatten().flatten();
            for entry in entries.filter(|entry| entry.path().join("Cargo.toml").is_file()) {
                let name = entry.file_name().to_string_lossy().into_owned();
                let folder = Path::new(parent).join(&name);
                packages.push(Package { name: format!("{prefix}{name}"), folder });
            }
        }
        packages.retain(|package| package.folder.file_name() != Some(NO_CODE.as_ref()));
        packages.sort();
        packages
    }

    /// All packages whose Rust files are checked and counted: those of `packages`, and those at the root.
    fn all_packages(&self) -> Vec<Package> {
        let mut packages = self.packages();
        for (name, folder) in [("phase-data", "data"), ("phase-benches", "benches"), (XTASK, XTASK)] {
            packages.push(Package { name: name.to_owned(), folder: folder.into() });
        }
        packages
    }

    /// The Rust files of a package, without those of packages in its folder.
    fn sources(&mut self, package: &Package) -> Vec<Source> {
        let folder = package.folder.to_string_lossy();
        let folders = ["src", "tests", "examples", "benches"].map(|name| format!("{folder}/{name}"));
        let mut files = self.files(&folders.each_ref().map(String::as_str), &[".rs"]);
        let beside = ["lib.rs", "build.rs"].map(|name| package.folder.join(name));
        files.extend(beside.into_iter().filter(|file| self.root.join(file).is_file()));
        files.into_iter().filter_map(|file| Some(Source::new(&file, self.read(&file)?))).collect()
    }

    /// All files with one of these endings below some folders, relative to the workspace, sorted.
    fn files(&self, folders: &[&str], endings: &[&str]) -> Vec<PathBuf> {
        let mut found = Vec::new();
        for folder in folders {
            // A folder that is not there holds no files.
            let _ = walk(&self.root.join(folder), &mut found);
        }
        let mut files: Vec<PathBuf> = found
            .into_iter()
            .filter(|file| endings.iter().any(|ending| file.to_string_lossy().ends_with(ending)))
            .filter_map(|file| file.strip_prefix(&self.root).map(Path::to_owned).ok())
            .collect();
        files.sort();
        files
    }
}

/// Adds all files below a folder.
pub(crate) fn walk(folder: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() { walk(&path, found)? } else { found.push(path) }
    }
    Ok(())
}
