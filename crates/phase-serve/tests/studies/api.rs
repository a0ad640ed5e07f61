//! A rater's way, and what is refused on it.

use crate::support::{Site, answer, ask, begin, bind, step, try_ask, write_study};
use serde_json::{Value, json};
use std::fs;

#[test]
fn a_rater_takes_part() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = write_study(folder.path(), 3, 2);
    let site = Site::start(folder.path(), &[study]);
    let address = site.address;
    let studies = ask(address, "GET", "/api/studies", None, None).json();
    assert_eq!(studies["studies"], json!([{"name": "pilot", "title": "<b>A pilot</b>"}]));
    let page = ask(address, "GET", "/study/pilot/", None, None);
    assert_eq!((page.status, page.headers["content-type"].as_str()), (200, "text/html; charset=utf-8"));
    let policy = &page.headers["content-security-policy"];
    assert!(
        policy.contains("default-src 'none'")
            && policy.contains("media-src 'self'")
            && !policy.contains("unsafe")
    );
    assert!(!String::from_utf8_lossy(&page.body).contains("A pilot"), "texts come as JSON");
    let moved = ask(address, "GET", "/study/pilot?PROLIFIC_PID=x", None, None);
    assert_eq!((moved.status, moved.headers["location"].as_str()), (308, "/study/pilot/?PROLIFIC_PID=x"));
    for file in ["study.js", "study.css", "forms.js", "connection.js"] {
        assert_eq!(ask(address, "GET", &format!("/study/{file}"), None, None).status, 200, "{file}");
    }

    let (token, mut stage) = begin(address, "p1");
    for trial in 1..=3 {
        assert_eq!(
            (&stage["page"], &stage["trial"], &stage["trials"]),
            (&json!("trial"), &json!(trial), &json!(3))
        );
        stage = step(address, &token, "answer", &answer(trial, "neutral"));
    }
    assert_eq!(stage, json!({"page": "done", "code": "C0DE"}));
    let state = ask(address, "GET", "/study/pilot/api/state", Some(&token), None);
    assert_eq!(state.json(), stage);
    assert_eq!(state.headers["cache-control"], "no-store");
    let again = ask(
        address,
        "POST",
        "/study/pilot/api/join",
        None,
        Some(&json!({"parameters": {"PROLIFIC_PID": "p1"}})),
    )
    .json();
    // The id of a panel opens nothing: whoever writes it into an address is somebody new.
    let stranger = again["token"].as_str().expect("a token");
    assert_eq!(again["stage"]["page"], "consent");
    let refused = ask(address, "POST", "/study/pilot/api/withdraw", Some(stranger), Some(&json!({})));
    assert_eq!(refused.status, 409);
    let still = ask(address, "GET", "/study/pilot/api/state", Some(&token), None);
    assert_eq!(still.json(), stage);
    assert_eq!(step(address, &token, "withdraw", &json!({})), json!({"page": "withdrawn"}));
}

#[test]
fn what_is_wrong_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = write_study(folder.path(), 3, 2);
    let site = Site::start(folder.path(), &[study]);
    let (token, _) = begin(site.address, "p1");
    let post = |path: &str, token: Option<&str>, body: &Value| {
        let answered = ask(site.address, "POST", path, token, Some(body));
        assert!(answered.json()["error"].is_string(), "{path} {body}: {answered:?}");
        answered.status
    };
    let known = Some(token.as_str());
    assert_eq!(post("/study/other/api/join", None, &json!({"parameters": {}})), 404);
    for body in [
        json!(null),
        json!({}),
        json!({"parameters": []}),
        json!({"parameters": {"a": 1}}),
        json!({"parameters": {}, "x": 1}),
    ] {
        assert_eq!(post("/study/pilot/api/join", None, &body), 400, "{body}");
    }
    let long = json!({"parameters": {"PROLIFIC_PID": "x".repeat(201)}});
    assert_eq!(post("/study/pilot/api/join", None, &long), 400);
    for token in [None, Some("x"), Some("00000000000000000000000000000000")] {
        assert_eq!(post("/study/pilot/api/answer", token, &answer(1, "neutral")), 401);
    }
    assert_eq!(post("/study/pilot/api/consent", known, &json!({"agrees": "yes"})), 400);
    assert_eq!(post("/study/pilot/api/consent", known, &json!({"agrees": false})), 409);
    assert_eq!(post("/study/pilot/api/answer", known, &answer(2, "neutral")), 409);
    assert_eq!(post("/study/pilot/api/answer", known, &answer(1, "angry")), 400);
    step(site.address, &token, "answer", &answer(1, "neutral"));
    step(site.address, &token, "answer", &answer(1, "neutral"));
    assert_eq!(post("/study/pilot/api/answer", known, &answer(1, "friendly")), 409);
    // Pages of others, bodies of other kinds and sizes.
    let bearer = format!("Bearer {token}");
    let headers = [("authorization", bearer.as_str()), ("origin", "https://evil.example")];
    let answered = try_ask(site.address, "POST", "/study/pilot/api/withdraw", &headers, Some(&json!({})))
        .expect("an answer");
    assert_eq!(answered.status, 403);
    let large = json!({"trial": 1, "answer": {"relation": "x".repeat(100_000)}});
    let refused = try_ask(
        site.address,
        "POST",
        "/study/pilot/api/answer",
        &[("authorization", bearer.as_str())],
        Some(&large),
    );
    assert!(refused.is_none_or(|refused| refused.status == 413));
    assert_eq!(ask(site.address, "GET", "/study/pilot/api/answer", known, None).status, 405);
    assert_eq!(ask(site.address, "GET", "/study/pilot/api/state", known, None).json()["trial"], 2);
}

#[test]
fn studies_that_cannot_begin_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = write_study(folder.path(), 2, 1);
    let refused =
        |studies: &[std::path::PathBuf]| bind(folder.path(), studies).expect_err("refused").to_string();
    assert!(refused(&[study.clone(), study.clone()]).contains("another study of the name \"pilot\""));
    assert!(refused(&[folder.path().join("none.json")]).contains("none.json"));
    fs::remove_file(folder.path().join("videos/1.mp4")).expect("removed");
    assert!(refused(std::slice::from_ref(&study)).contains("1.mp4"));
    fs::write(&study, "{}").expect("written");
    assert!(refused(&[study]).contains("pilot.json: field `format`"));
}
