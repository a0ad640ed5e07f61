//! Comparison of the files in a folder with those that its manifest names.

use crate::DatasetProblem;
use crate::manifest::{DIGEST_FILE, MANIFEST_FILE, Manifest, SIGNATURE_FILES, digest_line};
use phase_event::EventReadError;
use phase_files::{
    FileError, Problem,
    checksum::{FileEntry, sha256_hex},
    incidental::is_incidental_below,
    json, regular,
};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs, io,
    path::Path,
};

/// Checks that the manifest's file is as [`Manifest::write`] writes it, and that its digest is beside it.
pub(super) fn manifest(folder: &Path, manifest: &Manifest, problems: &mut Vec<FileError>) {
    let path = folder.join(MANIFEST_FILE);
    let bytes = match json::bytes(&path) {
        Ok(bytes) => bytes,
        Err(error) => return problems.push(error),
    };
    let mut fail = |file: &str, problem| problems.push(FileError { file: folder.join(file), problem });
    match manifest.to_text() {
        Ok(text) if text.as_bytes() == bytes => {}
        Ok(_) => fail(MANIFEST_FILE, DatasetProblem::Form.into()),
        Err(error) => fail(MANIFEST_FILE, DatasetProblem::Encode(error).into()),
    }
    let digest = folder.join(DIGEST_FILE);
    // What is there, but no file, is reported with all such things.
    let about = fs::symlink_metadata(&digest);
    if about.as_ref().is_ok_and(|about| !about.is_file()) {
        return;
    }
    match regular::bytes(&digest) {
        Err(FileError { problem: Problem::Unreadable(error), .. })
            if error.kind() == io::ErrorKind::NotFound =>
        {
            fail(DIGEST_FILE, DatasetProblem::Unlisted.into())
        }
        Ok(line) if line == digest_line(&sha256_hex(&bytes)).as_bytes() => {}
        Ok(_) => fail(DIGEST_FILE, Problem::Differs(format!("the digest of {MANIFEST_FILE}"))),
        Err(error) => fail(DIGEST_FILE, error.problem),
    }
}

/// The files that the manifest names, by path; every path and every id may be named once, whatever its case.
pub(super) fn listed<'a>(
    folder: &Path,
    manifest: &'a Manifest,
    problems: &mut Vec<FileError>,
) -> BTreeMap<&'a str, &'a FileEntry> {
    let mut fail = |problem| problems.push(FileError { file: folder.join(MANIFEST_FILE), problem });
    let mut ids = BTreeSet::new();
    for event in &manifest.events {
        if !ids.insert(event.id.to_ascii_lowercase()) {
            fail(Problem::content(EventReadError::DuplicateId(event.id.clone())));
        }
    }
    let mut files = BTreeMap::new();
    let mut names = BTreeSet::new();
    for file in manifest.all_files() {
        let path = file.path.as_str();
        if !names.insert(path.to_lowercase()) {
            fail(DatasetProblem::DuplicatePath(path.into()).into());
        }
        files.insert(path, file);
    }
    files
}

/// Everything wrong with the things in a folder: files that the manifest does not name, folders without files
/// that it names, links, and what is neither a file nor a folder. The paths of named files that are links or
/// no files are added to `broken`: nothing outside is looked at, and nothing is waited for. `noted` is told
/// of what systems and tools leave.
pub(super) fn foreign<'a>(
    folder: &Path,
    files: &BTreeMap<&'a str, &FileEntry>,
    broken: &mut BTreeSet<&'a str>,
    problems: &mut Vec<FileError>,
    noted: &mut dyn FnMut(&Path),
) {
    Walk { root: folder, files, broken, problems, noted }.folder(folder);
}

struct Walk<'a, 'b> {
    root: &'b Path,
    files: &'b BTreeMap<&'a str, &'b FileEntry>,
    broken: &'b mut BTreeSet<&'a str>,
    problems: &'b mut Vec<FileError>,
    noted: &'b mut dyn FnMut(&Path),
}

impl Walk<'_, '_> {
    fn fail(&mut self, path: &Path, problem: Problem) {
        self.problems.push(FileError { file: path.to_owned(), problem });
    }

    /// The path as the manifest has it.
    fn name(&self, path: &Path) -> String {
        let parts = path.strip_prefix(self.root).unwrap_or(path).components();
        parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
    }

    fn folder(&mut self, folder: &Path) {
        let entries = match fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>) {
            Ok(entries) => entries,
            Err(error) => return self.fail(folder, Problem::Unreadable(error)),
        };
        let mut entries: Vec<_> = entries.iter().map(|entry| (entry.path(), entry.file_type())).collect();
        entries.sort_by(|a, b| a.0.cmp(&b.0));
        for (path, kind) in entries {
            match kind {
                Ok(kind) if self.is_incidental(&path, kind) => (self.noted)(&path),
                Ok(kind) if kind.is_dir() && self.files.contains_key(self.name(&path).as_str()) => {
                    self.special(&path, false);
                }
                Ok(kind) if kind.is_dir() && self.is_needed(&path) => self.folder(&path),
                Ok(kind) if kind.is_dir() => self.empty(&path),
                Ok(kind) if kind.is_file() => self.file(&path),
                Ok(kind) => self.special(&path, kind.is_symlink()),
                Err(error) => self.fail(&path, Problem::Unreadable(error)),
            }
        }
    }

    /// Whether a system or tool left this file, or this folder, which is not looked into.
    fn is_incidental(&self, path: &Path, kind: fs::FileType) -> bool {
        let name = self.name(path);
        let known = (kind.is_file() || kind.is_dir()) && is_incidental_below(&name, kind.is_dir());
        known && !self.files.contains_key(name.as_str()) && !self.is_needed(path)
    }

    /// Whether the manifest names something in a folder.
    fn is_needed(&self, folder: &Path) -> bool {
        let begin = format!("{}/", self.name(folder));
        self.files.range(begin.as_str()..).next().is_some_and(|(path, _)| path.starts_with(&begin))
    }

    /// Reports everything in a folder that should not be there, or the folder itself if it is empty.
    fn empty(&mut self, folder: &Path) {
        match fs::read_dir(folder).map(|mut entries| entries.next().is_none()) {
            Ok(true) => self.fail(folder, DatasetProblem::Extra.into()),
            _ => self.folder(folder),
        }
    }

    fn file(&mut self, path: &Path) {
        let name = self.name(path);
        let beside = [MANIFEST_FILE, DIGEST_FILE].into_iter().chain(SIGNATURE_FILES);
        if !self.files.contains_key(name.as_str()) && !beside.into_iter().any(|known| known == name) {
            self.fail(path, DatasetProblem::Extra.into());
        }
    }

    fn special(&mut self, path: &Path, is_link: bool) {
        let name = self.name(path);
        let below = |listed: &str| {
            listed.strip_prefix(&name).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        self.broken.extend(self.files.keys().copied().filter(|listed| below(listed)));
        self.fail(path, if is_link { Problem::Link } else { Problem::NoFile });
    }
}
