//! Parquet files, read back with the library's own row reader, which does not depend on how they were
//! written.

use crate::support::plain_event;
use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::{Field, Row},
};
use phase_dataset::{
    ExportError,
    manifest::{EventEntry, event_path, video_path},
    parquet::{EVENTS_PER_FILE, ParquetFile, ParquetWriter, descriptions},
    phase_events,
    splits::Split,
};
use phase_event::{Recording, to_json};
use phase_files::{FileError, checksum::FileEntry};
use serde_json::{Value, json};
use std::{collections::BTreeMap, fs, path::Path};

/// Events of these lengths with all their files; every third belongs to the test split.
pub(crate) fn events(folder: &Path, lengths: &[usize]) -> Vec<EventEntry> {
    for name in ["events", "videos"] {
        fs::create_dir_all(folder.join(name)).expect("a folder");
    }
    let entry = |(k, &steps): (usize, &usize)| {
        let (id, event) = (format!("made-up-{k}"), plain_event(steps));
        let recording = Recording::of_event(id.clone(), event.clone(), "phase test".into(), json!({}));
        fs::write(folder.join(event_path(&id)), to_json(&[recording]).expect("finite")).expect("written");
        fs::write(folder.join(video_path(&id)), crate::boxes::video(1 + 5 * steps)).expect("written");
        let split = if k % 3 == 2 { Split::Test } else { Split::Train };
        EventEntry { split: Some(split), ..EventEntry::of(folder, &id, &event, true).expect("described") }
    };
    lengths.iter().enumerate().map(entry).collect()
}

/// Writes the Parquet files of a dataset from its event files.
pub(crate) fn export(folder: &Path, entries: &[EventEntry]) -> Result<Vec<FileEntry>, ExportError> {
    let mut writer = ParquetWriter::new(folder, &counts(entries))?;
    for entry in entries {
        writer.push(entry, &phase_events::read(&entry.event.place(folder))?[0])?;
    }
    writer.finish()
}

fn counts(entries: &[EventEntry]) -> BTreeMap<Split, usize> {
    let mut counts = BTreeMap::new();
    entries.iter().for_each(|entry| *counts.entry(entry.split()).or_default() += 1);
    counts
}

fn parts(entries: &[EventEntry]) -> Vec<ParquetFile> {
    phase_dataset::parquet::parts(&counts(entries))
}

/// A file with the events that belong to it.
fn compare(folder: &Path, part: &ParquetFile, entries: &[EventEntry]) -> Result<(), FileError> {
    phase_dataset::parquet::compare(folder, part, &part.of(entries))
}

fn rows(path: &Path) -> Vec<Value> {
    let reader = SerializedFileReader::new(fs::File::open(path).expect("a file")).expect("Parquet");
    let rows = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row"));
    let object = |row: Row| row.get_column_iter().map(|(name, field)| (name.clone(), value(field))).collect();
    rows.map(|row| Value::Object(object(row))).collect()
}

fn value(field: &Field) -> Value {
    match field {
        Field::Null => Value::Null,
        Field::Bool(it) => json!(it),
        Field::Int(it) => json!(it),
        Field::ULong(it) => json!(it),
        Field::Float(it) => json!(it),
        Field::Double(it) => json!(it),
        Field::Str(it) => json!(it),
        Field::ListInternal(list) => list.elements().iter().map(value).collect(),
        other => panic!("{other:?} is in no column"),
    }
}

/// Every value of a table in single precision, which the reader widens.
fn singles(value: &Value) -> Vec<f32> {
    match value {
        Value::Array(items) => items.iter().flat_map(singles).collect(),
        other => vec![other.as_f64().expect("a number") as f32],
    }
}

#[test]
fn rows_say_what_the_events_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let entries = events(path, &[4, 2, 3]);
    let files = export(path, &entries).expect("written");
    let names: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(names, ["data/train-00000-of-00001.parquet", "data/test-00000-of-00001.parquet"]);

    let train = rows(&path.join(names[0]));
    let ids: Vec<&Value> = train.iter().map(|row| &row["id"]).collect();
    assert_eq!(ids, ["made-up-0", "made-up-1"]);
    let event = plain_event(4);
    let row = &train[0];
    for (column, expected) in [
        ("split", json!("train")),
        ("seed", json!(u64::MAX - 3)),
        ("video", json!("videos/made-up-0.mp4")),
        ("layout_base", json!(20)),
        ("layout_flip", json!(3)),
        ("kind", json!("helping")),
        ("relation", json!("friendly")),
        ("alpha", json!([1, 0])),
        ("goal_kind", json!(["object_on_landmark", "object_on_landmark"])),
        ("goal_entity", json!([2, 2])),
        ("goal_landmark", json!([1, 1])),
        ("goal_other", json!([null, null])),
        ("goal_sign", json!([1, 1])),
        ("agent_strength_level", json!([2, 2])),
        ("object_size_level", json!([0, 2])),
        ("steps", json!(4)),
        (
            "subgoals",
            json!([
                ["Attach(agent 0, object 1)", "Stay"],
                ["not Touch(agent 0, agent 1)", "Stay"],
                ["Attach(agent 0, object 1)", "Stay"],
                ["not Touch(agent 0, agent 1)", "Stay"],
            ]),
        ),
    ] {
        assert_eq!(row[column], expected, "{column}");
    }
    let value = event.steps[2].thoughts[0].subgoals[0].value;
    assert_eq!(row["subgoal_values"][2], json!([value, null]));
    assert_eq!(
        row["actions"][3],
        json!([event.steps[3].actions[0].name(), event.steps[3].actions[1].name()])
    );
    let expected: Vec<f32> = event
        .frames()
        .flat_map(|state| state.bodies)
        .flat_map(|body| {
            let (at, v) = (body.position, body.velocity);
            [at.x, at.y, v.x, v.y, body.angle, body.angular_velocity]
        })
        .collect();
    assert_eq!(singles(&row["substeps"]), expected, "bit for bit");
    assert_eq!(row["trajectory"].as_array().map(Vec::len), Some(5));
    // The grip begins in the third substep of the second step: frame 8.
    let held: Vec<Value> =
        row["held"].as_array().expect("a list").iter().map(|pair| pair[1].clone()).collect();
    assert_eq!(held.iter().position(|held| !held.is_null()), Some(8));
    assert_eq!(held[8], 1);
    // Agent 0 touches object 0 from the fourth substep of the first step on, object 1 from the next.
    assert_eq!((&row["contacts"][3], &row["contacts"][4]), (&json!([]), &json!([[0, 2]])));
    assert_eq!(row["contacts"][9], json!([[0, 2], [0, 3]]));
}

#[test]
fn the_schema_is_the_one_described() {
    let folder = tempfile::tempdir().expect("a folder");
    let entries = events(folder.path(), &[1]);
    export(folder.path(), &entries).expect("written");
    let file = fs::File::open(folder.path().join("data/train-00000-of-00001.parquet")).expect("a file");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let row = reader.get_row_iter(None).expect("rows").next().expect("a row").expect("whole");
    let columns = descriptions();
    assert_eq!(row.len(), columns.len());
    for (column, (name, field)) in columns.iter().zip(row.get_column_iter()) {
        assert_eq!(column.name, name);
        let nested = column.shape.matches(',').count() + usize::from(!column.shape.is_empty());
        let mut leaf = field;
        for _ in 0..nested {
            let Field::ListInternal(list) = leaf else { panic!("{name} is no list of {nested}") };
            match list.elements().first() {
                Some(first) => leaf = first,
                None => break,
            }
        }
        let kind = match leaf {
            Field::Str(_) => "string",
            Field::Int(_) => "int32",
            Field::ULong(_) => "uint64",
            Field::Float(_) => "float32",
            Field::Double(_) => "float64",
            Field::Bool(_) => "bool",
            _ => column.kind,
        };
        assert_eq!(kind, column.kind, "{name}");
    }
}

#[test]
fn the_same_events_make_the_same_bytes_in_groups_of_any_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let entries: Vec<EventEntry> = events(path, &[1; 160]);
    let first = export(path, &entries).expect("written");
    let second = export(path, &entries).expect("written");
    assert_eq!(first, second);
    let train = rows(&first[0].place(path));
    assert_eq!(train.len(), 107);
    assert_eq!(train[106]["id"], "made-up-159");
    for part in parts(&entries) {
        compare(path, &part, &entries).expect("what was written a moment ago");
    }
}

#[test]
fn files_are_limited_in_length() {
    let folder = tempfile::tempdir().expect("a folder");
    let one = events(folder.path(), &[1]).remove(0);
    let many = vec![one; 2 * EVENTS_PER_FILE + 1];
    let parts = parts(&many);
    let found: Vec<(&str, usize)> =
        parts.iter().map(|part| (part.path.as_str(), part.of(&many).len())).collect();
    assert_eq!(
        found,
        [
            ("data/train-00000-of-00003.parquet", EVENTS_PER_FILE),
            ("data/train-00001-of-00003.parquet", EVENTS_PER_FILE),
            ("data/train-00002-of-00003.parquet", 1),
        ]
    );
}

#[test]
fn files_that_are_not_finished_do_not_appear() {
    let folder = tempfile::tempdir().expect("a folder");
    let entries = events(folder.path(), &[1, 1]);
    let recording = &phase_events::read(&entries[0].event.place(folder.path())).expect("an event")[0];
    let mut writer = ParquetWriter::new(folder.path(), &counts(&entries)).expect("a folder");
    writer.push(&entries[0], recording).expect("the first of two");
    drop(writer);
    assert_eq!(fs::read_dir(folder.path().join("data")).expect("a folder").count(), 0);

    let mut writer = ParquetWriter::new(folder.path(), &counts(&entries[1..])).expect("a folder");
    writer.push(&entries[0], recording).expect("the only one");
    let error = writer.push(&entries[1], recording).expect_err("one too many").to_string();
    assert!(error.contains("made-up-1.json: ") && error.contains("more train events"), "{error}");

    let mut writer = ParquetWriter::new(folder.path(), &counts(&entries)).expect("a folder");
    writer.push(&entries[0], recording).expect("the first of two");
    let error = writer.finish().expect_err("one too few").to_string();
    assert!(
        error.contains("train-00000-of-00001.parquet: ") && error.contains("1 events are missing"),
        "{error}"
    );
}

#[test]
fn events_that_were_not_simulated_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let entries = events(folder.path(), &[1]);
    let mut file = crate::support::file();
    file["events"][0]["id"] = "made-up-0".into();
    fs::write(folder.path().join(event_path("made-up-0")), file.to_string()).expect("written");
    let error = export(folder.path(), &entries).expect_err("no substeps");
    assert!(matches!(error, ExportError::Read(_)), "{error}");
    let text = error.to_string();
    assert!(text.contains("made-up-0.json") && text.contains("`substeps` is missing"), "{text}");
}

/// Every change of an event is detected.
#[test]
fn a_comparison_finds_events_that_changed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let entries = events(path, &[2, 2]);
    export(path, &entries).expect("written");
    let file = path.join(event_path("made-up-1"));
    let text = fs::read_to_string(&file).expect("an event");
    for (from, to) in [
        ("\"relation\":\"friendly\"", "\"relation\":\"neutral\""),
        ("[\"turnleft\",\"right\"]", "[\"turnright\",\"right\"]"),
        ("\"grips\":[[0,[null,null]],[8,", "\"grips\":[[0,[null,null]],[7,"),
        ("\"contacts\":[[0,[]],[4,", "\"contacts\":[[0,[]],[5,"),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        fs::write(&file, changed).expect("written");
        let error = compare(path, &parts(&entries)[0], &entries).expect_err(from).to_string();
        let told = "train-00000-of-00001.parquet: differs from what PHASE writes for its events";
        assert!(error.contains(told), "{error}");
    }
    fs::write(&file, &text).expect("written");
    compare(path, &parts(&entries)[0], &entries).expect("as before");
}

#[test]
fn damage_anywhere_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let entries = events(path, &[3]);
    export(path, &entries).expect("written");
    let file = path.join("data/train-00000-of-00001.parquet");
    let whole = fs::read(&file).expect("a file");
    let part = &parts(&entries)[0];
    for length in [0, 4, 11, whole.len() / 2, whole.len() - 1] {
        fs::write(&file, &whole[..length]).expect("written");
        let error = compare(path, part, &entries).expect_err("cut short").to_string();
        assert!(error.contains("train-00000-of-00001.parquet: differs"), "{error}");
    }
    fs::write(&file, [&whole[..], b"x"].concat()).expect("written");
    compare(path, part, &entries).expect_err("something after the end");
    let dense = std::env::var_os("PHASE_EVERY_BYTE").is_some();
    for at in (0..whole.len()).step_by(if dense { 1 } else { 970 }) {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x80;
        fs::write(&file, bytes).expect("written");
        compare(path, part, &entries).expect_err("a byte is another");
    }
    fs::write(&file, whole).expect("written");
    compare(path, part, &entries).expect("as before");
}
