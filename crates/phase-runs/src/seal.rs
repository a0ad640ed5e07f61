//! Datasets whose labels nobody can look up or make again: motion is published, and digests of everything
//! else, until somebody opens the seal.
//!
//! Presets and the generator are public, so a dataset is as secret as its seed. [`seal`] publishes the motion
//! of its events under names and in an order that reveal nothing, and the SHA-256 of its manifest and of the
//! questions about it. [`unseal`] makes the same files again and compares every byte.

use crate::{
    error::RunError,
    laboratory::clips::source_digest,
    laboratory::unusable,
    listener::Listener,
    questions::{INDEX_FILE, QUESTIONS_FILE, questions},
    source::EventInput,
};
use phase_dataset::manifest::{MANIFEST_FILE, Manifest};
use phase_event::{FILE_FORMAT, Recording};
use phase_files::{
    FileError, Problem,
    checksum::{FileEntry, sha256_hex},
    incidental::is_incidental_below,
    new_folder::NewFolder,
    regular,
};
use phase_model::json::read_as;
use phase_questions::{Control, Question};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// The description of what is sealed.
pub const SEAL_FILE: &str = "seal.json";
/// The value of its field `format`.
const FORMAT: &str = "phase-seal/1";
/// The motion of all events.
const EVENTS_FILE: &str = "events.json";
/// The least seed that counts as secret: a smaller one is soon found by trying all.
const LEAST_SEED: u64 = 1 << 48;
/// Digits of the manifest's digest in names: 32 bits.
const NAMED_DIGITS: usize = 8;

/// The content of `seal.json`.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seal {
    /// Always `phase-seal/1`.
    pub format: String,
    /// Number of events.
    pub events: usize,
    /// SHA-256 of the manifest of the dataset, which has its seed, all labels and the digests of all files.
    pub manifest_sha256: String,
    /// SHA-256 of the questions with their answers, if there are any.
    pub questions_sha256: Option<String>,
    /// The published files.
    pub files: Vec<FileEntry>,
}

/// The file that is published, by its path, with its content or the file that it is a copy of.
enum Published {
    Text(String),
    Copy(PathBuf),
}

/// Seals a finished dataset, and perhaps a folder of questions about it, into a new folder.
///
/// # Errors
/// If the dataset, the questions or the folder cannot be used, or the seed can be guessed.
pub fn seal(
    dataset: &Path,
    benchmark: Option<&Path>,
    out: &Path,
    listener: &dyn Listener,
) -> Result<Seal, RunError> {
    let new = NewFolder::create(out)?;
    let (mut seal, published) = contents(dataset, benchmark, listener)?;
    for (path, content) in &published {
        match content {
            Published::Text(text) => new.write(path, text.as_bytes())?,
            Published::Copy(from) => new.write(path, &regular::bytes(from)?)?,
        }
        seal.files.push(FileEntry::of(new.part(), path.as_str()).map_err(RunError::ReadBack)?);
    }
    let text = serde_json::to_string_pretty(&seal);
    let text = text.map_err(|source| RunError::Serialise { what: "the seal", source })?;
    new.write(SEAL_FILE, format!("{text}\n").as_bytes())?;
    new.commit()?;
    Ok(seal)
}

/// Opens a seal: proves that the published files are those of this dataset, and of these questions, whose
/// digests were published with them. Returns the names of the events by those that were published.
///
/// # Errors
/// If a file cannot be used, or one is not what was sealed.
pub fn unseal(
    published: &Path,
    dataset: &Path,
    benchmark: Option<&Path>,
    listener: &dyn Listener,
) -> Result<BTreeMap<String, String>, RunError> {
    let file = published.join(SEAL_FILE);
    let value: Value = phase_files::json::read(&file)?;
    let sealed: Seal = read_as(value).map_err(|error| unusable(&file, &error.to_string()))?;
    if sealed.format != FORMAT {
        return Err(unusable(&file, &format!("format: must be {FORMAT:?}, not {:?}", sealed.format)));
    }
    for file in &sealed.files {
        file.verify(published).map_err(RunError::Altered)?;
    }
    check_extra(published, "", &sealed)?;
    let (found, contents) = contents(dataset, benchmark, listener)?;
    let differs = |what: &str| Err(unusable(&file, &format!("{what} is not what was sealed")));
    if found.manifest_sha256 != sealed.manifest_sha256 {
        return differs(&format!("the manifest of {}", dataset.display()));
    }
    if found.questions_sha256 != sealed.questions_sha256 {
        return match (benchmark, &sealed.questions_sha256) {
            (Some(folder), Some(_)) => differs(&format!("the file of questions of {}", folder.display())),
            (None, _) => Err(unusable(&file, "questions were sealed, too: give their folder")),
            _ => Err(unusable(&file, "no questions were sealed")),
        };
    }
    if found.events != sealed.events {
        let (events, dataset) = (found.events, dataset.display());
        let rule = format!("field `events` must be {events}, as in {dataset}, not {}", sealed.events);
        return Err(unusable(&file, &rule));
    }
    let mut names: Vec<&str> = sealed.files.iter().map(|file| file.path.as_str()).collect();
    names.sort_unstable();
    if !names.into_iter().eq(contents.keys().map(String::as_str)) {
        return differs("the list of files");
    }
    for (path, content) in &contents {
        let bytes = match content {
            Published::Text(text) => text.as_bytes().to_vec(),
            Published::Copy(from) => regular::bytes(from)?,
        };
        if sha256_hex(&bytes) != sha256_hex(&regular::bytes(&published.join(path))?) {
            return differs(&format!("{path}, made again,"));
        }
    }
    let manifest = Manifest::read(&dataset.join(MANIFEST_FILE))?;
    let ids = manifest.events.iter().map(|event| event.id.as_str());
    let secret = secret_of(&manifest, &found.manifest_sha256);
    let names = names_of(ids, &secret, &found.manifest_sha256);
    Ok(names.into_iter().map(|(id, name)| (name, id.to_owned())).collect())
}

/// Checks that a published folder holds nothing but the seal, the files that it lists, and what systems and
/// tools leave in folders. `below` is the folder to look into, relative to the published one: a path that
/// ends with `/`, or an empty one.
fn check_extra(published: &Path, below: &str, sealed: &Seal) -> Result<(), RunError> {
    let folder = published.join(below);
    let unreadable = |error| FileError { file: folder.clone(), problem: Problem::Unreadable(error) };
    for entry in fs::read_dir(&folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let path = format!("{below}{}", entry.file_name().to_string_lossy());
        let is_folder = entry.file_type().map_err(unreadable)?.is_dir();
        if path == SEAL_FILE
            || is_incidental_below(&path, is_folder)
            || sealed.files.iter().any(|file| file.path.as_str() == path)
        {
            continue;
        }
        if is_folder {
            check_extra(published, &format!("{path}/"), sealed)?;
        } else {
            let rule = format!("is none of the `files` of {SEAL_FILE}, and was not sealed");
            return Err(unusable(&entry.path(), &rule));
        }
    }
    Ok(())
}

/// Secret that decides names and their order. The digest of the manifest is published; this cannot be made
/// of it.
fn secret_of(manifest: &Manifest, manifest_sha256: &str) -> String {
    sha256_hex(format!("{} {manifest_sha256}", manifest.seed).as_bytes())
}

/// Names that reveal nothing, in an order that depends on a secret. They begin with the published digest of
/// the manifest, so that answers to one sealed dataset are not taken for those to another.
fn names_of<'a>(
    ids: impl Iterator<Item = &'a str>,
    secret: &str,
    manifest_sha256: &str,
) -> BTreeMap<&'a str, String> {
    let dataset = manifest_sha256.get(..NAMED_DIGITS).unwrap_or_default();
    let key = |id: &str| sha256_hex(format!("{secret} {id}").as_bytes());
    let distinct: BTreeSet<&str> = ids.collect();
    let mut ordered: Vec<(String, &str)> = distinct.into_iter().map(|id| (key(id), id)).collect();
    ordered.sort();
    ordered
        .into_iter()
        .enumerate()
        .map(|(k, (_, id))| (id, format!("sealed-{dataset}-{:04}", k + 1)))
        .collect()
}

/// Everything that is published of a dataset, but for the list of files.
fn contents(
    dataset: &Path,
    benchmark: Option<&Path>,
    listener: &dyn Listener,
) -> Result<(Seal, BTreeMap<String, Published>), RunError> {
    let file = dataset.join(MANIFEST_FILE);
    let manifest = Manifest::read(&file)?;
    if manifest.seed < LEAST_SEED {
        let rule = format!(
            "seed {} can be found by trying; generate the dataset with a random one of at least {LEAST_SEED}",
            manifest.seed
        );
        return Err(unusable(&file, &rule));
    }
    manifest.verify(dataset).map_err(RunError::Altered)?;
    let manifest_sha256 = sha256_hex(&regular::bytes(&file)?);
    let secret = secret_of(&manifest, &manifest_sha256);
    let ids = manifest.events.iter().map(|event| event.id.as_str());
    let names = names_of(ids, &secret, &manifest_sha256);
    let source = EventInput::open(dataset, &[], listener)?;
    let mut published = BTreeMap::new();
    let mut motion = BTreeMap::new();
    for index in 0..source.len() {
        let recording = source.load(index)?;
        let name = names.get(recording.id.as_str()).cloned().unwrap_or_default();
        motion.insert(name.clone(), without_labels(&recording, &name)?);
    }
    let events: Vec<&Value> = motion.values().collect();
    let text = json!({ "format": FILE_FORMAT, "events": events }).to_string() + "\n";
    published.insert(EVENTS_FILE.to_owned(), Published::Text(text));
    for event in &manifest.events {
        if let (Some(video), Some(name)) = (&event.video, names.get(event.id.as_str())) {
            published.insert(format!("videos/{name}.mp4"), Published::Copy(video.place(dataset)));
        }
    }
    let mut questions_sha256 = None;
    if let Some(folder) = benchmark {
        let file = folder.join(QUESTIONS_FILE);
        let all = questions(&file)?;
        let known: BTreeSet<&str> = names.keys().copied().collect();
        if let Some(question) = all.iter().find(|it| it.events.iter().any(|id| !known.contains(id.as_str())))
        {
            return Err(unusable(&file, &format!("question {} is not about the dataset", question.id)));
        }
        // Events of other datasets may have the same ids.
        let index = folder.join(INDEX_FILE);
        if phase_files::json::read(&index)?["run"]["events"] != json!([source_digest(&source)?]) {
            return Err(unusable(&index, &format!("is not about the events of {}", dataset.display())));
        }
        questions_sha256 = Some(sha256_hex(&regular::bytes(&file)?));
        let secret = format!("{secret} questions");
        let videos = all.iter().map(|question| question.video.as_str());
        let videos = names_of(videos, &secret, &manifest_sha256);
        let mut lines = String::new();
        for question in &all {
            lines += &public_question(question, &videos);
        }
        published.insert(QUESTIONS_FILE.to_owned(), Published::Text(lines));
        for (video, name) in &videos {
            let from = folder.join("videos").join(format!("{video}.mp4"));
            if from.exists() {
                published.insert(format!("question-videos/{name}.mp4"), Published::Copy(from));
            }
        }
    }
    let events = names.len();
    let format = FORMAT.to_owned();
    Ok((Seal { format, events, manifest_sha256, questions_sha256, files: Vec::new() }, published))
}

/// Layout, sizes and motion of an event under another name.
fn without_labels(recording: &Recording, name: &str) -> Result<Value, RunError> {
    let unreadable = |source| RunError::Serialise { what: "an event", source };
    let whole: Value = serde_json::from_str(&recording.to_json()?).map_err(unreadable)?;
    let sizes = |list: &Value| -> Vec<Value> {
        let all = list.as_array().into_iter().flatten();
        all.map(|it| json!({ "size_level": it["size_level"] })).collect()
    };
    Ok(json!({
        "id": name,
        "layout": whole["layout"],
        "agents": sizes(&whole["agents"]),
        "objects": sizes(&whole["objects"]),
        "trajectory": whole["trajectory"],
    }))
}

/// A question without its answer, its proof and what it is about, as a line.
fn public_question(question: &Question, videos: &BTreeMap<&str, String>) -> String {
    let (options, _) = question.shown(Control::Video);
    let value = json!({
        "id": question.id,
        "task": question.query.type_name(),
        "video": videos.get(question.video.as_str()),
        "question": question.text,
        "options": options,
    });
    value.to_string() + "\n"
}
