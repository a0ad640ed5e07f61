//! Running a command whole, with a fault, and beside itself.

use super::{
    jobs::{Job, PRESET},
    permissions,
};
use crate::error::TortureError;
use core::fmt;
use phase_cli::error::BUILT_WITHOUT;
use phase_files::{WriteError, atomic, fault};
use phase_runs::error::RunError;
use serde_json::Value;
use std::{
    collections::BTreeMap,
    fs, io,
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    thread,
    time::{Duration, Instant},
};
use tempfile::TempDir;

/// Most steps of writing that are looked for.
const MOST_STEPS: u64 = 1 << 20;

/// A command with its input, and what it makes if nothing happens.
pub(super) struct Ground<'a> {
    program: &'a Path,
    job: &'static Job,
    input: TempDir,
    whole: BTreeMap<String, Vec<u8>>,
    seconds: f64,
}

/// End of a run.
pub(super) struct End {
    output: Output,
}

impl End {
    pub(super) fn is_success(&self) -> bool {
        self.output.status.success()
    }

    pub(super) fn was_killed(&self) -> bool {
        matches!(self.output.status.code(), None | Some(fault::KILLED))
    }

    /// Whether it failed in the way that writing fails: exit code 1 or 2, with a sentence.
    pub(super) fn says_it_failed(&self) -> bool {
        matches!(self.output.status.code(), Some(1 | 2)) && self.text().contains("error: ")
    }

    pub(super) fn says_it_is_busy(&self) -> bool {
        self.output.status.code() == Some(2) && self.text().contains("is in use by another run")
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.output.stderr).into_owned()
    }
}

impl fmt::Display for End {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.text();
        write!(formatter, "{} ({})", self.output.status, text.lines().last().unwrap_or_default())
    }
}

impl<'a> Ground<'a> {
    /// Makes the input, and runs the command once; `None` if the program was built without it.
    pub(super) fn new(program: &'a Path, job: &'static Job) -> Result<Option<Self>, TortureError> {
        let input = folder()?;
        let preset = input.path().join(PRESET.0);
        atomic::write(&preset, PRESET.1.as_bytes()).map_err(RunError::Output)?;
        let mut ground = Self { program, job, input, whole: BTreeMap::new(), seconds: 0.0 };
        for command in job.prepare {
            let output =
                ground.program().current_dir(ground.input.path()).args(command.split_whitespace()).output();
            ground.expect(&End { output: output.map_err(TortureError::Start)? })?;
        }
        if permissions::EXIST {
            // Whoever is not an administrator has to read it, too.
            let shown = permissions::show(ground.input.path());
            shown.map_err(|source| failed(ground.input.path(), "show", source))?;
        }
        let place = ground.place()?;
        let begun = Instant::now();
        let end = ground.run(&place)?;
        if end.text().contains(BUILT_WITHOUT) {
            return Ok(None);
        }
        ground.expect(&end)?;
        ground.seconds = begun.elapsed().as_secs_f64();
        ground.whole = tree(&place.path().join("out"))?;
        Ok(Some(ground))
    }

    fn expect(&self, end: &End) -> Result<(), TortureError> {
        if end.is_success() {
            return Ok(());
        }
        let problem = format!("cannot be run at all: it ended with {end}");
        Err(TortureError::Undisturbed { what: self.job.name, problem })
    }

    /// Time that the command takes (s).
    pub(super) const fn seconds(&self) -> f64 {
        self.seconds
    }

    /// A fresh folder to run the command in.
    pub(super) fn place(&self) -> Result<TempDir, TortureError> {
        let place = folder()?;
        if self.job.command.split_whitespace().any(|word| word.starts_with("out/")) {
            let out = place.path().join("out");
            fs::create_dir(&out).map_err(|source| failed(&out, "create the folder", source))?;
        }
        Ok(place)
    }

    fn command(&self, place: &TempDir) -> Command {
        let input = self.input.path().to_string_lossy();
        let mut command = self.program();
        command.current_dir(place.path()).stdout(Stdio::null()).stderr(Stdio::piped());
        command.args(self.job.command.split_whitespace().map(|word| word.replace("{in}", &input)));
        command
    }

    fn program(&self) -> Command {
        let mut command = Command::new(self.program);
        command.env_remove(fault::VARIABLE);
        command
    }

    pub(super) fn run(&self, place: &TempDir) -> Result<End, TortureError> {
        finish(self.command(place).spawn().map_err(TortureError::Start)?)
    }

    pub(super) fn run_with_fault(&self, place: &TempDir, fault: &str) -> Result<End, TortureError> {
        let mut command = self.command(place);
        finish(command.env(fault::VARIABLE, fault).spawn().map_err(TortureError::Start)?)
    }

    pub(super) fn run_and_kill(&self, place: &TempDir, after: Duration) -> Result<End, TortureError> {
        let mut child = self.command(place).spawn().map_err(TortureError::Start)?;
        thread::sleep(after);
        // It may have ended by itself.
        let _ = child.kill();
        finish(child)
    }

    /// Runs the command where no file may be larger. The signal is ignored, so that writing fails as on a
    /// full disk.
    pub(super) fn run_on_small_disk(&self, place: &TempDir, bytes: u64) -> Result<End, TortureError> {
        let inner = self.command(place);
        let script = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", bytes.div_ceil(512));
        let mut command = Command::new("sh");
        command.args(["-c", &script, "sh"]).arg(inner.get_program()).args(inner.get_args());
        command.current_dir(place.path()).stdout(Stdio::null()).stderr(Stdio::piped());
        finish(command.spawn().map_err(TortureError::Start)?)
    }

    /// Runs the command, and takes away its permission to write after a time. Returns how it ended.
    pub(super) fn revoke(&self, place: &TempDir, after: Duration) -> Result<End, TortureError> {
        let path = place.path();
        permissions::own(path).map_err(|source| failed(path, "give away", source))?;
        let mut command = self.command(place);
        permissions::bind(&mut command);
        let child = command.spawn().map_err(TortureError::Start)?;
        thread::sleep(after);
        permissions::revoke(path).map_err(|source| failed(path, "make read-only", source))?;
        let end = finish(child)?;
        permissions::give_back(path).map_err(|source| failed(path, "make writable", source))?;
        Ok(end)
    }

    /// Two processes at once.
    pub(super) fn race(&self, place: &TempDir) -> Result<Vec<End>, TortureError> {
        let start = || self.command(place).spawn().map_err(TortureError::Start);
        let children = [start()?, start()?];
        children.into_iter().map(finish).collect()
    }

    /// Number of steps of writing: the first at which a stop comes too late.
    pub(super) fn steps(&self) -> Result<u64, TortureError> {
        let stops = |step: u64| -> Result<bool, TortureError> {
            Ok(!self.run_with_fault(&self.place()?, &format!("kill@{step}"))?.is_success())
        };
        let mut high = 1;
        while stops(high)? {
            high *= 2;
            if high > MOST_STEPS {
                let problem = format!("it has more than {MOST_STEPS} steps of writing");
                return Err(TortureError::Undisturbed { what: self.job.name, problem });
            }
        }
        let mut low = high / 2;
        while high - low > 1 {
            let middle = low.midpoint(high);
            if stops(middle)? { low = middle } else { high = middle }
        }
        Ok(low.max(1))
    }

    /// Whether a file is what an undisturbed run writes.
    fn is_whole(&self, name: &str, bytes: &[u8]) -> bool {
        let Some(whole) = self.whole.get(name) else { return false };
        let is_compared = self.job.same.is_empty() || self.job.same.contains(&name);
        !is_compared
            || whole == bytes
            || without_times(whole).is_some_and(|it| Some(it) == without_times(bytes))
    }

    /// A file under its own name that is not what a whole run writes there.
    pub(super) fn damaged(&self, place: &TempDir) -> Result<Option<String>, TortureError> {
        let found = tree(&place.path().join("out"))?;
        let visible = found.iter().filter(|(name, _)| !name.split('/').any(|part| part.starts_with('.')));
        let mut wrong = visible.filter(|(name, bytes)| {
            self.job.meanwhile.is_none_or(|expected| expected != *name) && !self.is_whole(name, bytes)
        });
        Ok(wrong.next().map(|(name, _)| name.clone()))
    }

    /// A file that differs from what a whole run leaves, or is missing or extra.
    pub(super) fn different(&self, place: &TempDir) -> Result<Option<String>, TortureError> {
        let found = tree(&place.path().join("out"))?;
        let missing = self.whole.keys().find(|name| !found.contains_key(*name));
        let other = found.iter().find(|(name, bytes)| !self.is_whole(name, bytes));
        Ok(missing.or(other.map(|(name, _)| name)).cloned())
    }
}

/// A JSON file without the CPU times in it; `None` for other files.
fn without_times(bytes: &[u8]) -> Option<Value> {
    fn remove(value: &mut Value) {
        match value {
            Value::Array(items) => items.iter_mut().for_each(remove),
            Value::Object(members) => {
                members.retain(|name, _| !name.starts_with("cpu_seconds"));
                members.values_mut().for_each(remove);
            }
            _ => {}
        }
    }
    let mut value = serde_json::from_slice(bytes).ok()?;
    remove(&mut value);
    Some(value)
}

fn finish(child: Child) -> Result<End, TortureError> {
    Ok(End { output: child.wait_with_output().map_err(TortureError::Start)? })
}

fn folder() -> Result<TempDir, TortureError> {
    tempfile::tempdir().map_err(|source| failed(&std::env::temp_dir(), "create a folder", source))
}

/// Every file below a folder, by its name with `/`; nothing if there is no folder.
fn tree(root: &Path) -> Result<BTreeMap<String, Vec<u8>>, TortureError> {
    let mut files = BTreeMap::new();
    let mut folders: Vec<PathBuf> = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = match fs::read_dir(&folder).and_then(Iterator::collect::<io::Result<Vec<_>>>) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            entries => entries.map_err(|source| failed(&folder, "read the folder", source))?,
        };
        for entry in entries {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(root).unwrap_or(&path).components();
                let name = name.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/");
                files.insert(name, fs::read(&path).map_err(|source| failed(&path, "read the file", source))?);
            }
        }
    }
    Ok(files)
}

pub(super) fn failed(path: &Path, action: &'static str, source: io::Error) -> TortureError {
    RunError::Output(WriteError { path: path.to_owned(), action, source }).into()
}
