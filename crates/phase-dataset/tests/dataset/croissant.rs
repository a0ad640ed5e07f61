//! `croissant.json`.

use phase_dataset::{
    croissant::{checksums, croissant},
    overview::Overview,
    parquet::descriptions,
};
use serde_json::Value;

#[test]
fn it_describes_files_and_columns() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut manifest = crate::manifest::dataset(path, "demo-0000");
    manifest.events = crate::parquet::events(path, &[1, 1, 1]);
    manifest.files = crate::parquet::export(path, &manifest.events).expect("written");
    let value: Value = serde_json::from_str(&croissant(&Overview::of(&manifest), "about")).expect("JSON");
    assert_eq!(value["conformsTo"], "http://mlcommons.org/croissant/1.0");
    let expected: Vec<(&str, &str)> =
        manifest.files.iter().map(|file| (file.path.as_str(), file.sha256.as_str())).collect();
    assert_eq!(checksums(&value), expected);
    assert_eq!(value.get("datePublished"), None, "a date makes the files of every run differ");
    manifest.date_published = Some("2026-11-23".into());
    let dated: Value = serde_json::from_str(&croissant(&Overview::of(&manifest), "about")).expect("JSON");
    assert_eq!(dated["datePublished"], "2026-11-23");
    let sets = value["recordSet"].as_array().expect("record sets");
    let names: Vec<&Value> = sets.iter().map(|set| &set["name"]).collect();
    assert_eq!(names, ["train", "test"]);
    for (set, file) in sets.iter().zip(&manifest.files) {
        let fields = set["field"].as_array().expect("fields");
        assert_eq!(fields.len(), descriptions().len());
        for (field, column) in fields.iter().zip(descriptions()) {
            assert_eq!(field["source"]["extract"]["column"], column.name);
            assert_eq!(field["source"]["fileObject"]["@id"], file.path.as_str());
            assert_eq!(field["repeated"].as_bool().unwrap_or(false), !column.shape.is_empty());
        }
    }
}
