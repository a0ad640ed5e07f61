//! Rules of Rust files: required attributes, forbidden words, length.

use super::Workspace;
use std::path::Path;

/// Maximum length of a Rust file (lines).
const LONGEST: usize = 400;
/// The one file that may know the cache's encoding.
const CACHE: &str = "crates/phase-files/src/cache.rs";
/// Attributes that every crate root must contain.
const ROOT_ATTRIBUTES: [&str; 2] = ["#![forbid(unsafe_code)]", "#![deny(missing_docs)]"];

/// Checks every Rust file of crates and command line.
pub(super) fn check(workspace: &mut Workspace) {
    let packages = workspace.packages();
    let roots = packages.iter().map(|package| package.folder.join("src/lib.rs"));
    for root in roots.chain(["xtask/src/lib.rs".into(), "xtask/src/main.rs".into()]) {
        let Some(text) = workspace.read(&root) else { continue };
        for attribute in ROOT_ATTRIBUTES {
            if !text.lines().any(|line| line == attribute) {
                workspace.report(&root, 1, format!("the crate root must say {attribute}"));
            }
        }
    }
    for file in workspace.files(&["crates", "xtask", "benches"], &[".rs"]) {
        check_file(workspace, &file);
    }
}

fn check_file(workspace: &mut Workspace, file: &Path) {
    // Split in two, so that this file does not match itself.
    let unfinished = [concat!("todo", "!("), concat!("dbg", "!("), concat!("unimplemented", "!(")];
    let encoding = concat!("bin", "code");
    let Some(text) = workspace.read(file) else { return };
    let lines = text.lines().count();
    if lines > LONGEST {
        workspace.report(file, LONGEST + 1, format!("has {lines} lines; more than {LONGEST} is too long"));
    }
    for (line_number, line) in (1..).zip(text.lines()) {
        if line.contains('\t') {
            workspace.report(file, line_number, "holds a tab; indent with spaces");
        }
        if line.ends_with(' ') {
            workspace.report(file, line_number, "ends in a space");
        }
        if let Some(word) = unfinished.into_iter().find(|word| line.contains(word)) {
            workspace.report(file, line_number, format!("{}…) must not stay", word));
        }
        if line.contains(encoding) && file != Path::new(CACHE) {
            workspace.report(file, line_number, format!("only {CACHE} may know of {encoding}"));
        }
    }
}
