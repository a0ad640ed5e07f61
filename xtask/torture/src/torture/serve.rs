//! `serve`, with raters and a player while it is disturbed: what they were told is there when it is started
//! again, and goes on.

mod client;
mod server;

use super::{Torment, permissions};
use crate::error::TortureError;
use client::{Player, Rater};
use core::fmt;
use phase_model::random::Pcg64Mcg;
use phase_runs::error::RunError;
use rand::RngExt;
use serde_json::json;
use server::{Server, Start};
use std::{
    fs,
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
    thread,
    time::Duration,
};
use tempfile::TempDir;

/// The name of its row.
pub(super) const NAME: &str = "serve";
/// Torments of a server. Its journals and answers are appended to, not written by steps.
pub(super) const TORMENTS: [Torment; 4] = [Torment::Kill, Torment::SmallDisk, Torment::Revoke, Torment::Race];

/// Raters who answer at the same time.
const RATERS: usize = 3;
/// Videos that each of them judges: more than there is time for.
const VIDEOS: usize = 400;
/// First and last moment at which a server is disturbed (s after people have come). A step of a game takes a
/// quarter of a second.
const MOMENTS: (f64, f64) = (0.1, 2.5);
/// Time for which people go on with a server that lost its permissions (s).
const AFTERWARDS: f64 = 0.4;
/// Longest file of a server whose disk is small (bytes): from too small to begin to enough for a while.
const SMALL_DISK: (u64, u64) = (8_000, 300_000);

/// Reason that a server cannot be tortured at all, or something that went wrong.
struct Wrong(String);

impl<T: fmt::Display> From<T> for Wrong {
    fn from(what: T) -> Self {
        Self(what.to_string())
    }
}

/// Whether the program has `serve`.
pub(super) fn is_built_in(program: &Path) -> Result<bool, TortureError> {
    let place = place(false)?;
    let cannot = |problem: String| TortureError::Undisturbed { what: NAME, problem };
    match Server::start(program, place.path(), &Start::default()) {
        Ok(_) => Ok(true),
        Err(error) if error.contains(phase_cli::error::BUILT_WITHOUT) => Ok(false),
        Err(error) => Err(cannot(format!("cannot be run at all: {error}"))),
    }
}

/// Starts a server in a fresh folder, does something to it while people use it, and starts it again: what is
/// wrong then, if anything.
pub(super) fn inflict(
    program: &Path,
    torment: Torment,
    random: &mut Pcg64Mcg,
) -> Result<Option<String>, TortureError> {
    let is_plain = torment == Torment::Revoke;
    let place = place(is_plain)?;
    let moment = Duration::from_secs_f64(random.random_range(MOMENTS.0..MOMENTS.1));
    let largest_file =
        (torment == Torment::SmallDisk).then(|| random.random_range(SMALL_DISK.0..SMALL_DISK.1));
    let start = Start { largest_file, is_plain };
    Ok(suffer(program, place.path(), torment, moment, &start).err().map(|Wrong(what)| what))
}

fn suffer(
    program: &Path,
    place: &Path,
    torment: Torment,
    moment: Duration,
    start: &Start,
) -> Result<(), Wrong> {
    let again = Start { largest_file: None, ..*start };
    let first = match Server::start(program, place, start) {
        Ok(server) => server,
        // A disk that is too small to begin with.
        Err(sentence) if torment == Torment::SmallDisk && sentence.contains("error: ") => {
            Server::start(program, place, &again)?;
            return Ok(());
        }
        Err(error) => return Err(error.into()),
    };
    let (raters, player) = use_it(first, program, place, torment, moment, start)?;
    let second = Server::start(program, place, &again).map_err(|error| format!("afterwards: {error}"))?;
    for rater in &raters {
        rater.check(second.address)?;
    }
    if let Some(player) = player {
        player.check(second.address, &place.join("out"))?;
    }
    Ok(())
}

/// Lets people use a server, disturbs it, and ends it. Returns the people, with what they were told.
fn use_it(
    mut server: Server,
    program: &Path,
    place: &Path,
    torment: Torment,
    moment: Duration,
    start: &Start,
) -> Result<(Vec<Rater>, Option<Player>), Wrong> {
    let over = AtomicBool::new(false);
    let address = server.address;
    thread::scope(|scope| {
        let people: Vec<_> = (0..RATERS).map(|k| scope.spawn(move || Rater::take_part(address, k))).collect();
        let over = &over;
        let admin = server.admin.clone();
        let player = scope.spawn(move || Player::play(address, &admin, over));
        thread::sleep(moment);
        let disturb = || -> Result<(), Wrong> {
            match torment {
                Torment::Revoke => {
                    permissions::revoke(place)?;
                    thread::sleep(Duration::from_secs_f64(AFTERWARDS));
                }
                Torment::Race => match Server::start(program, place, start) {
                    Ok(_) => return Err("a second server uses the same folder".into()),
                    Err(error) if error.contains("is in use by another run") => {}
                    Err(error) => return Err(format!("a second server ended with {error}").into()),
                },
                _ => {}
            }
            Ok(())
        };
        let disturbed = disturb();
        // It may have ended by itself, which is wrong; what it said is told.
        let ended = server.end_now();
        over.store(true, Ordering::Relaxed);
        let raters = people.into_iter().flat_map(thread::ScopedJoinHandle::join).collect();
        let player = player.join().unwrap_or_default();
        if torment == Torment::Revoke {
            permissions::give_back(place)?;
        }
        disturbed?;
        match ended {
            Some(how) => Err(format!("the server ended by itself: {how}").into()),
            None => Ok((raters, player)),
        }
    })
}

/// A fresh folder with a study.
fn place(is_plain: bool) -> Result<TempDir, TortureError> {
    let place = tempfile::tempdir()
        .map_err(|source| super::run::failed(&std::env::temp_dir(), "create a folder", source))?;
    let write = |name: &str, bytes: &[u8]| {
        phase_files::atomic::write(&place.path().join(name), bytes)
            .map_err(|error| TortureError::from(RunError::Output(error)))
    };
    let mut stimuli = Vec::with_capacity(VIDEOS);
    for k in 0..VIDEOS {
        let video = format!("event-{k}.mp4");
        write(&video, b"no video, which nobody looks at here")?;
        stimuli.push(json!({ "id": format!("event-{k}"), "video": video }));
    }
    let study = json!({
        "format": "phase-study/1", "name": "torture", "title": "Torture", "form": "relation",
        "consent": ["Do you agree?"], "instructions": ["Watch."], "stimuli": stimuli,
        "raters_per_video": RATERS, "videos_per_rater": VIDEOS,
    });
    write("torture.json", study.to_string().as_bytes())?;
    let agent = |number: u8, landmark: u8| {
        json!({
            "size_level": 0, "strength_level": 3, "alpha": 0,
            "goal": { "kind": "agent_on_landmark", "agent": number, "landmark": landmark, "sign": 1 },
        })
    };
    let scene = json!({
        "id": "scene", "layout": { "base": 0 }, "objects": [], "event": "independent",
        "agents": [agent(0, 1), agent(1, 0)],
        "trajectory": {
            "columns": ["x", "y", "vx", "vy", "angle"], "objects": [],
            "agents": [[[23.5, 8, 0, 0, 0]], [[8.5, 8, 0, 0, 0]]],
        },
    });
    let scenes = json!({ "format": "phase-events/1", "events": [scene] });
    write("scenes.json", scenes.to_string().as_bytes())?;
    let out = place.path().join("out");
    fs::create_dir(&out).map_err(|source| super::run::failed(&out, "create the folder", source))?;
    if is_plain {
        permissions::own(place.path())
            .map_err(|source| super::run::failed(place.path(), "give away", source))?;
    }
    Ok(place)
}
