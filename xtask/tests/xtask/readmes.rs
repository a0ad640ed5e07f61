//! Examples of crates for others, as their READMEs show them, in projects of their own.

use std::{collections::BTreeSet, fs, path::Path, process::Command};

/// The repository.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The blocks of a page in one language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    page.split(&fence[..]).skip(1).filter_map(|rest| rest.split("\n```").next()).map(str::to_owned).collect()
}

/// Runs cargo without a network, with compiled packages in one folder for all projects.
fn cargo(project: &Path, arguments: &[&str]) {
    let mut command = Command::new(env!("CARGO"));
    command.current_dir(project).args(arguments).arg("--offline");
    command.env("CARGO_TARGET_DIR", root().join("target/readmes"));
    let output = command.output().expect("cargo starts");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Crates that plan alone. Their examples are run.
const RUN: [&str; 3] = ["phase-pomcp", "phase-planner", "phase-navigation"];

/// The other crates that docs/how-to/rust.md names. Their examples are compiled here, which is cheaper, and
/// run as tests of their documentation.
const CHECKED: [&str; 7] = [
    "phase-model",
    "phase-event",
    "phase-forward",
    "phase-world",
    "phase-sampler",
    "phase-sim",
    "phase-simple",
];

#[test]
fn examples_are_whole_programs_in_projects_of_their_own() {
    for name in RUN.into_iter().chain(CHECKED) {
        let page = fs::read_to_string(root().join(format!("crates/{name}/README.md"))).expect("a README");
        let project = tempfile::tempdir().expect("a folder");
        let programs = project.path().join("src/bin");
        fs::create_dir_all(&programs).expect("a folder");
        let manifest = "[package]\nname = \"own\"\nedition = \"2024\"\n";
        fs::write(project.path().join("Cargo.toml"), manifest).expect("a file");
        // The versions that are here.
        fs::copy(root().join("Cargo.lock"), project.path().join("Cargo.lock")).expect("a file");
        let examples = blocks(&page, "rust");
        for (k, example) in examples.iter().enumerate() {
            fs::write(programs.join(format!("example{k}.rs")), example).expect("a file");
        }
        for line in blocks(&page, "sh").iter().flat_map(|block| block.lines()) {
            let here = line.replace("../phase/", &format!("{}/", root().display()));
            let words: Vec<&str> = here.split_whitespace().collect();
            if let ["cargo", "add", ..] = words[..] {
                cargo(project.path(), &words[1..]);
            }
        }
        assert!(!examples.is_empty(), "{name}");
        if CHECKED.contains(&name) {
            cargo(project.path(), &["check", "--bins"]);
            continue;
        }
        for k in 0..examples.len() {
            cargo(project.path(), &["run", "--bin", &format!("example{k}")]);
        }
    }
}

/// Every crate that the documents offer for use alone is among those that these tests compile.
#[test]
fn the_crates_of_the_page_are_tried() {
    let page = fs::read_to_string(root().join("docs/how-to/rust.md")).expect("a page");
    let named: BTreeSet<&str> = page
        .split("](../../crates/")
        .skip(1)
        .filter_map(|rest| rest.split_once("/README.md)"))
        .map(|(name, _)| name)
        .collect();
    assert_eq!(named, RUN.into_iter().chain(CHECKED).collect());
}
