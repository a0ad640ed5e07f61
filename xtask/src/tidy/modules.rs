//! Modules of a crate that use each other: no cycles.

use super::Workspace;
use petgraph::{algo::tarjan_scc, graph::DiGraph};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::PathBuf,
};

/// Reports every set of modules that use each other in a cycle, at the crate's root.
///
/// A module is a file or folder right below `src`; it uses another if it names it, or something that the
/// crate root re-exports from it, in a path that starts with `crate::`.
pub(super) fn check(workspace: &mut Workspace) {
    for package in workspace.packages().into_iter().filter(|package| !package.is_exempt("cycles")) {
        let root = package.folder.join("src");
        let root = root.to_string_lossy();
        let modules = read(workspace, &root);
        for cycle in cycles(&modules) {
            let rule = format!("the modules {} use each other in a cycle", cycle.join(", "));
            workspace.report(PathBuf::from(format!("{root}/lib.rs")), 1, rule);
        }
    }
}

/// The code of each module without comments, by name; that of the crate root under `lib`.
fn read(workspace: &mut Workspace, root: &str) -> BTreeMap<String, String> {
    let mut modules = BTreeMap::<String, String>::new();
    for file in workspace.files(&[root], &[".rs"]) {
        let Ok(path) = file.strip_prefix(root) else { continue };
        let top = path.iter().next().unwrap_or_default().to_string_lossy();
        let module = top.strip_suffix(".rs").unwrap_or(&top).to_owned();
        let code = workspace.read(&file).unwrap_or_default();
        let code = code.lines().map(|line| line.split("//").next().unwrap_or_default());
        modules.entry(module).or_default().extend(code.flat_map(|line| [line, "\n"]));
    }
    modules
}

/// The sets of modules that use each other in cycles, each sorted.
fn cycles(modules: &BTreeMap<String, String>) -> Vec<Vec<&str>> {
    let root = modules.get("lib").map_or("", String::as_str);
    let origins = origins(root);
    let mut graph = DiGraph::<&str, ()>::new();
    let names = modules.keys().map(String::as_str).filter(|module| *module != "lib");
    let nodes: BTreeMap<&str, _> = names.map(|module| (module, graph.add_node(module))).collect();
    for (module, &from) in &nodes {
        for name in paths(&modules[*module], "crate::").into_iter().filter_map(|path| path.first().copied()) {
            if let Some(&to) = nodes.get(origins.get(name).copied().unwrap_or(name))
                && to != from
            {
                graph.update_edge(from, to, ());
            }
        }
    }
    let components = tarjan_scc(&graph).into_iter().filter(|component| component.len() > 1);
    let mut cycles: Vec<Vec<&str>> =
        components.map(|component| component.into_iter().map(|node| graph[node]).collect()).collect();
    cycles.iter_mut().for_each(|cycle| cycle.sort_unstable());
    cycles.sort();
    cycles
}

/// For each name that the crate root re-exports, the module that it comes from.
fn origins(root: &str) -> BTreeMap<&str, &str> {
    let exports = paths(root, "pub use ").into_iter().chain(paths(root, "pub(crate) use "));
    exports.filter_map(|path| Some((*path.last()?, *path.first()?))).collect()
}

/// All paths after each occurrence of some words, one for each leaf of a `{…}` group.
fn paths<'a>(code: &'a str, words: &str) -> BTreeSet<Vec<&'a str>> {
    let mut paths = BTreeSet::new();
    for (at, _) in code.match_indices(words) {
        let mut stack: Vec<usize> = Vec::new();
        let mut path = Vec::new();
        let mut rest = &code[at + words.len()..];
        loop {
            rest = rest.trim_start();
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            if end > 0 {
                path.push(&rest[..end]);
                rest = &rest[end..];
            }
            if let Some(after) = rest.strip_prefix("::") {
                rest = after;
            } else if let Some(after) = rest.strip_prefix('{') {
                stack.push(path.len());
                rest = after;
            } else {
                paths.insert(path.clone());
                let Some(&depth) = stack.last() else { break };
                path.truncate(depth);
                if let Some(after) = rest.strip_prefix('}') {
                    stack.pop();
                    rest = after;
                } else {
                    // A comma, or a glob or renaming up to the next one.
                    let Some(next) = rest.find([',', '}']) else { break };
                    rest = &rest[if rest[next..].starts_with(',') { next + 1 } else { next }..];
                }
            }
        }
    }
    paths.remove(&Vec::new());
    paths
}

#[cfg(test)]
mod tests {
    use super::cycles;
    use std::collections::BTreeMap;

    fn found(modules: &[(&str, &str)]) -> Vec<Vec<String>> {
        let modules: BTreeMap<String, String> =
            modules.iter().map(|&(name, code)| (name.to_owned(), code.to_owned())).collect();
        cycles(&modules).into_iter().map(|cycle| cycle.into_iter().map(str::to_owned).collect()).collect()
    }

    #[test]
    fn layers_have_no_cycle() {
        let base = ("base", "fn f() {}");
        let middle = ("middle", "use crate::{\n    base::{self, a::{b, c}},\n    other::*,\n};");
        let top = ("top", "fn g() { crate::middle::h(crate::base::f()) }");
        assert_eq!(found(&[base, middle, top, ("other", "")]), Vec::<Vec<String>>::new());
    }

    #[test]
    fn cycles_are_found_in_groups_in_paths_and_through_the_root() {
        let root = ("lib", "pub mod a;\npub mod b;\nmod c;\npub use a::{Thing, self as _};");
        let a = ("a", "use crate::{\n    d::{x, y},\n    c,\n};");
        let b = ("b", "use crate::Thing;");
        let c = ("c", "fn f() { crate::b::g() }");
        let d = ("d", "use crate::e;");
        let cycle = vec![vec!["a".to_owned(), "b".to_owned(), "c".to_owned()]];
        assert_eq!(found(&[root, a, b, c, d, ("e", "")]), cycle);
    }
}
