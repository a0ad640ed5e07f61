//! Checks of the documents.

use super::Workspace;
use std::{
    collections::{BTreeMap, BTreeSet},
    ffi::OsStr,
    fs, iter,
    path::{Component, Path, PathBuf},
};

const README: &str = "README.md";
/// Folders with documents, beside those at the root.
const FOLDERS: [&str; 6] = ["docs", "crates", "data", "benches", "xtask", ".github"];
const CI: &str = ".ci/run";
/// The two commands given to newcomers.
const COMMANDS: [&str; 2] = ["cargo xtask gen-dataset", "cargo test --workspace"];

/// Checks commands, links and lines of the documents.
pub(super) fn check(workspace: &mut Workspace) {
    let [readme, ci] = [README, CI].map(|file| workspace.read(Path::new(file)).unwrap_or_default());
    for command in COMMANDS {
        if !readme.lines().any(|line| line == command) {
            workspace.report(README, 1, format!("must show the command `{command}` on a line of its own"));
        }
        if !ci.lines().any(|line| line.trim() == command || line.starts_with(&format!("{command} "))) {
            workspace.report(CI, 1, format!("must run the README's command `{command}`"));
        }
    }
    let mut texts = BTreeMap::new();
    for document in documents(workspace) {
        let Some(text) = workspace.read(&document) else { continue };
        for (k, line) in text.lines().enumerate() {
            if line.ends_with([' ', '\t']) {
                workspace.report(&document, k + 1, "ends in a space");
            }
        }
        texts.insert(document, text);
    }
    let anchors: BTreeMap<&PathBuf, BTreeSet<String>> =
        texts.iter().map(|(document, text)| (document, headings(text))).collect();
    for (document, text) in &texts {
        for (k, line) in prose(text) {
            for link in links(&without_code(line)) {
                check_link(workspace, &anchors, document, k + 1, link);
            }
        }
    }
}

/// Every Markdown file of the project.
fn documents(workspace: &Workspace) -> Vec<PathBuf> {
    let mut documents = workspace.files(&FOLDERS, &[".md"]);
    // Tools leave these folders beside the sources that they serve.
    let is_left_behind = |part: &OsStr| part == "node_modules" || part == ".pytest_cache";
    documents.retain(|document| !document.iter().any(is_left_behind));
    let entries = fs::read_dir(&workspace.root).into_iter().flatten().flatten();
    let files = entries.map(|entry| PathBuf::from(entry.file_name()));
    documents.extend(files.filter(|file| file.extension().is_some_and(|ending| ending == "md")));
    documents.sort();
    documents
}

/// The lines outside of blocks of code, with their indices.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut inside = false;
    text.lines().enumerate().filter(move |(_, line)| {
        let fence = line.trim_start().starts_with("```");
        inside ^= fence;
        !inside && !fence
    })
}

/// A line without what is set in backticks.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

/// The anchors of a document's headings, as code forges and books make them: letters, digits, `-` and `_` in
/// lower case, `-` for a space, and a number where a heading is repeated.
fn headings(text: &str) -> BTreeSet<String> {
    let mut anchors = BTreeSet::new();
    for (_, line) in prose(text) {
        let title = line.trim_start_matches('#');
        if title.len() == line.len() || !title.starts_with(' ') {
            continue;
        }
        let kept = |letter: char| match letter {
            ' ' => Some('-'),
            '-' | '_' => Some(letter),
            _ if letter.is_alphanumeric() => Some(letter),
            _ => None,
        };
        let anchor: String = title.trim().to_lowercase().chars().filter_map(kept).collect();
        let repeated = (1..).map(|k| format!("{anchor}-{k}"));
        let free = iter::once(anchor.clone()).chain(repeated).find(|name| !anchors.contains(name));
        anchors.extend(free);
    }
    anchors
}

/// Targets of Markdown links and pictures in a line.
fn links(line: &str) -> impl Iterator<Item = &str> {
    line.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

/// The files and folders of the workspace that a document links to; the document relative to the workspace.
pub(crate) fn targets(document: &Path, text: &str) -> Vec<PathBuf> {
    let folder = document.parent().unwrap_or(Path::new(""));
    let lines = prose(text).map(|(_, line)| without_code(line));
    let links = lines.flat_map(|line| links(&line).map(ToOwned::to_owned).collect::<Vec<_>>());
    let targets = links.filter_map(|link| {
        let target = link.split('#').next().unwrap_or_default();
        (!target.is_empty() && !target.contains(':')).then(|| resolve(&folder.join(target))).flatten()
    });
    targets.collect()
}

fn check_link(
    workspace: &mut Workspace,
    anchors: &BTreeMap<&PathBuf, BTreeSet<String>>,
    document: &Path,
    line: usize,
    link: &str,
) {
    let (target, anchor) = link.split_once('#').unwrap_or((link, ""));
    if target.contains("://") || target.starts_with("mailto:") {
        return;
    }
    let folder = document.parent().unwrap_or(Path::new(""));
    let found = if target.is_empty() { Some(document.to_owned()) } else { resolve(&folder.join(target)) };
    let Some(path) = found.filter(|path| workspace.root.join(path).exists()) else {
        workspace.report(document, line, format!("links to {target}, which does not exist"));
        return;
    };
    if !anchor.is_empty() && !anchors.get(&path).is_some_and(|known| known.contains(anchor)) {
        workspace.report(document, line, format!("links to {link}, but there is no such heading"));
    }
}

/// A path without `..`, or `None` if it leads out of the workspace.
pub(crate) fn resolve(path: &Path) -> Option<PathBuf> {
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
