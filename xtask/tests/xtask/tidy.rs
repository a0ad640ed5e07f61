//! `tidy` on synthetic workspaces, and on this one.

use std::{fs, path::Path};
use xtask::tidy::{check, layers};

const ROOT: &str = "//! It.\n//!\n//! ```\n//! # hidden();\n//! f();\n//! ```\n#![forbid(unsafe_code)]\n#![deny(missing_docs)]\n";
/// Keys that a published crate must have, and that its library has no unit tests.
const KEYS: &str = "description = \"\"\nreadme = \"\"\nkeywords = []\ncategories = []\n[lib]\ntest = false\n";
/// Of a library without unit tests.
const UNTESTED: &str = "[lib]\ntest = false\n";

fn readme_of(name: &str) -> String {
    format!("# {name}\n\nIt.\n\n```rust\nf();\n```\n")
}

/// Writes a workspace of two crates in which nothing is wrong.
fn workspace(root: &Path) {
    let readme =
        "# It\n\n## Two\n\n```sh\ncargo xtask gen-dataset\n```\n\n```sh\ncargo test --workspace\n```\n";
    let bare = ROOT.split_inclusive('\n').filter(|line| !line.starts_with("//! ")).collect();
    let files = [
        ("README.md", readme.to_owned()),
        ("Cargo.toml", "phase-world = { path = \"\", version = \"1\" }\n".to_owned()),
        (".ci/run", "cargo test --workspace\ncargo xtask gen-dataset --events 1\n".to_owned()),
        (
            "docs/ARCHITECTURE.md",
            "| `phase-model` |\n| `phase-world` | [it](../README.md#two) |\n| `phase-golden` |\nlater `phase-x`\n".to_owned(),
        ),
        ("crates/phase-model/Cargo.toml", format!("{KEYS}[dependencies]\nserde.workspace = true\n")),
        ("crates/phase-model/README.md", readme_of("phase-model")),
        ("crates/phase-model/src/lib.rs", ROOT.to_owned()),
        (
            "crates/phase-world/Cargo.toml",
            format!("publish = false\n{UNTESTED}[dependencies]\nphase-model.workspace = true\n"),
        ),
        ("crates/phase-world/README.md", readme_of("phase-world")),
        ("crates/phase-world/src/lib.rs", ROOT.to_owned()),
        ("data/Cargo.toml", KEYS.to_owned()),
        ("xtask/Cargo.toml", UNTESTED.to_owned()),
        ("xtask/golden/Cargo.toml", format!("publish = false\n{UNTESTED}")),
        ("xtask/golden/README.md", "# phase-golden\n\nIt.\n".to_owned()),
        ("xtask/golden/src/lib.rs", bare),
        ("data/README.md", readme_of("phase-data")),
        ("data/lib.rs", ROOT.to_owned()),
        ("xtask/src/lib.rs", ROOT.to_owned()),
        ("xtask/src/main.rs", ROOT.to_owned()),
    ];
    for (name, text) in files {
        write(root, name, &text);
    }
}

fn write(root: &Path, name: &str, text: &str) {
    let path = root.join(name);
    fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
    fs::write(path, text).expect("written");
}

fn findings(root: &Path) -> Vec<String> {
    check(root).iter().map(ToString::to_string).collect()
}

#[test]
fn a_tidy_workspace_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    workspace(folder.path());
    assert_eq!(findings(folder.path()), [""; 0]);
}

#[test]
fn every_rule_is_checked() {
    let long = format!("{ROOT}{}", "//\n".repeat(393));
    let upwards = format!("{KEYS}[dependencies]\nserde = \"1\"\nphase-world.workspace = true\n");
    let for_tests = format!("{KEYS}[dev-dependencies]\nphase-world = {{ path = \"\" }}\n");
    let in_a_cycle = format!("{KEYS}[dev-dependencies]\nphase-world.workspace = true\n");
    let unsafe_root = ROOT.replace("#![forbid(unsafe_code)]\n", "");
    let other_example = ROOT.replace("f();", "g();");
    let tested_root = format!("{ROOT}mod tests {{\n    #[test]\n    fn a() {{}}\n}}\n");
    let encoding = format!("{ROOT}use bin{}::serde;\n", "code");
    let reading = format!("{ROOT}fn f() {{ std::fs::read(1); TensorFile::open(2); }}\n");
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "crates/phase-model/src/lib.rs",
            &reading,
            &["crates/phase-model/src/lib.rs:9: files are read by phase-files alone"],
        ),
        (
            "crates/phase-model/Cargo.toml",
            &upwards,
            &["crates/phase-model/Cargo.toml:9: phase-model must not use phase-world, which is not below it"],
        ),
        ("crates/phase-model/Cargo.toml", &for_tests, &[]),
        (
            "crates/phase-model/Cargo.toml",
            &in_a_cycle,
            &["crates/phase-model/Cargo.toml:8: tests of phase-model use phase-world, which is not below it"],
        ),
        (
            "crates/phase-new/Cargo.toml",
            "",
            &[
                "crates/phase-new/Cargo.toml:1: a published crate must have `categories`",
                "crates/phase-new/Cargo.toml:1: a published crate must have `description`",
                "crates/phase-new/Cargo.toml:1: a published crate must have `keywords`",
                "crates/phase-new/Cargo.toml:1: a published crate must have `readme`",
                "crates/phase-new/Cargo.toml:1: phase-new is missing in xtask/src/tidy/layers.txt",
                "crates/phase-new/README.md:1: cannot be read",
                "crates/phase-new/src/lib.rs:1: cannot be read",
                "docs/ARCHITECTURE.md:1: the map does not mention phase-new",
            ],
        ),
        (
            "docs/ARCHITECTURE.md",
            "| `phase-model` | `phase-events/1` |\n| `phase-world` |\n| `phase-golden` |\n| `phase-gone` |\n",
            &["docs/ARCHITECTURE.md:4: the map mentions phase-gone, which is no crate"],
        ),
        (
            "docs/more.md",
            "see [this](missing.md) and\n[that](https://example.org/x.md)\n",
            &["docs/more.md:1: links to missing.md"],
        ),
        ("docs/more.md", "[out](../../etc/passwd)\n", &["docs/more.md:1: links to ../../etc/passwd"]),
        (
            "docs/more.md",
            "## A `b` (c)\n## D\n## D\n[1](#a-b-c), [2](more.md#d-1), `[3](no.md)`\n```\n[4](no.md)\n```\n",
            &[],
        ),
        (
            "docs/more.md",
            "```sh\n# d\n```\n[1](#d), [2](../README.md#three)\n",
            &[
                "docs/more.md:4: links to #d, but there is no such heading",
                "docs/more.md:4: links to ../README.md#three, but",
            ],
        ),
        ("crates/phase-model/notes.md", "[1](no.md)\n", &["crates/phase-model/notes.md:1: links to no.md"]),
        (
            "data/README.md",
            "# phase-x\n",
            &["data/README.md:1: must begin", "data/README.md:1: must show the first example"],
        ),
        (
            "crates/phase-model/src/lib.rs",
            &other_example,
            &["crates/phase-model/README.md:1: must show the first example of crates/phase-model/src/lib.rs"],
        ),
        ("docs/more.md", "a space \n", &["docs/more.md:1: ends in a space"]),
        (
            "crates/phase-model/src/lib.rs",
            &unsafe_root,
            &["crates/phase-model/src/lib.rs:1: the crate root must say #![forbid(unsafe_code)]"],
        ),
        (
            "xtask/src/main.rs",
            "#![forbid(unsafe_code)]\n",
            &["xtask/src/main.rs:1: the crate root must say #![deny(missing_docs)]"],
        ),
        ("crates/phase-model/src/lib.rs", &long, &["crates/phase-model/src/lib.rs:401: has 401 lines"]),
        (
            "crates/phase-model/src/lib.rs",
            &encoding,
            &["crates/phase-model/src/lib.rs:9: only crates/phase-files/src/cache.rs"],
        ),
        (
            "crates/phase-model/tests/all.rs",
            "fn a() {\n\tlet b = 1; \n}\n",
            &[
                "crates/phase-model/tests/all.rs:2: ends in a space",
                "crates/phase-model/tests/all.rs:2: holds a tab",
            ],
        ),
        (
            "xtask/src/more.rs",
            concat!("fn a() { dbg", "!(1); }\n"),
            &[concat!("xtask/src/more.rs:1: dbg", "!(…) must not stay")],
        ),
        (
            "crates/phase-model/src/part.rs",
            "#[test]\nfn a() {}\n",
            &["crates/phase-model/src/part.rs:1: is not run: [lib] of crates/phase-model/Cargo.toml says"],
        ),
        ("xtask/src/main.rs", &tested_root, &[]),
        (
            "xtask/Cargo.toml",
            "[[bin]]\ntest = false\n",
            &["xtask/Cargo.toml:1: a library without unit tests must say `test = false`"],
        ),
        (
            ".ci/run",
            "cargo test\ncargo xtask gen-dataset\n",
            &[".ci/run:1: must run the README's command `cargo test --workspace`"],
        ),
        (
            "README.md",
            "## Two\ncargo test --workspace\n",
            &["README.md:1: must show the command `cargo xtask gen-dataset`"],
        ),
    ];
    for (name, text, expected) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        workspace(folder.path());
        write(folder.path(), name, text);
        let found = findings(folder.path());
        assert_eq!(found.len(), expected.len(), "{name}: {found:?}");
        for (found, expected) in found.iter().zip(*expected) {
            assert!(found.starts_with(expected), "{found:?} does not begin with {expected:?}");
        }
    }
}

/// A program that says that it has no tests must have none.
#[test]
fn tests_of_a_program_are_not_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    workspace(folder.path());
    write(folder.path(), "xtask/Cargo.toml", &format!("{UNTESTED}[[bin]]\nname = \"xtask\"\ntest = false\n"));
    write(folder.path(), "xtask/src/main.rs", &format!("{ROOT}#[test]\nfn a() {{}}\n"));
    let expected = "xtask/src/main.rs:9: is not run: [[bin]] of xtask/Cargo.toml says `test = false`";
    assert_eq!(findings(folder.path()), [expected]);
}

#[test]
fn the_layers_are_those_there_are() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for layer in layers() {
        let below_xtask = layer.strip_prefix("phase-").unwrap_or(layer);
        let folders = [root.join("crates").join(layer), root.join("xtask").join(below_xtask)];
        assert!(folders.iter().any(|folder| folder.join("Cargo.toml").is_file()), "{layer}");
    }
}
