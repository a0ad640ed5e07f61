//! `serve`: what it refuses, and that it stops when asked to.

use crate::support::{phase, recording, refuse, succeed, write_events};
use std::{
    fs,
    io::{BufRead as _, BufReader, Lines, Read as _, Write as _},
    net::{TcpListener, TcpStream},
    path::Path,
    process::{Child, ChildStdout, Stdio},
};

#[test]
fn what_cannot_be_served_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = taken.local_addr().expect("its address").to_string();
    let sentence = refuse(folder.path(), &["serve", "--listen", &address]);
    assert!(sentence.contains(&address) && sentence.contains("another program uses it"), "{sentence}");
    fs::write(folder.path().join("rubbish.json"), "{}").expect("written");
    let free = ["serve", "--listen", "127.0.0.1:0"];
    for (options, said) in [
        (["--scenes", "nowhere.json"], "nowhere.json"),
        (["--scenes", "rubbish.json"], "rubbish.json"),
        (["--wasm", "nowhere"], "nowhere"),
    ] {
        let sentence = refuse(folder.path(), &[&free[..], &options[..]].concat());
        assert!(sentence.contains(said), "{sentence}");
    }
    for option in [&["--rounds", "5"][..], &["--invite-only"], &["--simulations", "9"], &["--seed", "1"]] {
        let sentence = refuse(folder.path(), &[&free[..], &["--study", "rubbish.json"], option].concat());
        assert!(sentence.contains(&format!("{}: is about games", option[0])), "{sentence}");
    }
    let dataset = ["--scenes", "rubbish.json", "--split", "test"];
    assert!(refuse(folder.path(), &[&free[..], &dataset[..]].concat()).contains("--split needs a dataset"));
    // The folder's name is taken by a file.
    let sentence = refuse(folder.path(), &[&free[..], &["--out", "rubbish.json"]].concat());
    assert!(sentence.contains("rubbish.json"), "{sentence}");
}

/// A running server, at a port that was free.
#[cfg(unix)]
pub(crate) struct Served {
    child: Child,
    /// Its output, which stays open.
    lines: Lines<BufReader<ChildStdout>>,
    /// The first line of what it says: an address.
    pub(crate) first: String,
    address: String,
}

#[cfg(unix)]
impl Served {
    /// Starts one, whose log is `log.txt` in the folder.
    pub(crate) fn start(folder: &Path, options: &[&str]) -> Self {
        let log = fs::File::create(folder.join("log.txt")).expect("a log");
        let mut child = phase(folder)
            .args(["serve", "--listen", "127.0.0.1:0"])
            .args(options)
            .stdout(Stdio::piped())
            .stderr(log)
            .spawn()
            .expect("the program starts");
        let mut lines = BufReader::new(child.stdout.take().expect("its output")).lines();
        let first = lines.next().expect("a line").expect("text");
        let address = first.trim_start_matches("http://").split('/').next().expect("an address").to_owned();
        Self { child, lines, first, address }
    }

    /// The answer to a request, with its head.
    pub(crate) fn get(&self, page: &str) -> String {
        self.get_with(page, "")
    }

    /// As [`Served::get`], with a further line in the request's head.
    fn get_with(&self, page: &str, line: &str) -> String {
        let address = &self.address;
        let mut stream = TcpStream::connect(address).expect("it listens");
        let request = format!("GET {page} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{line}\r\n");
        stream.write_all(request.as_bytes()).expect("written");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    }

    /// Stops it as a terminal or a service manager does.
    pub(crate) fn stop(mut self) {
        let id = self.child.id().to_string();
        let told = std::process::Command::new("kill").args(["-TERM", &id]).status().expect("kill");
        assert!(told.success());
        assert_eq!(self.child.wait().expect("an end").code(), Some(0));
    }
}

/// A dataset's test events are the scenes; SIGTERM ends the program, and what it says is where it can be
/// reached.
#[cfg(unix)]
#[test]
fn it_serves_until_it_is_told_to_stop() {
    let folder = tempfile::tempdir().expect("a folder");
    let made =
        ["gen-dataset", "--events", "2", "--max-steps", "2", "--simulations", "10", "--particles", "5"];
    succeed(folder.path(), &[&made[..], &["--no-video", "--out", "made"]].concat());
    let served = Served::start(folder.path(), &["--scenes", "made", "--split", "train", "--out", "kept"]);
    let answer = served.get("/api/game");
    // Two scenes, although five rounds were asked for.
    assert!(answer.starts_with("HTTP/1.1 200") && answer.contains("\"rounds\":2"), "{answer}");
    served.stop();
    assert!(folder.path().join("kept/rooms").is_dir() && folder.path().join("kept/events").is_dir());
}

/// A download has all recordings or is refused; then the log names the one that is broken.
#[cfg(unix)]
#[test]
fn a_broken_recording_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut served = Served::start(path, &["--out", "kept"]);
    let admin = served.lines.find_map(|line| {
        let line = line.expect("text");
        let (_, token) = line.split_once("/admin/#")?;
        token.split(' ').next().map(|token| format!("Authorization: Bearer {token}\r\n"))
    });
    let admin = admin.expect("the address for the person in charge");
    let recordings = || served.get_with("/admin/api/events.json", &admin);
    assert!(recordings().starts_with("HTTP/1.1 404"), "nothing was played");
    for (id, name) in [("a", "a.json"), ("z", "z.json")] {
        write_events(&path.join("kept/events").join(name), &[recording(id)]);
    }
    let whole = recordings();
    assert!(whole.starts_with("HTTP/1.1 200") && whole.contains("\"id\":\"z\""), "{whole}");
    let event = fs::read(path.join("kept/events/a.json")).expect("a file");
    for (name, bytes, rule) in [
        ("empty.json", &b""[..], "is empty"),
        ("half.json", &event[..event.len() / 2], "line 1"),
        ("other.json", b"{\"format\": \"phase-study/1\"}", "`format`"),
        ("folder.json", b"", "is a folder; a file is needed"),
    ] {
        let file = path.join("kept/events").join(name);
        if name.starts_with("folder") {
            fs::create_dir(&file).expect("a folder");
        } else {
            fs::write(&file, bytes).expect("written");
        }
        let answer = recordings();
        assert!(answer.starts_with("HTTP/1.1 500") && !answer.contains(name), "{answer}");
        let log = fs::read_to_string(path.join("log.txt")).expect("a log");
        let last = log.lines().last().unwrap_or_default();
        assert!(last.starts_with(&format!("error: kept/events/{name}: ")), "{last}");
        assert_eq!(last.matches(rule).count(), 1, "{last}");
        fs::rename(&file, file.with_extension("away")).expect("out of the way");
    }
    assert!(recordings().starts_with("HTTP/1.1 200"));
    served.stop();
}

/// Recordings of games are single files in one folder, which stands for all of them.
#[test]
fn a_folder_of_event_files_is_read_as_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let made =
        ["gen-dataset", "--events", "2", "--max-steps", "2", "--simulations", "10", "--particles", "5"];
    succeed(folder.path(), &[&made[..], &["--no-video", "--out", "made"]].concat());
    let events = folder.path().join("made/events");
    succeed(folder.path(), &["render", "made/events", "--contact-sheet", "2", "--out", "pictures"]);
    let pictures = fs::read_dir(folder.path().join("pictures")).expect("a folder").count();
    assert_eq!(pictures, 2);
    let copied = events.join("demo-0000.json");
    fs::copy(&copied, events.join("copy.json")).expect("copied");
    let sentence = refuse(folder.path(), &["render", "made/events", "--out", "again"]);
    assert!(sentence.contains("demo-0000") && sentence.contains("another file"), "{sentence}");
}
