//! The server over real sockets: what it answers, what it refuses, and that it goes on where it was stopped.

mod misbehaving;
mod support;

use phase_game::{GameSettings, View, playlist::Item};
use phase_serve::Server;
use serde_json::{Value, json};
use std::time::Duration;
use support::{Player, Running, settings};

#[test]
fn pages_are_protected() {
    let server = Running::start(settings());
    for (path, kind) in [
        ("/", "text/html"),
        ("/play/", "text/html"),
        ("/play/play.js", "text/javascript"),
        ("/playground/", "text/html"),
    ] {
        let answer = server.get(path);
        assert_eq!(answer.status, 200, "{path}");
        assert!(answer.header("content-type").is_some_and(|it| it.starts_with(kind)), "{path}");
        let policy = answer.header("content-security-policy").expect("a policy");
        assert!(policy.starts_with("default-src 'none'") && !policy.contains("unsafe-inline"), "{policy}");
        assert_eq!(answer.header("x-content-type-options").as_deref(), Some("nosniff"));
        assert_eq!(answer.header("x-frame-options").as_deref(), Some("DENY"));
        // What has not changed is not sent again.
        let tag = answer.header("etag").expect("a tag");
        assert_eq!(server.ask("GET", path, &[("If-None-Match", &tag)], "").status, 304);
    }
    for path in
        ["/nothing", "/../Cargo.toml", "/play/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/rooms", "/events"]
    {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
    assert_eq!(server.get("/play").status, 308);
    assert_eq!(server.ask("POST", "/", &[], "").status, 405);
    // A name that is not the server's (DNS rebinding), and one that is.
    assert_eq!(server.ask("GET", "/", &[("Host", "evil.example")], "").status, 421);
    assert_eq!(server.ask("GET", "/", &[("Host", "localhost:1")], "").status, 200);
}

#[test]
fn rubbish_is_refused_in_a_sentence() {
    let server = Running::start(settings());
    for body in [
        "",
        "{}",
        "[]",
        "null",
        r#"{"partner":"robot"}"#,
        r#"{"partner":"human","agent":2}"#,
        r#"{"partner":"human","x":1}"#,
        r#"{"partner":"human","partner":"mind"}"#,
    ] {
        let answer = server.ask("POST", "/api/rooms", &[], body);
        assert_eq!(answer.status, 400, "{body}");
        assert!(answer.json()["error"].as_str().is_some_and(|it| !it.contains('\n')), "{body}");
    }
    assert_eq!(server.ask("POST", "/api/rooms", &[], &" ".repeat(100_000)).status, 413);
    let elsewhere = [("Origin", "http://evil.example")];
    assert_eq!(server.ask("POST", "/api/rooms", &elsewhere, r#"{"partner":"human"}"#).status, 403);
    for (method, path) in
        [("GET", "/admin/api/status"), ("GET", "/admin/api/events.json"), ("DELETE", "/admin/api/rooms/a")]
    {
        assert_eq!(server.ask(method, path, &[], "").status, 401, "{path}");
        assert_eq!(server.ask(method, path, &[("Authorization", "Bearer guess")], "").status, 401, "{path}");
    }
    let bearer = format!("Bearer {}", server.admin);
    let admin = [("Authorization", bearer.as_str())];
    assert_eq!(server.ask("DELETE", "/admin/api/rooms/..%2f..", &admin, "").status, 404);
    assert_eq!(server.ask("GET", "/admin/api/events.json", &admin, "").status, 404);
    let status = server.ask("GET", "/admin/api/status", &admin, "").json();
    assert_eq!(status["rooms"], json!([]));
    assert_eq!(status["agents"], json!(["red", "green"]));
}

#[test]
fn rooms_are_limited() {
    let mut few = settings();
    few.rooms = 3;
    let server = Running::start(few);
    for _ in 0..3 {
        assert_eq!(server.open("human").len(), 2);
    }
    let answer = server.ask("POST", "/api/rooms", &[], r#"{"partner":"human"}"#);
    assert_eq!(answer.status, 503);
    assert!(answer.json()["error"].as_str().is_some_and(|it| it.contains("taken")));

    // A mind plays in two of them at most.
    let server = Running::start(settings());
    let wish = r#"{"partner":"mind"}"#;
    let statuses: Vec<u16> = (0..3).map(|_| server.ask("POST", "/api/rooms", &[], wish).status).collect();
    assert_eq!(statuses, [201, 201, 503]);
    assert_eq!(server.open("human").len(), 2);

    let mut closed = settings();
    closed.open = false;
    let server = Running::start(closed);
    assert_eq!(server.ask("POST", "/api/rooms", &[], r#"{"partner":"human"}"#).status, 401);

    let server = Running::start(settings());
    let status = |_| server.ask("POST", "/api/rooms", &[], r#"{"partner":"human"}"#).status;
    let answers: Vec<u16> = (0..40).map(status).collect();
    assert!(answers[..30].iter().all(|&it| it == 201) && answers.contains(&429), "{answers:?}");
}

#[test]
fn sockets_are_guarded() {
    let server = Running::start(settings());
    // Who does not say who it is, or says it wrongly.
    for first in ["", "{}", r#"{"type":"join","token":"0"}"#, r#"{"type":"ready"}"#] {
        let mut player = Player::open(&server);
        player.send_text(first);
        assert_eq!(player.closed(), Some(1008), "{first}");
    }
    assert!(Player::try_open(&server, Some("http://evil.example")).is_err());
    let tokens = server.open("human");
    // Messages that are too long end the connection; what cannot be understood is answered.
    let mut player = Player::join(&server, &tokens[0]);
    player.send(&json!({ "type": "dance" }));
    assert!(
        player.until(|it| it["type"] == "problem")["text"]
            .as_str()
            .is_some_and(|it| it.contains("phase-game/1"))
    );
    player.send(&json!({ "type": "hold", "action": "x".repeat(2000) }));
    player.closed();
    // So does a flood.
    let mut player = Player::join(&server, &tokens[0]);
    for _ in 0..1000 {
        player.send(&json!({ "type": "grab" }));
    }
    player.closed();
    // The room is unharmed.
    let mut player = Player::join(&server, &tokens[0]);
    assert_eq!(player.until(|it| it["type"] == "state")["doing"], "gathering");
}

/// Two players play, the server is stopped in the middle of a round, and goes on with the next step.
#[test]
fn a_game_outlives_its_server() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut first = settings();
    first.folder = folder.path().to_owned();
    first.game.simulation.max_steps = 10;
    let server = Running::start(first.clone());
    let tokens = server.open("human");
    let mut players: Vec<Player> = tokens.iter().map(|token| Player::join(&server, token)).collect();
    for player in &mut players {
        assert_eq!(player.until(|it| it["type"] == "stage")["round"], 0);
        player.until(|it| it["doing"] == "reading");
        player.send(&json!({ "type": "ready" }));
    }
    for player in &mut players {
        player.until(|it| it["doing"] == "playing");
        player.send(&json!({ "type": "ready" }));
    }
    for player in &mut players {
        let stage = player.until(|it| it["type"] == "stage");
        assert!(stage["instructions"]["yours"].is_string());
        player.until(|it| it["doing"] == "reading");
        player.send(&json!({ "type": "ready" }));
    }
    players[0].send(&json!({ "type": "hold", "action": "up" }));
    let seen =
        players[1].until(|it| it["step"].as_u64().is_some_and(|step| step >= 3) && it["type"] == "sight");
    drop(players);
    server.stop();

    let server = Running::start(first);
    let mut players: Vec<Player> = tokens.iter().map(|token| Player::join(&server, token)).collect();
    let again = players[1].until(|it| it["type"] == "sight");
    assert!(again["step"].as_u64() >= seen["step"].as_u64());
    for player in &mut players {
        player.until(|it| it["type"] == "result");
        player.until(|it| it["doing"] == "over");
    }
    let bearer = format!("Bearer {}", server.admin);
    let events = server.ask("GET", "/admin/api/events.json", &[("Authorization", &bearer)], "");
    let recordings = phase_event::parse(events.body.as_bytes()).expect("phase-events/1");
    assert_eq!(recordings.len(), 1);
    let played = &recordings[0].simulation.as_ref().expect("simulated").event;
    assert_eq!(played.steps.len(), 10);
    // The room has been forgotten; whoever comes now is told so.
    std::thread::sleep(Duration::from_secs(3));
    let mut late = Player::open(&server);
    late.send(&json!({ "type": "join", "token": tokens[0] }));
    assert_eq!(late.closed(), Some(1008));
}

/// Two servers would both go on with the games of one folder.
#[test]
fn a_folder_has_one_server() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut given = settings();
    given.folder = folder.path().to_owned();
    let server = Running::start(given.clone());
    let scene = phase_sampler::sample_named(Some("independent"), None, 1).expect("a scene");
    let item = Item { source: "one".into(), scene };
    let bind = || Server::bind(given.clone(), item.clone(), vec![item.clone()], None);
    let error = bind().expect_err("the folder is taken");
    assert!(error.to_string().contains("is in use by another run"), "{error}");
    server.stop();
    bind().expect("the folder is free again");
}

/// A damaged journal is left alone and does not keep the server from starting.
#[test]
fn damaged_journals_do_no_harm() {
    let folder = tempfile::tempdir().expect("a folder");
    let rooms = folder.path().join("rooms");
    std::fs::create_dir_all(&rooms).expect("a folder");
    for (name, text) in [
        ("a", "rubbish\n"),
        ("b", ""),
        ("c", "{\"entry\":\"over\",\"ending\":\"left\"}\n"),
        ("d", "\u{0}\u{0}"),
    ] {
        std::fs::write(rooms.join(format!("{name}.jsonl")), text).expect("written");
    }
    let mut given = settings();
    given.folder = folder.path().to_owned();
    let server = Running::start(given);
    assert_eq!(server.get("/").status, 200);
    assert_eq!(std::fs::read_to_string(rooms.join("a.jsonl")).expect("kept"), "rubbish\n");
}

/// One player against a mind, which sees everything.
#[test]
fn a_mind_plays_the_agent_that_no_person_plays() {
    let mut given = settings();
    given.game = GameSettings { view: View::Own, ..given.game };
    let server = Running::start(given);
    let body = r#"{"partner":"mind","view":"all","agent":1}"#;
    let room = server.ask("POST", "/api/rooms", &[], body).json();
    assert_eq!((&room["agent"], &room["tokens"][0]), (&json!(1), &Value::Null));
    let mut player = Player::join(&server, room["tokens"][1].as_str().expect("a token"));
    assert_eq!(player.until(|it| it["type"] == "welcome")["mind"], true);
    player.until(|it| it["doing"] == "reading");
    player.send(&json!({ "type": "ready" }));
    let sight = player.until(|it| it["type"] == "sight" && it["step"] == 2);
    assert!(sight.get("visible").is_none());
    assert!(sight["bodies"].as_array().is_some_and(|it| it.iter().all(|body| !body.is_null())));
    player.send(&json!({ "type": "leave" }));
    assert_eq!(player.until(|it| it["doing"] == "over")["ending"], "left");
}
