//! Checks of the documents.

use super::Workspace;
use std::path::{Component, Path, PathBuf};

const README: &str = "README.md";
const CI: &str = ".ci/run";
/// The two commands given to newcomers.
const COMMANDS: [&str; 2] = ["cargo xtask gen-dataset", "cargo test --workspace"];

/// Checks commands, links and lines of the documents.
pub(super) fn check(workspace: &mut Workspace) {
    let mut read = |file: &str| workspace.read(Path::new(file)).unwrap_or_default();
    let (readme, ci) = (read(README), read(CI));
    for command in COMMANDS {
        if !readme.lines().any(|line| line == command) {
            workspace.report(README, 1, format!("must show the command `{command}` on a line of its own"));
        }
        if !ci.lines().any(|line| line.trim() == command || line.starts_with(&format!("{command} "))) {
            workspace.report(CI, 1, format!("must run the README's command `{command}`"));
        }
    }
    let mut documents = workspace.files(&["docs"], &[".md"]);
    documents.push(README.into());
    for document in documents {
        let Some(text) = workspace.read(&document) else { continue };
        for (k, line) in text.lines().enumerate() {
            if line.ends_with([' ', '\t']) {
                workspace.report(&document, k + 1, "ends in a space");
            }
            for link in links(line) {
                check_link(workspace, &document, k + 1, link);
            }
        }
    }
}

/// Targets of Markdown links and pictures in a line.
fn links(line: &str) -> impl Iterator<Item = &str> {
    line.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

fn check_link(workspace: &mut Workspace, document: &Path, line: usize, link: &str) {
    let target = link.split('#').next().unwrap_or_default();
    let elsewhere = target.contains("://") || target.starts_with("mailto:");
    if target.is_empty() || elsewhere {
        return;
    }
    let folder = document.parent().unwrap_or(Path::new(""));
    let resolved = resolve(&folder.join(target));
    if !resolved.is_some_and(|path| workspace.root.join(path).exists()) {
        workspace.report(document, line, format!("links to {target}, which does not exist"));
    }
}

/// A path without `..`, or `None` if it leads out of the workspace.
fn resolve(path: &Path) -> Option<PathBuf> {
    let mut resolved = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => resolved.push(name),
            Component::CurDir => {}
            Component::ParentDir => {
                if !resolved.pop() {
                    return None;
                }
            }
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(resolved)
}
