//! Export of a dataset as WebDataset: tar files that training programs read from the first byte to the last.
//!
//! A sample is an event: `<id>.mp4`, `<id>.json` with its labels, the entry of the manifest, and
//! `<id>.phase-events`, its file of the format `phase-events/1`.

use crate::{
    error::RunError, interrupt, laboratory::unusable, listener::Listener, resume::is_finished, words,
};
use phase_dataset::{
    manifest::{EventEntry, MANIFEST_FILE, Manifest},
    splits::Split,
};
use phase_files::{
    WriteError, atomic,
    checksum::FileEntry,
    folder::{self, Folder},
    measured::MeasuredFile,
    regular,
    run::Run,
};
use phase_model::{MAX_OBJECTS, json::read_as};
use phase_sampler::Variant;
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::Path;
use tar::{Builder, Header};

/// The list of all tar files; written last.
const INDEX_FILE: &str = "index.json";
/// Stands for a number in the labels that an event does not have.
const NO_NUMBER: i64 = -1;
/// The value of its field `format`.
const INDEX_FORMAT: &str = "phase-webdataset/1";

/// An export that is there.
#[derive(Clone, PartialEq, Debug)]
pub struct Exported {
    /// The tar files: `file`, `split` and `events` of each.
    pub files: Vec<Value>,
    /// Whether it was made now.
    pub is_new: bool,
}

/// The list of all tar files; its other members are read elsewhere.
#[derive(Deserialize)]
struct Index {
    files: Vec<Listed>,
}

/// A tar file as the list has it; its other members are not read.
#[derive(Deserialize)]
struct Listed {
    file: FileEntry,
}

/// Exports the finished dataset in a folder into another, which is new, empty, or of the same export: this
/// number of events to a tar file. The same dataset gives the same bytes; tar files that are complete are
/// kept after an interruption.
///
/// # Errors
/// If the dataset or the folder cannot be used, a file cannot be written, or a stop was requested.
pub fn export(
    from: &Path,
    out: &Path,
    events_per_file: usize,
    listener: &dyn Listener,
) -> Result<Exported, RunError> {
    let manifest_file = from.join(MANIFEST_FILE);
    if !from.exists() {
        return Err(RunError::Usage(format!("{}: does not exist", from.display())));
    }
    if !manifest_file.is_file() {
        return Err(RunError::NotADataset(from.to_owned()));
    }
    let manifest = Manifest::read(&manifest_file)?;
    let digest = FileEntry::of(from, MANIFEST_FILE)?.sha256;
    let run = Run::new([
        ("command", "export".into()),
        ("manifest_sha256", digest.into()),
        ("events_per_file", events_per_file.into()),
    ]);
    if is_finished(out, INDEX_FILE, &run, listener)? {
        return finished(out, &run, &tar_files(&manifest, events_per_file));
    }
    let folder = Folder::claim(out, &run)?;
    let progress = listener
        .progress_over(&format!("exporting {}", words::events(manifest.events.len())), manifest.events.len());
    let mut files = Vec::new();
    for (name, split, events) in tar_files(&manifest, events_per_file) {
        let entry = match out.join(&name).exists() {
            true => FileEntry::of(out, name).map_err(RunError::ReadBack)?,
            false => write(from, out, &name, &events)?,
        };
        if interrupt::requested() {
            return Err(RunError::Interrupted(out.to_owned()));
        }
        progress.steps(events.len());
        files.push(json!({ "file": entry, "split": split, "events": events.len() }));
    }
    drop(progress);
    let index = json!({ "format": INDEX_FORMAT, "run": run, "files": files });
    atomic::write_json(&out.join(INDEX_FILE), &index)?;
    folder.finish()?;
    Ok(Exported { files, is_new: true })
}

/// The names of all tar files of a dataset, with the split and the events of each.
fn tar_files(manifest: &Manifest, events_per_file: usize) -> Vec<(String, Split, Vec<&EventEntry>)> {
    let mut files = Vec::new();
    for split in Split::ALL {
        let events: Vec<&EventEntry> =
            manifest.events.iter().filter(|entry| entry.split() == split).collect();
        for (k, events) in events.chunks(events_per_file).enumerate() {
            files.push((format!("{}-{k:05}.tar", split.name()), split, events.to_vec()));
        }
    }
    files
}

/// A finished export is used unchanged if it is that of a run, and its files are those that it lists.
fn finished(
    out: &Path,
    run: &Run,
    expected: &[(String, Split, Vec<&EventEntry>)],
) -> Result<Exported, RunError> {
    let file = out.join(INDEX_FILE);
    let index: Value = phase_files::json::read(&file)?;
    run.check(out, "a finished", &index["run"])?;
    let altered = |rule: &str| unusable(&file, &format!("{rule}; remove the folder or choose another"));
    let listed: Index = read_as(index.clone()).map_err(|error| altered(&error.to_string()))?;
    let listed = listed.files;
    let names = listed.iter().map(|it| it.file.path.as_str());
    if !names.eq(expected.iter().map(|(name, _, _)| name.as_str())) {
        return Err(altered("field `files` does not have the tar files of this dataset, in order"));
    }
    listed.iter().try_for_each(|it| it.file.verify(out)).map_err(RunError::Altered)?;
    folder::remove_leftovers(out, run)?;
    let files = index["files"].as_array().cloned().unwrap_or_default();
    Ok(Exported { files, is_new: false })
}

/// Writes one tar file.
fn write(from: &Path, out: &Path, name: &str, events: &[&EventEntry]) -> Result<FileEntry, RunError> {
    let failed = |source| WriteError { path: out.join(name), action: "write the file", source };
    let mut tar = Builder::new(MeasuredFile::create(out, name)?);
    for entry in events {
        let labels = labels(entry).map_err(|source| RunError::Serialise { what: "labels", source })?;
        let id = &entry.id;
        let video = entry.video.as_ref().map(|video| (format!("{id}.mp4"), video));
        let event = (format!("{id}.phase-events"), &entry.event);
        append(&mut tar, &format!("{id}.json"), labels.to_string().as_bytes()).map_err(failed)?;
        for (name, file) in [event].into_iter().chain(video) {
            append(&mut tar, &name, &whole(from, file)?).map_err(failed)?;
        }
    }
    Ok(tar.into_inner().map_err(failed)?.commit()?)
}

/// The labels of an event: its entry of the manifest with every member in every event, of one type. Loaders
/// take types from the first events that they see, where a list may be empty and a member null or absent in
/// all of them; so there are no such values, but [`NO_NUMBER`] and empty texts.
fn labels(entry: &EventEntry) -> serde_json::Result<Value> {
    let mut labels = serde_json::to_value(entry)?;
    // Loaders infer signed integers, which some seeds exceed.
    labels["seed"] = entry.seed.to_string().into();
    labels["split"] = entry.split().name().into();
    labels["variant"] = entry.variant.map_or("", Variant::name).into();
    labels["set"] = entry.set.as_ref().map_or_else(
        || json!({ "set": "", "stance": "" }),
        |place| json!({ "set": place.set, "stance": place.stance.name() }),
    );
    labels["layout"]["flip"] = entry.layout.flip.map_or(NO_NUMBER, i64::from).into();
    for (agent, spec) in entry.agents.iter().enumerate() {
        let labels = &mut labels["agents"][agent];
        labels["steps_to_goal"] = spec.steps_to_goal.map_or(NO_NUMBER, |steps| steps as i64).into();
        for id in ["agent", "object", "landmark", "other"] {
            let number = &mut labels["goal"][id];
            if number.is_null() {
                *number = NO_NUMBER.into();
            }
        }
    }
    let size = |object: usize| entry.object_size_levels.get(object).map_or(NO_NUMBER, |&level| level.into());
    labels["object_size_levels"] = (0..MAX_OBJECTS).map(size).collect::<Vec<_>>().into();
    let manners: Vec<&str> = entry.manners.iter().map(|manner| manner.name()).collect();
    labels["manners"] = manners.join(" ").into();
    if entry.video.is_none() {
        labels["video"] = json!({ "path": "", "bytes": 0, "sha256": "" });
    }
    Ok(labels)
}

/// Adds a file without owner and time, so that the same events give the same bytes.
fn append(tar: &mut Builder<MeasuredFile>, name: &str, bytes: &[u8]) -> std::io::Result<()> {
    let mut header = Header::new_ustar();
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    header.set_mtime(0);
    tar.append_data(&mut header, name, bytes)
}

/// The bytes of a file that is as its dataset's manifest says.
fn whole(from: &Path, file: &FileEntry) -> Result<Vec<u8>, RunError> {
    file.verify(from).map_err(RunError::Altered)?;
    Ok(regular::bytes(&file.place(from))?)
}

#[cfg(test)]
mod tests {
    use super::labels;
    use phase_dataset::manifest::EventEntry;
    use serde_json::{Value, json};
    use std::collections::BTreeMap;

    /// The types of all members; every value has to tell its own.
    fn types(value: &Value, path: &str, found: &mut BTreeMap<String, &'static str>) {
        let kind = match value {
            Value::Null => panic!("{path} is null"),
            Value::Bool(_) => "truth",
            Value::Number(number) => {
                assert!(number.is_i64(), "{path}: {number}");
                "number"
            }
            Value::String(_) => "text",
            Value::Array(items) => {
                assert!(!items.is_empty(), "{path} is empty");
                items.iter().for_each(|item| types(item, &format!("{path}[]"), found));
                "list"
            }
            Value::Object(members) => {
                members.iter().for_each(|(name, item)| types(item, &format!("{path}.{name}"), found));
                "object"
            }
        };
        assert!(found.insert(path.into(), kind).is_none_or(|other| other == kind), "{path}");
    }

    #[test]
    fn every_sample_has_the_same_members_of_the_same_types() {
        let file = json!({ "path": "events/a.json", "bytes": 1, "sha256": "" });
        let entry = |goal: Value, more: Value| {
            let agent = json!({
                "size_level": 0, "strength_level": 3, "goal": goal, "alpha": 0, "reached": false,
                "steps_to_goal": more["to_goal"],
            });
            let mut entry = json!({
                "id": "a", "kind": "helping", "relation": "friendly", "seed": u64::MAX, "steps": 3,
                "layout": { "base": 0, "flip": more["flip"] }, "agents": [agent, agent],
                "object_size_levels": more["sizes"], "event": file,
            });
            for (name, value) in more["members"].as_object().expect("an object") {
                entry[name] = value.clone();
            }
            serde_json::from_value::<EventEntry>(entry).expect("an entry")
        };
        let touch = json!({ "kind": "touch", "agent": 0, "other": 1, "sign": -1 });
        let mine = json!({ "kind": "agent_on_landmark", "agent": 1, "landmark": 2, "sign": 1 });
        let carried = json!({ "kind": "object_on_landmark", "object": 0, "landmark": 3, "sign": 1 });
        let set = json!({ "set": "s", "stance": "help" });
        let members = json!({
            "variant": "places", "split": "test", "manners": ["fetching", "crossing"], "video": file,
        });
        let entries = [
            entry(touch, json!({ "to_goal": null, "flip": null, "sizes": [], "members": {} })),
            entry(mine, json!({ "to_goal": 3, "flip": 2, "sizes": [1], "members": members })),
            entry(carried, json!({ "to_goal": 0, "flip": 0, "sizes": [1, 2], "members": { "set": set } })),
        ];
        let [first, second, third] = entries.map(|entry| {
            let labels = labels(&entry).expect("labels");
            let mut found = BTreeMap::new();
            types(&labels, "", &mut found);
            (labels, found)
        });
        assert!(first.1 == second.1 && second.1 == third.1, "{first:?}\n{second:?}\n{third:?}");
        // What there is, is told.
        assert_eq!(first.0["agents"][1]["goal"]["other"], 1);
        assert_eq!(first.0["seed"], u64::MAX.to_string());
        assert_eq!(second.0["manners"], "fetching crossing");
        assert_eq!(
            [&second.0["split"], &second.0["variant"], &third.0["split"]],
            ["test", "places", "train"]
        );
        assert_eq!(third.0["set"], json!({ "set": "s", "stance": "help" }));
        assert_eq!(third.0["object_size_levels"], json!([1, 2]));
    }
}
