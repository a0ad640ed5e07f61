//! Rules of the page that a registry shows of a crate: a README whose example is compiled, and the keys to
//! find it by.

use super::{Package, Workspace};
use std::path::Path;

/// Its README is that of the Python package.
const PYTHON: &str = "phase-python";
/// Keys of the manifest that a published crate must have. Cargo asks for the description, registries for
/// nothing more.
const KEYS: [&str; 4] = ["description", "readme", "keywords", "categories"];

/// Every package has a README with its name and the example of its documentation, which is compiled and run.
pub(super) fn check(workspace: &mut Workspace) {
    for package in workspace.packages() {
        let root = package.folder.join("src/lib.rs");
        check_package(workspace, &package, &root);
    }
    let data = Package { name: "phase-data".into(), folder: "data".into() };
    check_package(workspace, &data, Path::new("data/lib.rs"));
}

fn check_package(workspace: &mut Workspace, package: &Package, root: &Path) {
    let name = &package.name;
    if name == PYTHON {
        return;
    }
    let manifest = package.manifest();
    let readme = package.folder.join("README.md");
    let Some(settings) = workspace.read(&manifest) else { return };
    let says = |key: &str| settings.lines().any(|line| line.starts_with(&format!("{key} = ")));
    if !says("publish") {
        for key in KEYS.into_iter().filter(|key| !says(key)) {
            workspace.report(&manifest, 1, format!("a published crate must have `{key}`"));
        }
    }
    let (Some(code), Some(text)) = (workspace.read(root), workspace.read(&readme)) else { return };
    if text.lines().next() != Some(&format!("# {name}")) {
        workspace.report(&readme, 1, format!("must begin with the heading `# {name}`"));
    }
    let documentation: Vec<&str> = code
        .lines()
        .map_while(|line| line.strip_prefix("//!"))
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .collect();
    let shown = example(text.lines(), "```rust");
    // A package of commands below `xtask/` has nothing to call.
    let may_lack = package.is_of_xtask();
    if (shown.is_empty() && !may_lack) || shown != example(documentation.into_iter(), "```") {
        workspace.report(&readme, 1, format!("must show the first example of {}", root.display()));
    }
}

/// The first block of code that opens with a fence, without lines that documentation hides and without empty
/// lines at its end.
fn example<'a>(lines: impl Iterator<Item = &'a str>, fence: &str) -> Vec<&'a str> {
    let block = lines.skip_while(|line| !line.starts_with(fence)).skip(1).take_while(|line| *line != "```");
    let mut shown: Vec<&str> = block.filter(|line| *line != "#" && !line.starts_with("# ")).collect();
    while shown.last().is_some_and(|line| line.trim().is_empty()) {
        shown.pop();
    }
    shown
}
