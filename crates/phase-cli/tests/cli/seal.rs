//! Sealed datasets, from the secret seed to the proof.

use crate::support::{fail, refuse, succeed, whole_or_absent};
use serde_json::{Value, json};
use std::{fs, path::Path};

const SEED: &str = "11259375999999999999";

fn generate(path: &Path, out: &str, seed: &str) {
    let effort = ["--max-steps", "8", "--simulations", "10", "--particles", "4", "--size", "64"];
    succeed(path, &[&["gen-dataset", "--events", "6", "--seed", seed, "--out", out], &effort[..]].concat());
}

#[test]
fn what_was_published_is_proved_later() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "secret", SEED);
    succeed(path, &["seal", "secret", "--out", "public"]);
    let text = fs::read_to_string(path.join("public/events.json")).expect("events");
    let events = phase_event::parse_observed(text.as_bytes()).expect("events without labels");
    assert_eq!(events.len(), 6);
    let published: Value = serde_json::from_str(&text).expect("JSON");
    let members: Vec<&String> = published["events"][0].as_object().expect("an event").keys().collect();
    assert_eq!(members, ["agents", "id", "layout", "objects", "trajectory"]);
    assert_eq!(published["events"][0]["agents"][0].as_object().map(|it| it.len()), Some(1), "sizes alone");
    for secret in ["demo-", SEED, "alpha", "goal", "helping"] {
        assert!(!text.contains(secret), "{secret}");
    }
    // The order is another, so that a place tells no kind.
    let proof = succeed(path, &["unseal", "public", "--dataset", "secret", "--json"]);
    let names: Value = serde_json::from_str(&proof).expect("JSON");
    let ids: Vec<&str> =
        names["events"].as_object().expect("names").values().filter_map(Value::as_str).collect();
    assert_eq!(ids.len(), 6);
    assert!(!ids.is_sorted(), "{ids:?}");
    // The motion under a name is that of its event.
    let (name, id) = names["events"].as_object().expect("names").iter().next().expect("an event");
    let id = id.as_str().expect("a name");
    let seal: Value =
        serde_json::from_str(&fs::read_to_string(path.join("public/seal.json")).expect("a seal"))
            .expect("JSON");
    let manifest = seal["manifest_sha256"].as_str().expect("a digest");
    assert_eq!(*name, format!("sealed-{}-0001", &manifest[..8]), "answers to another seal have other names");
    let event = fs::read_to_string(path.join(format!("secret/events/{id}.json"))).expect("an event");
    let event: Value = serde_json::from_str(&event).expect("JSON");
    assert_eq!(event["events"][0]["trajectory"], published["events"][0]["trajectory"]);
    assert_eq!(
        fs::read(path.join(format!("public/videos/{name}.mp4"))).expect("a video"),
        fs::read(path.join(format!("secret/videos/{id}.mp4"))).expect("a video")
    );
}

#[test]
fn another_dataset_or_a_changed_file_is_no_proof() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "secret", SEED);
    succeed(path, &["seal", "secret", "--out", "public"]);
    whole_or_absent(path, &["seal", "secret"]);
    generate(path, "other", "11259375999999999998");
    let told = fail(path, &["unseal", "public", "--dataset", "other"]);
    assert!(told.contains("the manifest of other is not what was sealed"), "{told}");
    refuse(path, &["seal", "secret", "--out", "public"]);
    for extra in ["extra.json", "videos/extra.mp4"] {
        fs::write(path.join("public").join(extra), "x").expect("written");
        let told = fail(path, &["unseal", "public", "--dataset", "secret"]);
        assert!(told.contains(&format!("{extra}: is none of the `files` of seal.json")), "{told}");
        fs::remove_file(path.join("public").join(extra)).expect("removed");
    }
    // Files that systems leave are none of it.
    fs::write(path.join("public/videos/.DS_Store"), "x").expect("written");
    succeed(path, &["unseal", "public", "--dataset", "secret"]);
    let file = path.join("public/seal.json");
    let text = fs::read_to_string(&file).expect("a seal");
    fs::write(&file, text.replacen("\"events\": 6", "\"events\": 5", 1)).expect("written");
    let told = fail(path, &["unseal", "public", "--dataset", "secret"]);
    assert!(told.contains("seal.json: field `events` must be 6, as in secret, not 5"), "{told}");
    fs::write(&file, text).expect("written");
    let file = path.join("public/events.json");
    let text = fs::read_to_string(&file).expect("events").replacen("0.", "1.", 1);
    fs::write(&file, text).expect("written");
    let told = fail(path, &["unseal", "public", "--dataset", "secret"]);
    assert!(told.contains("events.json"), "{told}");
    generate(path, "guessable", "7");
    let told = fail(path, &["seal", "guessable", "--out", "no"]);
    assert!(told.contains("seed 7 can be found by trying"), "{told}");
    assert!(!path.join("no").exists());
}

/// Answers by a method that was given the published motion alone.
fn answer(path: &Path, public: &str) -> String {
    let out = format!("{public}-answers");
    let events = format!("{public}/events.json");
    succeed(path, &["eval", "goals", "--method", "cue", "--events", &events, "--out", &out]);
    let file = format!("{out}/answers.json");
    assert!(path.join(&file).is_file(), "{file}");
    file
}

/// Arguments of a submission of answers to a sealed dataset by its keeper.
fn submission<'a>(answers: &'a str, dataset: &'a str, public: &'a str) -> Vec<&'a str> {
    let who = ["--method", "mine", "--by", "N. N.", "--source", "https://example.org", "--out", "checkout"];
    [&["submit", answers, "--events", dataset, "--sealed", public], &who[..]].concat()
}

#[test]
fn answers_to_sealed_motion_get_a_row_of_their_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "secret", SEED);
    succeed(path, &["seal", "secret", "--out", "public"]);
    let answers = answer(path, "public");
    let told = succeed(path, &submission(&answers, "secret", "public"));
    let read = |file: &str| fs::read_to_string(path.join(file)).unwrap_or_else(|_| panic!("{file}: {told}"));
    let scores: Value = serde_json::from_str(&read("checkout/data/leaderboard/scores.json")).expect("JSON");
    let all = scores["scores"].as_array().expect("scores");
    let score = all.iter().find(|score| score["method"] == "mine").expect("the score");
    let seal = phase_files::checksum::sha256_hex(read("public/seal.json").as_bytes());
    assert_eq!(score["sealed"], json!({ "seal": seal, "events": 6 }));
    // Answers about motion without all that can be judged say so, and are answers.
    let mut said: Value = serde_json::from_str(&read(&answers)).expect("JSON");
    said["events"][0]["not_judged"] = json!(["no walls were seen"]);
    fs::write(path.join("said.json"), said.to_string()).expect("written");
    let again = submission("said.json", "secret", "public");
    succeed(path, &[&again[..again.len() - 1], &["other"]].concat());
    let set = format!("sealed-{}", &seal[..12]);
    assert_eq!(score["set"], set);
    assert_eq!(read(&format!("checkout/data/leaderboard/{set}/goals/mine.json")), read(&answers));
    let page = read("checkout/docs/results/leaderboard.md");
    let (open, sealed) = page.split_once("## Sealed events").expect("a section");
    assert!(sealed.contains(&format!("| {seal} | 6 | mine |")), "{page}");
    // It is no row of the tables of events that everybody has.
    assert!(!open.contains("mine"), "{page}");
    // The score is that of the same method on the events with labels.
    succeed(path, &["eval", "goals", "--method", "cue", "--events", "secret", "--out", "labelled"]);
    let labelled: Value = serde_json::from_str(&read("labelled/results.json")).expect("JSON");
    assert_eq!(score["top1"]["value"], labelled["goal"]["top1"]);
    assert_eq!(score["relation"]["value"], labelled["relation"]["accuracy"]);
}

#[test]
fn a_score_needs_the_dataset_that_was_sealed_and_answers_to_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    generate(path, "secret", SEED);
    generate(path, "other", "11259375999999999998");
    for (dataset, public) in [("secret", "public"), ("other", "public-other")] {
        succeed(path, &["seal", dataset, "--out", public]);
    }
    let [answers, of_other] = ["public", "public-other"].map(|public| answer(path, public));
    let told = fail(path, &submission(&of_other, "secret", "public"));
    assert!(told.contains("is none of those in public"), "{told}");
    let told = fail(path, &submission(&answers, "other", "public"));
    assert!(told.contains("the manifest of other is not what was sealed"), "{told}");
    // The manifest of the kept dataset was changed afterwards.
    let manifest = path.join("secret/manifest.json");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    fs::write(&manifest, text.replacen("\"demo\"", "\"deme\"", 1)).expect("written");
    let told = fail(path, &submission(&answers, "secret", "public"));
    assert!(told.contains("the manifest of secret is not what was sealed"), "{told}");
    fs::write(&manifest, &text).expect("written");
    let answered = fs::read_to_string(path.join(&answers)).expect("answers");
    let mut fewer: Value = serde_json::from_str(&answered).expect("JSON");
    fewer["events"].as_array_mut().expect("events").pop();
    fs::write(path.join("fewer.json"), fewer.to_string()).expect("written");
    let told = fail(path, &submission("fewer.json", "secret", "public"));
    assert!(told.contains("fewer.json") && told.contains("sealed-") && !told.contains("demo-"), "{told}");
    // The motion to be forecast is published.
    let forecasts = answered.replace("\"goals\"", "\"forecast\"");
    fs::write(path.join("forecasts.json"), forecasts).expect("written");
    let told = fail(path, &submission("forecasts.json", "secret", "public"));
    assert!(told.contains("has forecasts alone"), "{told}");
    assert!(!path.join("checkout").exists(), "nothing is written unless all is valid");
}

#[test]
fn answers_to_sealed_questions_are_scored_with_the_kept_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let effort = ["--max-steps", "44", "--simulations", "40", "--particles", "5", "--no-video"];
    let dataset = ["gen-dataset", "--events", "12", "--seed", SEED, "--out", "secret"];
    succeed(path, &[&dataset[..], &effort].concat());
    succeed(path, &["questions", "secret", "--no-video", "--out", "kept"]);
    succeed(path, &["seal", "secret", "--questions", "kept", "--out", "public"]);
    let read = |file: &str| fs::read_to_string(path.join(file)).unwrap_or_else(|_| panic!("{file}"));
    let mut answers = String::new();
    for line in read("public/questions.jsonl").lines() {
        let question: Value = serde_json::from_str(line).expect("JSON");
        let members: Vec<&String> = question.as_object().expect("a question").keys().collect();
        assert_eq!(members, ["id", "options", "question", "task", "video"]);
        answers += &(json!({ "id": question["id"], "answer": "A" }).to_string() + "\n");
    }
    assert!(answers.lines().count() >= 5, "{answers}");
    fs::write(path.join("answers.jsonl"), &answers).expect("written");
    let told = succeed(path, &["score", "answers.jsonl", "--questions", "kept"]);
    assert!(told.contains(&format!("{} answers", answers.lines().count())), "{told}");
    let unseal = ["unseal", "public", "--dataset", "secret", "--questions", "kept"];
    succeed(path, &unseal);
    // Events are scored where questions were sealed, too.
    let events = answer(path, "public");
    let told = fail(path, &submission(&events, "secret", "public"));
    assert!(told.contains("questions were sealed, too: give their folder"), "{told}");
    let submission = [&submission(&events, "secret", "public")[..], &["--questions", "kept"]].concat();
    succeed(path, &submission);
    // An answer is changed after the seal.
    let text = read("kept/questions.jsonl");
    let mut lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    lines[0]["answer"] = json!(1 - lines[0]["answer"].as_u64().expect("a number").min(1));
    let changed: String = lines.iter().map(|line| line.to_string() + "\n").collect();
    fs::write(path.join("kept/questions.jsonl"), changed).expect("written");
    for arguments in [&unseal[..], &submission] {
        let told = fail(path, arguments);
        assert!(told.contains("the file of questions of kept is not what was sealed"), "{told}");
    }
}
