//! What the program says of input that it cannot use.

use std::{fs, process::Command};

/// Exit code and what stands on stderr.
fn train(arguments: &[&str]) -> (Option<i32>, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_train")).args(arguments).output().expect("the program starts");
    (output.status.code(), String::from_utf8(output.stderr).expect("text"))
}

#[test]
fn bad_input_is_one_sentence_and_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (nothing, torn, empty, out) = (path("nothing"), path("torn"), path("empty"), path("out.safetensors"));
    for folder in [&torn, &empty] {
        fs::create_dir(folder).unwrap();
    }
    fs::write(path("torn/manifest.json"), "{\"format\": ").unwrap();
    let nowhere = path("nowhere/out.safetensors");
    let manifest = r#"{"format": "phase-dataset/1", "generator": "g", "preset": "p", "seed": 1, "settings": {},
        "selection": [], "events": [], "files": []}"#;
    fs::write(path("empty/manifest.json"), manifest).unwrap();
    let cases = [
        (
            &nothing,
            &out,
            format!("error: {nothing}: is no finished dataset; give a folder with manifest.json\n"),
        ),
        (
            &torn,
            &out,
            format!("error: {torn}/manifest.json: is truncated: the JSON ends unfinished in line 1\n"),
        ),
        (&empty, &out, format!("error: {empty}: has no train events\n")),
        (&empty, &nowhere, format!("error: {nowhere}: cannot write the file: no such file or directory\n")),
    ];
    for (data, out, expected) in cases {
        let (code, text) = train(&["strength", "--data", data, "--out", out]);
        assert_eq!((code, text), (Some(2), expected));
    }
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "only the two datasets: {left:?}");
}
