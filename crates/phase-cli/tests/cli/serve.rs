//! `serve`: what it refuses, and that it stops when asked to.

use crate::support::{phase, refuse, succeed};
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
    _lines: Lines<BufReader<ChildStdout>>,
    /// The first line of what it says: an address.
    pub(crate) first: String,
    address: String,
}

#[cfg(unix)]
impl Served {
    pub(crate) fn start(folder: &Path, options: &[&str]) -> Self {
        let mut child = phase(folder)
            .args(["serve", "--listen", "127.0.0.1:0"])
            .args(options)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let mut lines = BufReader::new(child.stdout.take().expect("its output")).lines();
        let first = lines.next().expect("a line").expect("text");
        let address = first.trim_start_matches("http://").split('/').next().expect("an address").to_owned();
        Self { child, _lines: lines, first, address }
    }

    /// The answer to a request, with its head.
    pub(crate) fn get(&self, page: &str) -> String {
        let address = &self.address;
        let mut stream = TcpStream::connect(address).expect("it listens");
        let request = format!("GET {page} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
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
