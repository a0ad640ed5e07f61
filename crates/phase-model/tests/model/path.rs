//! Names and paths that come from files.

use phase_model::path::{PathError, RelativePath, check_file_name};
use proptest::prelude::*;
use std::path::{Component, Path};

#[test]
fn names_are_the_same_on_every_system() {
    for name in ["a", "a.json", "conference", "com10", "comm1", "console.json", "a.b.c", ".hidden", "ä ö"] {
        assert_eq!(check_file_name(name), Ok(()), "{name}");
    }
    for (name, rule) in [
        ("", PathError::Outside),
        ("..", PathError::Outside),
        ("a/b", PathError::Outside),
        ("a\\b", PathError::Letter),
        ("c:", PathError::Letter),
        ("a\0", PathError::Letter),
        ("a\n", PathError::Letter),
        ("a.", PathError::End),
        ("a ", PathError::End),
        ("CON", PathError::Device),
        ("aux", PathError::Device),
        ("nul.json", PathError::Device),
        ("Com1.tar.gz", PathError::Device),
        ("LPT9", PathError::Device),
        ("lpt² .txt", PathError::Device),
        ("conin$", PathError::Device),
    ] {
        assert_eq!(check_file_name(name), Err(rule), "{name:?}");
    }
    assert_eq!(check_file_name(&"a".repeat(256)), Err(PathError::Length));
}

#[test]
fn paths_stay_inside_their_folder() {
    let path = RelativePath::new("events/a.json").expect("inside");
    assert_eq!(path.below(Path::new("x")), Path::new("x/events/a.json"));
    assert_eq!((path.as_str(), path.name()), ("events/a.json", "a.json"));
    for path in
        ["", "/etc/passwd", "../a", "a/../../b", "a/./b", "a//b", "a/", "./a", "C:/a", "\\\\host\\a", "a/nul"]
    {
        assert!(RelativePath::new(path).is_err(), "{path:?}");
    }
    assert!(RelativePath::new("a/".repeat(501) + "a").is_err());
    let text = serde_json::to_string(&path).expect("text");
    assert_eq!(text, "\"events/a.json\"");
    assert_eq!(serde_json::from_str::<RelativePath>(&text).expect("read"), path);
    let error = serde_json::from_str::<RelativePath>("\"../a\"").expect_err("outside").to_string();
    assert!(error.contains("\"../a\" must be a relative path"), "{error}");
}

proptest! {
    /// Whatever is accepted is below the folder, by the system's own understanding of paths.
    #[test]
    fn what_is_accepted_is_inside(text in "[a./\\\\:~C ]{0,12}") {
        if let Ok(path) = RelativePath::new(text) {
            let whole = path.below(Path::new("/folder"));
            let rest = whole.strip_prefix("/folder").expect("below");
            prop_assert!(rest.components().all(|part| matches!(part, Component::Normal(_))));
            prop_assert_eq!(rest.to_string_lossy(), path.as_str());
        }
    }
}
