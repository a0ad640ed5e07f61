//! Clients that do not behave: they are the only ones who notice.

use crate::support::{Player, Running, settings};
use phase_game::{Entry, GameSettings, Room, Round, journal::entries};
use serde_json::{Value, json};
use std::{
    fs,
    io::{Read as _, Write as _},
    net::TcpStream,
    path::Path,
    time::{Duration, Instant},
};
use tokio_tungstenite::tungstenite::Message;

fn text(message: &Value) -> Message {
    Message::text(message.to_string())
}

/// A player's flood makes the other one's page neither close nor stutter.
#[test]
fn who_floods_hurts_only_itself() {
    let server = Running::start(settings());
    let flips = |k: usize| json!({ "type": "away", "away": k.is_multiple_of(2) });
    for flood in [
        (0..60).map(|_| json!({ "type": "ready" })).collect::<Vec<_>>(),
        (0..61).map(flips).collect(),
        (0..1000).map(|_| json!({ "type": "grab" })).collect(),
    ] {
        let tokens = server.open("human");
        let mut players: Vec<Player> = tokens.iter().map(|token| Player::join(&server, token)).collect();
        players[1].until(|it| it["doing"] == "reading");
        players[0].send_all(flood.iter().map(text));
        // Its own page may come again; the other one has never gone.
        players[0] = Player::join(&server, &tokens[0]);
        players[0].until(|it| it["type"] == "welcome");
        for player in &mut players {
            player.send(&json!({ "type": "ready" }));
        }
        for player in &mut players {
            player.until(|it| it["doing"] == "playing");
        }
    }
}

/// What a player says of looking elsewhere comes to the other one at a pace that it can follow, and the last
/// word counts.
#[test]
fn the_last_word_of_being_away_counts() {
    let server = Running::start(settings());
    let tokens = server.open("human");
    let mut players: Vec<Player> = tokens.iter().map(|token| Player::join(&server, token)).collect();
    players[1].until(|it| it["doing"] == "reading");
    players[0].send_all((0..60_u8).map(|k| text(&json!({ "type": "away", "away": !k.is_multiple_of(2) }))));
    let mut told = 0;
    players[1].until(|it| {
        told += usize::from(it["type"] == "state");
        it["present"][0] == false
    });
    assert!(told <= 3, "{told}");
}

/// Pings are messages like others, and answers that nobody takes do not pile up.
#[test]
fn pings_without_end_close_the_connection() {
    let server = Running::start(settings());
    let tokens = server.open("human");
    let mut player = Player::join(&server, &tokens[0]);
    player.until(|it| it["type"] == "state");
    player.send_all((0..20_000).map(|_| Message::Ping(vec![0; 125].into())));
    player.closed();
    let mut player = Player::join(&server, &tokens[0]);
    player.until(|it| it["type"] == "welcome");
}

/// A client may ping before it says who it is, and plays all the same.
#[test]
fn a_ping_may_come_first() {
    let server = Running::start(settings());
    let tokens = server.open("human");
    let mut player = Player::open(&server);
    player.send_all([Message::Ping(vec![1].into())]);
    player.send(&json!({ "type": "join", "token": tokens[0] }));
    player.until(|it| it["type"] == "welcome");
}

/// A client that takes its own place again and again is asked to wait, not told that there is no game.
#[test]
fn a_player_that_comes_too_often_is_told_to_come_again() {
    let server = Running::start(settings());
    let tokens = server.open("human");
    let mut other = Player::join(&server, &tokens[1]);
    let mut again: Vec<Player> = (0..12).map(|_| Player::join(&server, &tokens[0])).collect();
    let codes: Vec<Option<u16>> = again.split_off(10).iter_mut().map(Player::closed).collect();
    assert!(codes.contains(&Some(1013)), "{codes:?}");
    assert_eq!(again[0].closed(), Some(4001));
    other.until(|it| it["doing"] == "reading");
}

/// Sockets that say nothing take no place from a player, from wherever they come.
#[test]
fn silent_sockets_take_nobodys_place() {
    let server = Running::start(settings());
    let crowd = |address: fn(u8) -> [u8; 4]| {
        let open = |k| Player::try_open_from(&server, address(k), None).expect("a socket");
        (0..100).map(open).collect::<Vec<_>>()
    };
    let tokens = server.open("human");
    for silent in [crowd(|_| [127, 0, 1, 1]), crowd(|k| [127, 0, 2, 1 + k])] {
        let mut players: Vec<Player> = tokens.iter().map(|token| Player::join(&server, token)).collect();
        players[1].until(|it| it["doing"] == "reading");
        drop(silent);
    }
}

fn send(server: &Running, bytes: &str) -> TcpStream {
    let mut stream = TcpStream::connect(server.address).expect("it listens");
    stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a limit");
    stream.write_all(bytes.as_bytes()).expect("written");
    stream
}

/// Requests that never end do not keep others from being answered, and are given up after a time.
#[test]
fn unfinished_requests_end() {
    let server = Running::start(settings());
    let head = "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ";
    let crowd: Vec<TcpStream> = (0..300).map(|_| send(&server, head)).collect();
    assert_eq!(server.get("/").status, 200);
    let begun = Instant::now();
    let body = "POST /api/rooms HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9\r\n\r\n{";
    let idle = "GET /api/game HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
    let mut answers = Vec::new();
    for mut stream in [send(&server, head), send(&server, body), send(&server, idle), send(&server, "")] {
        let mut answer = Vec::new();
        // It is closed in time, with or without a word.
        let read = stream.read_to_end(&mut answer);
        assert!(read.is_ok_and(|_| begun.elapsed() < Duration::from_secs(25)));
        answers.push(String::from_utf8_lossy(&answer).into_owned());
    }
    assert!(answers[1].starts_with("HTTP/1.1 408"), "{answers:?}");
    assert!(answers[2].starts_with("HTTP/1.1 200"), "{answers:?}");
    drop(crowd);
}

/// Fragments of a message are no messages, and may be empty; the server reads so many bytes a second.
#[test]
fn fragments_without_end_are_read_slowly() {
    let server = Running::start(settings());
    let upgrade = "GET /play/socket HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
                   Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    let mut stream = send(&server, upgrade);
    let mut answer = [0; 12];
    stream.read_exact(&mut answer).expect("an answer");
    assert_eq!(&answer, b"HTTP/1.1 101");
    // A message of text begins, and goes on with nothing.
    stream.write_all(&[0x01, 0x80, 0, 0, 0, 0]).expect("written");
    let fragments = [0x00, 0x80, 0, 0, 0, 0].repeat(10_000);
    stream.set_nonblocking(true).expect("a socket");
    let (begun, mut taken, mut at) = (Instant::now(), 0, 0);
    while begun.elapsed() < Duration::from_secs(3) {
        match stream.write(&fragments[at..]) {
            Ok(count) => {
                taken += count;
                at = (at + count) % fragments.len();
            }
            Err(error) if error.kind() == std::io::ErrorKind::WouldBlock => {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(error) => panic!("{error}"),
        }
    }
    // Beside what was read, the system keeps some.
    assert!(taken < 32 << 20, "{taken} bytes");
    assert_eq!(server.get("/").status, 200);
}

/// A file that is sent to somebody who does not take it is given up.
#[test]
fn answers_that_nobody_takes_end() {
    let server = Running::start(settings());
    let many = "GET /play/play.js HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".repeat(3000);
    let mut stream = TcpStream::connect(server.address).expect("it listens");
    stream.set_write_timeout(Some(Duration::from_secs(30))).expect("a limit");
    // Nothing is read; what is asked for stays with the server until it gives up.
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(40) && stream.write_all(many.as_bytes()).is_ok() {}
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}

/// Minds are for several addresses.
#[test]
fn one_address_has_at_most_half_of_the_minds() {
    let mut given = settings();
    given.mind_rooms = 12;
    let server = Running::start(given);
    let wish = r#"{"partner":"mind"}"#;
    let statuses: Vec<u16> = (0..7).map(|_| server.ask("POST", "/api/rooms", &[], wish).status).collect();
    assert_eq!(statuses, [201, 201, 201, 201, 201, 201, 503]);
    let bearer = format!("Bearer {}", server.admin);
    let admin = [("Authorization", bearer.as_str())];
    assert_eq!(server.ask("POST", "/api/rooms", &admin, wish).status, 201);
}

/// The journal of a game that has begun, in a folder of a server.
fn journal(folder: &Path, name: &str, room: &str, id: &str, game: GameSettings) -> String {
    let scene = phase_sampler::sample_named(Some("independent"), None, 1).expect("a scene");
    let round = |id: &str| Round { id: id.into(), source: "one".into(), scene: scene.clone(), seed: 1 };
    let opening = Entry::Opened {
        format: phase_game::journal::FORMAT.into(),
        room: room.into(),
        keys: [Some("0".repeat(64)), Some("1".repeat(64))],
        settings: Box::new(game),
        rounds: vec![round(""), round(id)],
    };
    let mut text = serde_json::to_string(&opening).expect("JSON");
    text += "\n{\"entry\":\"began\",\"round\":0}\n";
    fs::create_dir_all(folder.join("rooms")).expect("a folder");
    fs::write(folder.join(format!("rooms/{name}.jsonl")), &text).expect("written");
    text
}

/// A journal cannot say where a recording is written, or make its game wait for longer than there is time.
#[test]
fn journals_of_others_do_no_harm() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut given = settings();
    given.folder = folder.path().join("a/b");
    let good = given.game;
    let files = [
        ("a0", "a0", "../../x-played-a0"),
        ("a1", "a1", "/tmp/x-played-a1"),
        ("a2", "a2", "sub/x-played-a2"),
        ("a3", "a3", "x-played-a9"),
        ("a4", "a9", "x-played-a9"),
        ("a5", "../a5", "x-played-../a5"),
    ];
    for (name, room, id) in files {
        journal(&given.folder, name, room, id, good);
    }
    let mut endless = good;
    endless.lobby_patience = Duration::MAX;
    journal(&given.folder, "b0", "b0", "x-played-b0", endless);
    let own = journal(&given.folder, "c0", "c0", "x-played-c0", good);
    let entries = entries(&own).expect("a journal");
    assert!(Room::resume(entries, Duration::ZERO).expect("good").is_some());
    // Bytes that are no text, before a line that has no end: nothing of it is changed.
    let mut bytes = journal(&given.folder, "d0", "d0", "x-played-d0", good).into_bytes();
    let source = bytes.windows(5).position(|part| part == b"\"one\"").expect("a source");
    bytes[source + 1] = 0xff;
    bytes.extend(b"{\"entry\":");
    let foreign = given.folder.join("rooms/d0.jsonl");
    fs::write(&foreign, &bytes).expect("written");
    let server = Running::start(given.clone());
    let bearer = format!("Bearer {}", server.admin);
    let rooms =
        || server.ask("GET", "/admin/api/status", &[("Authorization", &bearer)], "").json()["rooms"].clone();
    let begun = Instant::now();
    let names = |rooms: &Value| {
        let rooms = rooms.as_array().expect("rooms").iter();
        rooms.map(|room| room["room"].as_str().expect("a name").to_owned()).collect::<Vec<_>>()
    };
    while names(&rooms()) != ["c0"] && begun.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(names(&rooms()), ["c0"]);
    server.stop();
    assert_eq!(fs::read(&foreign).expect("bytes"), bytes);
    assert_eq!(fs::read_dir(given.folder.join("events")).expect("a folder").count(), 0);
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}

/// Games that are over are not played again, and the start waits for none.
#[test]
fn the_past_does_not_delay_the_start() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut given = settings();
    given.folder = folder.path().to_owned();
    // So long that replaying one of them would take minutes.
    let mut game = given.game;
    game.players = [phase_game::Player::Human, phase_game::Player::Mind];
    game.practice_steps = 20_000;
    game.simulation.minds = game.simulation.minds.with_simulations(1000);
    for (k, end) in ["{\"entry\":\"over\",\"ending\":\"left\"}\n", ""].iter().cycle().take(20).enumerate() {
        let name = format!("d{k}");
        let mut text = journal(&given.folder, &name, &name, &format!("x-played-{name}"), game);
        text += &"{\"entry\":\"step\",\"actions\":[\"stop\",\"stop\"]}\n".repeat(1000);
        text += end;
        fs::write(given.folder.join(format!("rooms/{name}.jsonl")), text).expect("written");
    }
    let begun = Instant::now();
    // Nor does an end, for example because of a mistake in a study.
    let scene = phase_sampler::sample_named(Some("independent"), None, 1).expect("a scene");
    let item = phase_game::playlist::Item { source: "one".into(), scene };
    drop(phase_serve::Server::bind(given.clone(), item.clone(), vec![item], None).expect("it starts"));
    let server = Running::start(given);
    assert_eq!(server.get("/").status, 200);
    assert_eq!(server.open("human").len(), 2);
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    let bearer = format!("Bearer {}", server.admin);
    let status = server.ask("GET", "/admin/api/status", &[("Authorization", &bearer)], "").json();
    let rooms = status["rooms"].as_array().expect("rooms").len();
    assert!(rooms <= 11, "{rooms} rooms, ten of them open");
}

/// What people do is readable by the owner of the server alone.
#[cfg(unix)]
#[test]
fn files_are_their_owners_alone() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().expect("a folder");
    let mut given = settings();
    given.folder = folder.path().join("new");
    // Of an earlier server, which was less careful.
    fs::create_dir_all(given.folder.join("events")).expect("a folder");
    fs::set_permissions(&given.folder, fs::Permissions::from_mode(0o700)).expect("set");
    fs::write(given.folder.join("events/old.json"), "{}").expect("written");
    let server = Running::start(given.clone());
    let tokens = server.open("human");
    let mut players: Vec<Player> = tokens.iter().map(|token| Player::join(&server, token)).collect();
    for doing in ["reading", "playing", "reading"] {
        for player in &mut players {
            player.until(|it| it["doing"] == doing);
            player.send(&json!({ "type": "ready" }));
        }
    }
    for player in &mut players {
        player.until(|it| it["doing"] == "over");
    }
    let mut seen = 0;
    let mut folders = vec![given.folder];
    while let Some(folder) = folders.pop() {
        assert_eq!(
            fs::metadata(&folder).expect("it is there").permissions().mode() & 0o777,
            0o700,
            "{folder:?}"
        );
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                seen += 1;
                let mode = fs::metadata(&path).expect("it is there").permissions().mode();
                assert_eq!(mode & 0o777, 0o600, "{path:?}");
            }
        }
    }
    assert!(seen >= 4, "{seen}");
}
