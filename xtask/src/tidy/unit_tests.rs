//! Nothing is built a second time for tests that it does not have, and no test is left out.

use super::{Package, Workspace};
use std::path::PathBuf;

/// Every library without unit tests says so, and nothing that says so has any.
pub(super) fn check(workspace: &mut Workspace) {
    for package in workspace.all_packages() {
        if !has_library(workspace, &package) {
            continue;
        }
        let tests = tests_of(workspace, &package);
        let (of_program, of_library): (Vec<_>, Vec<_>) =
            tests.into_iter().partition(|(file, _)| file.ends_with("src/main.rs"));
        let manifest = package.manifest();
        let text = workspace.read(&manifest).unwrap_or_default();
        for (header, tests) in [("[lib]", &of_library), ("[[bin]]", &of_program)] {
            if is_not_tested(&text, header) {
                for (file, line) in tests {
                    let rule = format!("is not run: {header} of {} says `test = false`", manifest.display());
                    workspace.report(file, *line, rule);
                }
            }
        }
        if of_library.is_empty() && !is_not_tested(&text, "[lib]") {
            workspace.report(&manifest, 1, "a library without unit tests must say `test = false`");
        }
    }
}

/// Files and lines of the unit tests of a package.
fn tests_of(workspace: &mut Workspace, package: &Package) -> Vec<(PathBuf, usize)> {
    let mut tests = Vec::new();
    let mut files = workspace.files(&[&package.folder.join("src").to_string_lossy()], &[".rs"]);
    let beside = package.folder.join("lib.rs");
    files.extend(workspace.root.join(&beside).is_file().then_some(beside));
    for file in files {
        let Some(text) = workspace.read(&file) else { continue };
        let lines = (1..).zip(text.lines()).filter(|(_, line)| line.trim() == "#[test]");
        tests.extend(lines.map(|(number, _)| (file.clone(), number)));
    }
    tests
}

/// Whether the section of a manifest that begins with this header says that there is nothing to test.
fn is_not_tested(manifest: &str, header: &str) -> bool {
    let section = manifest.lines().skip_while(|line| *line != header).skip(1);
    section.take_while(|line| !line.starts_with('[')).any(|line| line == "test = false")
}

fn has_library(workspace: &Workspace, package: &Package) -> bool {
    ["src/lib.rs", "lib.rs"].iter().any(|name| workspace.root.join(package.folder.join(name)).is_file())
}
