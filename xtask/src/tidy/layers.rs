//! The crates and their layers.

use super::Workspace;
use std::path::Path;

/// The crates, and the packages below `xtask/`, from the bottom layer up. Each may use those before it, never
/// those after it.
pub fn layers() -> impl Iterator<Item = &'static str> {
    include_str!("layers.txt").lines()
}

const MAP: &str = "docs/ARCHITECTURE.md";

/// Every crate is in the list above and on the map; what is on the map exists; none uses one above it.
pub(super) fn check(workspace: &mut Workspace) {
    let packages = workspace.packages();
    let map = workspace.read(Path::new(MAP)).unwrap_or_default();
    for package in &packages {
        let name = &package.name;
        let manifest = package.manifest();
        if !layers().any(|layer| layer == name) {
            workspace.report(&manifest, 1, format!("{name} is missing in xtask/src/tidy/layers.txt"));
        }
        if !mentions(&map).any(|(_, mentioned)| mentioned == name) {
            workspace.report(MAP, 1, format!("the map does not mention {name}"));
        }
        check_uses(workspace, name, &manifest);
    }
    for (line, mentioned) in mentions(&map) {
        if !packages.iter().any(|package| package.name == mentioned) {
            workspace.report(MAP, line, format!("the map mentions {mentioned}, which is no crate"));
        }
    }
}

fn check_uses(workspace: &mut Workspace, name: &str, manifest: &Path) {
    let level = |name: &str| layers().position(|layer| layer == name);
    let Some(text) = workspace.read(manifest) else { return };
    let published = !text.lines().any(|line| line == "publish = false");
    let versions = workspace.read(Path::new("Cargo.toml")).unwrap_or_default();
    let mut section = "";
    for (k, line) in text.lines().enumerate() {
        if line.starts_with('[') {
            section = line.trim();
            continue;
        }
        let used = line.split(['.', '=', ' ']).next().unwrap_or_default();
        if !used.starts_with("phase-") || level(used) < level(name) {
            continue;
        }
        match section {
            "[dependencies]" => {
                let rule = format!("{name} must not use {used}, which is not below it");
                workspace.report(manifest, k + 1, rule);
            }
            // Tests may use crates of higher layers. With a version these would have to be published before
            // this crate is.
            "[dev-dependencies]" if published && has_version(line, used, &versions) => {
                let rule = format!("tests of {name} use {used}, which is not below it: by `path` alone");
                workspace.report(manifest, k + 1, rule);
            }
            _ => {}
        }
    }
}

/// Whether the line of a dependency gives a version, itself or through the workspace's manifest.
fn has_version(line: &str, used: &str, workspace: &str) -> bool {
    if !line.starts_with(&format!("{used}.workspace")) {
        return line.contains("version");
    }
    let entry = format!("{used} = ");
    workspace.lines().any(|line| line.starts_with(&entry) && line.contains("version"))
}

/// The crates that have a row in the map's table, with their lines.
fn mentions(map: &str) -> impl Iterator<Item = (usize, &str)> {
    map.lines().enumerate().filter_map(|(k, line)| {
        let (name, _) = line.strip_prefix("| `")?.split_once('`')?;
        is_crate_name(name).then_some((k + 1, name))
    })
}

fn is_crate_name(name: &str) -> bool {
    let plain = |letter: char| letter.is_ascii_lowercase() || letter == '-';
    name.strip_prefix("phase-").is_some_and(|rest| !rest.is_empty() && rest.chars().all(plain))
}
