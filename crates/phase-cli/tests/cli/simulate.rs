//! `simulate`, with agents that search little.

use crate::support::{QUICK, fail, recording, refuse, succeed, tree, write_events};
use phase_dataset::{phase_events, summary::SimulationSummary};
use serde_json::json;
use std::path::Path;

fn simulate<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["simulate", "--events", "events.json", "--out", out], &QUICK[..], more].concat()
}

/// A folder with a file of two events; the second starts with two bodies in one place.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let mut overlapping = recording("overlapping");
    let object = overlapping["trajectory"]["agents"][1].clone();
    overlapping["trajectory"]["objects"][0] = object;
    write_events(&folder.path().join("events.json"), &[recording("apart"), overlapping]);
    folder
}

#[test]
fn every_scene_is_simulated_from_its_first_row() {
    let folder = folder();
    let path = folder.path();
    let told = succeed(path, &simulate("out", &[]));
    assert!(told.contains("independent"), "{told}");
    let names: Vec<String> = tree(&path.join("out")).keys().map(|name| name.display().to_string()).collect();
    assert_eq!(
        names,
        ["apart.json", "apart.mp4", "index.html", "overlapping.json", "overlapping.mp4", "summary.json",]
    );
    let input = phase_events::read(&path.join("events.json")).expect("the input");
    for original in &input {
        let file = path.join("out").join(format!("{}.json", original.id));
        let made = phase_events::read(&file).expect("the result").remove(0);
        assert_eq!((made.id.as_str(), &made.scene), (original.id.as_str(), &original.scene));
        assert_eq!(made.trajectory.agents[0][0], original.trajectory.agents[0][0]);
        assert_eq!(made.trajectory.steps(), 4);
        assert!(made.simulation.is_some());
    }
    let summary = SimulationSummary::read(&path.join("out/summary.json")).expect("a summary");
    summary.verify(&path.join("out")).expect("every checksum fits");
    // Agent 0 stands on its landmark from the start and agent 1 never gets to its own.
    let recorded = summary.events[0].agents.map(|agent| agent.recorded.reached);
    assert_eq!(recorded, [true, false]);
    assert_eq!(summary.events[0].agents[0].recorded.steps, Some(0));
}

#[test]
fn one_event_comes_out_as_it_does_among_the_others() {
    let folder = folder();
    let path = folder.path();
    succeed(path, &simulate("all", &["--no-video", "--jobs", "2"]));
    succeed(path, &simulate("one", &["--no-video", "--id", "overlapping"]));
    let (all, one) = (tree(&path.join("all")), tree(&path.join("one")));
    let names: Vec<&Path> = one.keys().map(|name| name.as_path()).collect();
    assert_eq!(names, [Path::new("overlapping.json"), Path::new("summary.json")]);
    assert!(all[Path::new("overlapping.json")] == one[Path::new("overlapping.json")]);
    succeed(path, &simulate("forward", &["--no-video", "--engine", "forward"]));
    assert!(tree(&path.join("forward"))[Path::new("apart.json")] != all[Path::new("apart.json")]);
    succeed(path, &simulate("seed", &["--no-video", "--seed", "2"]));
    assert!(tree(&path.join("seed"))[Path::new("apart.json")] != all[Path::new("apart.json")]);
}

#[test]
fn a_finished_folder_is_left_alone() {
    let folder = folder();
    let path = folder.path();
    let first = succeed(path, &simulate("out", &["--no-video"]));
    let before = tree(&path.join("out"));
    let second = succeed(path, &simulate("out", &["--no-video"]));
    assert!(second.contains("already"));
    assert_eq!(first.lines().next(), second.lines().next(), "the table is shown again");
    let sentence = fail(path, &simulate("out", &[]));
    assert!(sentence.contains("videos false instead of true"), "{sentence}");
    let sentence = fail(path, &simulate("out", &["--no-video", "--engine", "forward"]));
    assert!(sentence.contains(r#"settings.engine "world" instead of "forward""#), "{sentence}");
    let mut changed = recording("apart");
    changed["trajectory"]["agents"][0][0][0] = json!(9.0);
    write_events(&path.join("events.json"), &[changed]);
    fail(path, &simulate("out", &["--no-video"]));
    assert!(tree(&path.join("out")) == before);
}

#[test]
fn a_start_alone_is_enough() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut start = recording("start");
    for pointer in ["/trajectory/agents/0", "/trajectory/agents/1", "/trajectory/objects/0"] {
        let rows = start.pointer_mut(pointer).expect(pointer).as_array_mut().expect("rows");
        rows.truncate(1);
    }
    write_events(&folder.path().join("events.json"), &[start]);
    let told = succeed(folder.path(), &simulate("out", &["--no-video"]));
    // There is nothing to compare with, so only outcomes are reported.
    assert!(told.contains("| start | independent | 4 | goal "), "{told}");
    assert!(!told.contains("recorded") && !told.contains(" - "), "{told}");
}

#[test]
fn several_seeds_are_pooled_and_resumed() {
    let folder = folder();
    let path = folder.path();
    let two = ["--no-video", "--seed", "7", "--seeds", "2"];
    let told = succeed(path, &simulate("out", &two));
    let names: Vec<String> = tree(&path.join("out")).keys().map(|name| name.display().to_string()).collect();
    let scenes = ["apart-seed7", "apart-seed8", "overlapping-seed7", "overlapping-seed8"];
    assert_eq!(names[..4], scenes.map(|id| format!("{id}.json")));
    let summary = SimulationSummary::read(&path.join("out/summary.json")).expect("a summary");
    let made: Vec<(&str, &str, u64)> = summary
        .events
        .iter()
        .map(|event| (event.id.as_str(), event.source.id.as_str(), event.source.seed))
        .collect();
    let sources = [("apart", 7), ("apart", 8), ("overlapping", 7), ("overlapping", 8)];
    assert_eq!(made, [0, 1, 2, 3].map(|k| (scenes[k], sources[k].0, sources[k].1)));
    let all = summary.kinds.last().expect("a row for all");
    assert_eq!((all.events, all.agents, all.own_agents), (4, 8, 8), "{told}");
    // In the recordings nothing moves; the four steps of both are compared.
    assert_eq!(summary.events[0].compared_steps, 4);
    assert_eq!(all.recorded_motion.path.map(|path| path.p75), Some(0.0));
    assert!(all.simulated_motion.path.is_some_and(|path| path.p75 > 0.0), "{told}");

    // A seed gives the same event alone; only its id differs.
    succeed(path, &simulate("alone", &["--no-video", "--seed", "8"]));
    let rows = |file: &str| phase_events::read(&path.join(file)).expect("an event").remove(0).trajectory;
    assert_eq!(rows("alone/apart.json"), rows("out/apart-seed8.json"));

    let finished = tree(&path.join("out"));
    assert!(succeed(path, &simulate("out", &two)).contains("holds these 4 simulated events already"));
    let sentence = fail(path, &simulate("out", &["--no-video", "--seed", "7", "--seeds", "3"]));
    assert!(sentence.contains("seeds 2 instead of 3"), "{sentence}");
    assert!(tree(&path.join("out")) == finished);
}

#[test]
fn seeds_and_ids_must_leave_room() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let long = "x".repeat(95);
    write_events(&path.join("events.json"), &[recording(&long)]);
    let sentence = refuse(path, &simulate("out", &["--seeds", "2"]));
    assert!(sentence.contains("field `id` must leave room for the seed"), "{sentence}");
    let greatest = u64::MAX.to_string();
    let sentence = refuse(path, &simulate("out", &["--seed", &greatest, "--seeds", "2"]));
    assert!(sentence.contains("leaves no room for --seeds 2"), "{sentence}");
    refuse(path, &simulate("out", &["--seeds", "0"]));
    assert!(!path.join("out").exists());
}

#[test]
fn events_with_the_same_seed_have_the_same_chance() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let seeded = |id: &str| {
        let mut event = recording(id);
        event["seed"] = json!(7);
        event
    };
    write_events(&path.join("events.json"), &[seeded("first"), seeded("second"), recording("third")]);
    succeed(path, &simulate("once", &["--no-video"]));
    succeed(path, &simulate("twice", &["--no-video", "--seeds", "2"]));
    let event = |file: &str| {
        let made = phase_events::read(&path.join(file)).expect("an event").remove(0);
        made.simulation.expect("a simulation").event
    };
    let first = event("once/first.json");
    assert_eq!(first.seed, 7);
    assert_eq!(event("once/second.json"), first);
    assert_ne!(event("once/third.json").seed, 7, "from --seed and its place");
    assert_eq!(event("twice/first-seed1.json"), first);
    assert_eq!(event("twice/second-seed2.json").seed, 8);
}

#[test]
fn oddities_of_the_input_are_told() {
    let folder = folder();
    let output = crate::support::run(folder.path(), &simulate("out", &["--no-video"]));
    let told = crate::support::text(&output.stderr);
    let warning = "warning: events.json: event overlapping: trajectory.agents[1][0] and trajectory.objects[0][0]: the \
                   bodies overlap by";
    assert!(output.status.success() && told.contains(warning), "{told}");
    assert!(!told.contains("event apart: "), "{told}");
}

#[test]
fn published_minds_are_named_and_act_otherwise() {
    let folder = folder();
    let path = folder.path();
    let made = |out: &str, more: &[&str]| {
        succeed(path, &simulate(out, &[&["--no-video", "--id", "apart"], more].concat()));
        phase_events::read(&path.join(out).join("apart.json")).expect("the result").remove(0)
    };
    let ours = made("ours", &[]).simulation.expect("a simulation");
    let theirs = made("theirs", &["--minds", "published"]).simulation.expect("a simulation");
    let one_way = made("one-way", &["--minds", "published", "--one-way-turns"]).simulation.expect("one");
    assert_eq!(ours.settings["minds"]["kind"], "phase");
    assert_eq!(theirs.settings["minds"]["kind"], "published");
    assert_eq!(theirs.settings["one_way_turns"], false);
    assert_eq!(one_way.settings["one_way_turns"], true);
    // Walking needs five actions in published minds, and twelve in ours.
    let searched =
        |simulation: &phase_event::SimulationRecord| simulation.event.steps[0].thoughts[1].actions.len();
    assert_eq!((searched(&ours), searched(&theirs)), (12, 5));
    let refused = refuse(path, &simulate("no", &["--minds", "mine"]));
    assert!(refused.contains("published"), "{refused}");
    for foresight in ["coarse", "exact"] {
        let refused = refuse(path, &simulate("no", &["--minds", "published", "--foresight", foresight]));
        let expected = format!("--foresight {foresight}: published minds search in dynamics of their own");
        assert!(refused.contains(&expected), "{refused}");
    }
    let points = made("points", &["--minds", "published", "--foresight", "points"]).simulation.expect("one");
    assert_eq!(points.settings["minds"]["collisions"], false);
}
