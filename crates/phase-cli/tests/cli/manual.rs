//! `completions` and `man`.

use crate::support::{succeed, tree};
use std::path::Path;

#[test]
fn shells_learn_commands_and_options() {
    let folder = tempfile::tempdir().expect("a folder");
    for shell in ["bash", "zsh", "fish"] {
        let script = succeed(folder.path(), &["completions", shell]);
        for word in ["phase", "gen-dataset", "new-scene", "contact-sheet"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn every_command_has_a_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let told = succeed(path, &["man", "--out", "man/man1"]);
    let pages = tree(&path.join("man/man1"));
    assert_eq!(told.trim_end(), format!("{} pages in man/man1", pages.len()));
    for name in ["phase", "phase-simulate", "phase-eval", "phase-eval-goals", "phase-man"] {
        let page = pages.get(Path::new(&format!("{name}.1"))).expect(name);
        let page = String::from_utf8_lossy(page);
        assert!(page.contains(&format!(".TH {name} 1")), "{name}: {page}");
    }
}
