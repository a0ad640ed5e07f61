//! Edits of files, whatever their contents, and of those that describe the events.

use super::{
    edit::{alter, flip, insert, space},
    event_edits::one_of,
    folder::{EditedCopy, Original, failed},
    kinds::Made,
};
use phase_dataset::{
    croissant::CROISSANT_FILE,
    manifest::{CARD_FILE, DIGEST_FILE, MANIFEST_FILE, Manifest, video_path},
    overview::Overview,
    parquet::{FOLDER, ParquetWriter},
};
use phase_model::random::Pcg64Mcg;
use phase_runs::{error::RunError, event_writer::video, picture::Look};
use rand::{RngExt, seq::IndexedRandom};
use std::{fs, process::Command};

/// Names of all files but the manifest and its digest.
pub(super) fn listed(copy: &EditedCopy) -> Vec<String> {
    copy.manifest.all_files().map(|file| file.path.to_string()).collect()
}

pub(super) fn some_file(copy: &EditedCopy, random: &mut Pcg64Mcg) -> String {
    listed(copy).choose(random).cloned().unwrap_or_else(|| MANIFEST_FILE.into())
}

/// A file, perhaps the manifest or its digest.
pub(super) fn any_file(copy: &EditedCopy, random: &mut Pcg64Mcg) -> String {
    let mut files = listed(copy);
    files.extend([MANIFEST_FILE, DIGEST_FILE].map(String::from));
    files.choose(random).cloned().unwrap_or_default()
}

pub(super) fn link(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let name = some_file(copy, random);
    move_and_link(copy, &name)
}

pub(super) fn link_of_folder(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let name = ["events", "videos", FOLDER].choose(random).copied().unwrap_or(FOLDER);
    move_and_link(copy, name)
}

#[cfg(unix)]
pub(super) fn move_and_link(copy: &EditedCopy, name: &str) -> Made {
    let path = copy.path().join(name);
    let done =
        fs::rename(&path, copy.beside()).and_then(|()| std::os::unix::fs::symlink(copy.beside(), &path));
    done.map(|()| true).map_err(|source| failed(&path, "link it", source))
}

#[cfg(not(unix))]
pub(super) fn move_and_link(_: &EditedCopy, _: &str) -> Made {
    Ok(false)
}

pub(super) fn pipe(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let path = copy.path().join(any_file(copy, random));
    let made = fs::remove_file(&path).and_then(|()| Command::new("mkfifo").arg(&path).status());
    made.map(|status| status.success()).map_err(|source| failed(&path, "make a pipe", source))
}

pub(super) fn missing(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let path = copy.path().join(any_file(copy, random));
    fs::remove_file(&path).map(|()| true).map_err(|source| failed(&path, "remove it", source))
}

pub(super) fn further(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let folder = ["", "events/", "videos/", "data/", "more/"].choose(random).copied().unwrap_or("");
    if random.random_bool(0.2) {
        let path = copy.path().join(format!("{folder}empty"));
        let made = fs::create_dir_all(&path);
        return made.map(|()| true).map_err(|source| failed(&path, "create the folder", source));
    }
    let name =
        ["small-0009.json", ".hidden", "notes.txt", "a.mp4.part"].choose(random).copied().unwrap_or("x");
    copy.write(&format!("{folder}{name}"), b"").map(|()| true)
}

pub(super) fn bytes_of(copy: &EditedCopy, name: &str, change: impl FnOnce(&mut Vec<u8>) -> bool) -> Made {
    let mut bytes = copy.read(name)?;
    let changed = change(&mut bytes);
    copy.write(name, &bytes)?;
    Ok(changed)
}

pub(super) fn byte(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    bytes_of(copy, &any_file(copy, random), |bytes| flip(bytes, random))
}

pub(super) fn byte_listed(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    bytes_of(copy, &some_file(copy, random), |bytes| flip(bytes, random))
}

pub(super) fn stray(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    bytes_of(copy, &any_file(copy, random), |bytes| {
        insert(bytes, random);
        true
    })
}

pub(super) fn stray_listed(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    bytes_of(copy, &some_file(copy, random), |bytes| {
        insert(bytes, random);
        true
    })
}

pub(super) fn cut(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    bytes_of(copy, &any_file(copy, random), |bytes| {
        bytes.truncate(random.random_range(0..bytes.len().max(1)));
        true
    })
}

pub(super) fn text(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let name = [CARD_FILE, "index.html", "videos/metadata.csv", CROISSANT_FILE].choose(random).copied();
    bytes_of(copy, name.unwrap_or(CARD_FILE), |bytes| {
        let letters: Vec<usize> = (0..bytes.len()).filter(|&k| bytes[k].is_ascii_alphanumeric()).collect();
        let Some(&place) = letters.choose(random) else { return false };
        bytes[place] = if bytes[place] == b'7' { b'8' } else { b'7' };
        true
    })
}

/// Writes the Parquet files of other events.
pub(super) fn parquet(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let names: Vec<String> = listed(copy).into_iter().filter(|name| name.starts_with("events/")).collect();
    let before = names.iter().map(|name| copy.read(name)).collect::<Result<Vec<_>, _>>()?;
    if !one_of(copy, random, &["thoughts", "actions", "substeps", "seed"])? {
        return Ok(false);
    }
    let splits = Overview::of(&copy.manifest).splits;
    let path = copy.path();
    let mut writer = ParquetWriter::new(&path, &splits).map_err(RunError::from)?;
    for entry in &copy.manifest.events {
        let Ok(recording) = copy.recording(entry) else { return Ok(false) };
        writer.push(entry, &recording).map_err(RunError::from)?;
    }
    writer.finish().map_err(RunError::from)?;
    names.iter().zip(before).try_for_each(|(name, bytes)| copy.write(name, &bytes)).map(|()| true)
}

pub(super) fn videos_exchanged(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Some((one, other)) = copy.two_events(random) else { return Ok(false) };
    let [one, other] = [one, other].map(|k| video_path(&copy.manifest.events[k].id));
    copy.exchange(&one, &other).map(|()| true)
}

pub(super) fn frames_exchanged(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Some(entry) = copy.some_event(random) else { return Ok(false) };
    let recording = copy.recording(entry)?;
    let Some(mut simulation) = recording.simulation else { return Ok(false) };
    let steps = simulation.event.steps.len();
    if steps < 2 {
        return Ok(false);
    }
    simulation.event.steps.swap(random.random_range(0..steps - 1), steps - 1);
    copy.write(&video_path(&entry.id), &video(&entry.id, &simulation.event, &Look::default())?).map(|()| true)
}

pub(super) fn in_manifest(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let Ok(mut value) = serde_json::to_value(&copy.manifest) else { return Ok(false) };
    if !alter(&mut value, random) {
        return Ok(false);
    }
    let text = match serde_json::from_value::<Manifest>(value.clone()) {
        Ok(manifest) => manifest.to_text(),
        Err(_) => serde_json::to_string_pretty(&value),
    };
    let Ok(text) = text else { return Ok(false) };
    copy.write(MANIFEST_FILE, text.as_bytes()).map(|()| true)
}

pub(super) fn space_in_manifest(copy: &mut EditedCopy, random: &mut Pcg64Mcg, _: &Original) -> Made {
    let mut text = String::from_utf8_lossy(&copy.read(MANIFEST_FILE)?).into_owned();
    let changed = space(&mut text, random);
    copy.write(MANIFEST_FILE, text.as_bytes()).map(|()| changed)
}
