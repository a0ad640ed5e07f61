//! The commands that the documents show are commands of the programs, with options that exist.

use crate::shell::{commands, shell};
use clap::Parser;
use std::{
    fs,
    path::{Path, PathBuf},
};
use xtask::packages::PACKAGES;

/// Documents at the root and in `docs`, and of crates.
fn documents() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut folders = vec![root.join("docs"), root.join("crates"), root.join("xtask")];
    let mut found: Vec<PathBuf> = ["README.md", "CONTRIBUTING.md"].map(|name| root.join(name)).into();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder").flatten() {
            let (path, name) = (entry.path(), entry.file_name());
            if path.is_dir() && name != "node_modules" && name != "target" {
                folders.push(path);
            } else if name.to_string_lossy().ends_with(".md") {
                found.push(path);
            }
        }
    }
    found
}

/// Complaint about a command of `phase` or `cargo xtask`; nothing with others.
fn complaint(words: &[String]) -> Option<String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let arguments: Vec<&str> = match words.as_slice() {
        ["cargo", "xtask" | "xtask-networks" | "xtask-serve", rest @ ..]
        | ["xtask" | "/xtask", rest @ ..] => [&["xtask"], rest].concat(),
        ["phase", rest @ ..] => [&["phase"], rest].concat(),
        ["cargo", command @ ("train" | "serve"), rest @ ..] => [&["phase", command], rest].concat(),
        _ => return None,
    };
    let package =
        |(_, commands): &&(_, &[(&str, &str)])| commands.iter().any(|it| Some(&it.0) == arguments.get(1));
    let error = match PACKAGES.iter().find(package).map(|it| it.0) {
        _ if arguments[0] == "phase" => phase_cli::cli::Cli::try_parse_from(&arguments).err(),
        Some("phase-lab") => phase_lab::cli::Cli::try_parse_from(&arguments).err(),
        Some("phase-torture") => phase_torture::cli::Cli::try_parse_from(&arguments).err(),
        Some("phase-fuzz") => phase_fuzz::command::Cli::try_parse_from(&arguments).err(),
        Some("phase-golden") => phase_golden::command::Cli::try_parse_from(&arguments).err(),
        _ => xtask::cli::Cli::try_parse_from(&arguments).err(),
    };
    // Help and versions are errors to the parser, but what was asked for.
    error.filter(clap::Error::use_stderr).map(|error| format!("`{}`: {error}", words.join(" ")))
}

#[test]
fn commands_in_documents_parse() {
    let mut count = 0;
    let mut complaints = Vec::new();
    for document in documents() {
        let text = fs::read_to_string(&document).expect("a document");
        for command in shell(&text).iter().flat_map(|line| commands(line)) {
            // A variable or dots stand for other words.
            if command.iter().any(|word| word.starts_with('$') || word == "…") {
                continue;
            }
            count += 1;
            complaints.extend(complaint(&command).map(|said| format!("{}: {said}", document.display())));
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    assert!(count > 100, "{count} commands were read");
}

/// The word after one of these.
fn after<'a>(words: &'a [String], names: &[&str]) -> Option<&'a str> {
    let place = words.iter().position(|word| names.contains(&word.as_str()))?;
    words.get(place + 1).map(String::as_str)
}

/// Examples are run by the tests of their crates; here, that documents name those that there are.
#[test]
fn examples_in_documents_exist() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut count = 0;
    for document in documents() {
        let text = fs::read_to_string(&document).expect("a document");
        for command in shell(&text).iter().flat_map(|line| commands(line)) {
            let Some(example) = after(&command, &["--example"]) else { continue };
            let package = after(&command, &["--package", "-p"]).expect("a package");
            let places =
                [format!("{package}/examples/{example}.rs"), format!("{package}/examples/{example}/main.rs")];
            assert!(
                places.iter().any(|place| crates.join(place).is_file()),
                "{}: {command:?}",
                document.display()
            );
            count += 1;
        }
    }
    assert!(count > 3, "{count} examples were named");
}

#[test]
fn a_command_that_does_not_exist_is_noticed() {
    let wrong = |line: &str| commands(line).iter().filter_map(|words| complaint(words)).count();
    assert_eq!(wrong("cargo xtask tidy && A=1 phase simulate --events a.json --out b # the rest"), 0);
    assert_eq!(wrong("cargo xtask tidy --fast; cargo xtask fit-reports --fast"), 2);
    assert_eq!(wrong("cd x && phase no-such-command; phase simulate --evnets a.json"), 2);
}

/// Every test is a test of the oldest toolchain that the crates promise to work with.
#[test]
fn the_oldest_toolchain_is_the_one_that_tests() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let value = |file: &str, key: &str| {
        let text = fs::read_to_string(root.join(file)).expect("a file");
        let line = text.lines().find(|line| line.starts_with(key)).expect("a line").to_owned();
        line.split('"').nth(1).expect("a value").to_owned()
    };
    let (promised, used) = (value("Cargo.toml", "rust-version"), value("rust-toolchain.toml", "channel"));
    assert!(used.starts_with(&format!("{promised}.")) || used == promised, "{used} tests {promised}");
}
