//! The importer of the published test recordings and of the raters' sheets.

use phase_dataset::phase_events::read;
use phase_model::EventKind;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

const IMPORTER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/import_socialgnn.py");
/// Real recordings, absent from the repository.
const REAL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/real-phase");

/// Makes `recordings.pkl` in its working folder: an unmirrored entry, one mirrored up and down, one mirrored
/// at a diagonal, and an empty one, all with the defects of the published ones.
const MADE_UP: &str = r#"
import pickle, numpy
NAME = "D010121_1021040_0_F8_E{}_G{}_ST0_3_SZ0_1_2_3_P1_5_2_4_A0_0_C0_0_AN0.5_0.12_MCTS_L{}_R{}_PL1_EL1_0_0_s1000.mp4"
LANDMARKS = [(8.5, 19.5), (23.5, 19.5), (23.5, 4.5), (8.5, 4.5)]
def entry(layout, goals, steps, alphas, code, sizes, walls, tracks):
    return {"name": NAME.format(layout, goals, steps, alphas), "trajectories": [numpy.array(track) for track in tracks],
            "entity_sizes": sizes, "entity_color_code": code, "wall_segs": walls, "social_goals": "neutral",
            "physical_goals": [["LMA", 0, 0, 1]] * 2, "landmark_centers": LANDMARKS}
at_rest = [[8.0, 20.0, 0.0, 0.0, 0.5]]
upright = entry(
    "4", "['LMO', 0, 2, 1]_['LMO', 0, 2, 1]", 100, "0.0_10.0", {0: 1, 1: 3, 2: 0}, [1.2000000000000002, 0.8, 1.01, 1.6],
    [[(16, 12), (16, 22)], [(16, 12), (8.5, 12)]],
    [[[8.0, 20.0, 1.0, -0.5, 0.123456789], [8.1, 19.9, 1.0, -0.5, 7.0]], at_rest * 2, at_rest * 5, at_rest * 5])
hindered = entry(
    "0.0", "['LMA', 1, 3, -1]_['LMA', 1, 3, 1]", 80, "-10.0_0.0", {0: 0, 1: 1, 3: 2, 4: 3}, [0.8, 1.2, 1.6, 1.01], [],
    [[[8.0, 4.0, 1.0, 24.5, 0.25]], [[9.0, 4.0, 0.0, 24.0, 7.5]], [[10.0, 4.0, 2.0, 3.0, 0.3]] * 2, at_rest * 2])
diagonal = entry(
    "0.3", "['TE', 0, 1, 1]_['TE', 1, 0, -1]", 60, "0.0_-10.0", {0: 0, 1: 1, 3: 2, 4: 3}, [0.8, 1.2, 1.6, 1.01], [],
    # The mean of the second row of agent 0 spans the jump of two substeps; agent 1 is pushed by 0.3 rad.
    [[[8.0, 4.0, 29.0, 27.5, -6.0], [8.0, 4.0, 28.0, 28.0, -3.7699111843], [8.0, 4.0, 28.0, 28.0, -0.3]],
     [[20.0, 8.0, 28.0, 28.0, -1.0], [20.0, 8.0, 28.0, 28.0, -0.7], [20.0, 8.0, 28.0, 28.0, -0.7]],
     [[10.0, 4.0, 2.0, 3.0, 0.3]] * 4, at_rest * 4])
with open("recordings.pkl", "wb") as stream:
    pickle.dump([upright, None, hindered, diagonal], stream, protocol=3)
"#;

/// Makes pickles that must be refused, each in a file `bad-*`.
const BAD: &str = r#"
import pickle
whole = open("recordings.pkl", "rb").read()
huge = 3 << 30
bad = {
    "system": b"cos\nsystem\n(S'touch harm'\ntR.",
    "posix": b"cposix\nsystem\n(S'touch harm'\ntR.",
    "builtins": b"cnumpy.dtypes\n__builtins__\n.",
    "dotted": b"\x80\x04\x8c\x05numpy\x8c\x17ndarray.__class__.mro__\x93.",
    "loader": b"cnumpy\nload\n(S'recordings.pkl'\ntR.",
    "bytearray": b"\x80\x05\x96" + huge.to_bytes(8, "little") + b".",
    "bytearray-called": b"cbuiltins\nbytearray\n(I%d\ntR." % huge,
    "array": b"cnumpy.core.multiarray\n_reconstruct\n(cnumpy\nndarray\n(I%d\ntS'b'\ntR." % huge,
    "empty": b"",
    "rubbish": b"no pickle at all",
    "cut": whole[:len(whole) // 2],
    "number": pickle.dumps(1),
    "other-list": pickle.dumps([{"name": 1}]),
    "nothing": pickle.dumps([None, None]),
}
for name, content in bad.items():
    with open("bad-" + name, "wb") as stream:
        stream.write(content)
"#;

/// Runs Python in a folder; none if it or numpy is absent.
pub(crate) fn python(folder: &Path, script: &str) -> Option<Output> {
    let there = Command::new("python3").args(["-c", "import numpy"]).output();
    if !there.is_ok_and(|output| output.status.success()) {
        println!("skipped: there is no python3 with numpy");
        return None;
    }
    Some(Command::new("python3").args(["-c", script]).current_dir(folder).output().expect("python3"))
}

pub(crate) fn import(folder: &Path, arguments: &[&str]) -> Output {
    Command::new("python3").arg(IMPORTER).args(arguments).current_dir(folder).output().expect("python3")
}

pub(crate) fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}

/// A folder with `recordings.pkl`; none if it cannot be made here.
pub(crate) fn made_up() -> Option<TempDir> {
    let folder = tempfile::tempdir().expect("a folder");
    let output = python(folder.path(), MADE_UP)?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(folder)
}

/// Events of `recordings.pkl`, read as the importer wrote them.
fn imported(folder: &Path, options: &[&str]) -> Vec<Value> {
    let output = import(folder, &[&["recordings.pkl", "events.json"], options].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.starts_with("3 events in events.json (empty entries: 1)"), "{told}");
    json_of(&folder.join("events.json"))["events"].as_array().expect("a list").clone()
}

/// Refused as bad input, in one sentence, without a result.
pub(crate) fn assert_refused(folder: &Path, arguments: &[&str], wanted: &str) {
    let output = import(folder, arguments);
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {sentence}");
    assert!(sentence.starts_with("error: ") && sentence.lines().count() == 1, "{sentence}");
    assert!(sentence.contains(wanted), "{sentence}");
    assert!(!folder.join("out.json").exists(), "{arguments:?}");
}

/// A full turn to the right, as the importer rounds it.
fn turn() -> f64 {
    (-core::f64::consts::TAU * 1e5).round() / 1e5
}

#[test]
fn colours_become_internal_numbers() {
    let Some(folder) = made_up() else { return };
    let events = imported(folder.path(), &[]);
    let event = &events[0];
    assert_eq!(event["id"], "phase-test-000");
    assert_eq!(event["layout"], json!({ "base": 4, "flip": null }));
    assert_eq!(event["walls"], json!([[[16.0, 12.0], [16.0, 22.0]], [[16.0, 12.0], [8.5, 12.0]]]));
    // The second of the name's agents is agent 0, and the second of its objects is object 0.
    let goal = json!({ "kind": "object_on_landmark", "object": 1, "landmark": 2, "sign": 1 });
    let helper = json!({
        "radius": 1.2, "max_force": 600.0, "strength_level": 3, "size_level": 1, "goal": goal, "alpha": 1,
    });
    let helped = json!({
        "radius": 0.8, "max_force": 150.0, "strength_level": 0, "size_level": 0, "goal": goal, "alpha": 0,
    });
    assert_eq!(event["agents"], json!([helper, helped]));
    assert_eq!(
        event["objects"],
        json!([{ "radius": 1.01, "size_level": 3 }, { "radius": 1.6, "size_level": 2 }])
    );
    let kinds = ["event", "relation", "relation_human", "row_0"].map(|key| event[key].clone());
    assert_eq!(kinds, ["helping", "friendly", "neutral", "initial state"]);
    assert_eq!(event["recorded_steps"], 100);
    let rows = json!([[8.0, 20.0, 1.0, -0.5, 0.12346], [8.1, 19.9, 1.0, -0.5, 7.0]]);
    assert_eq!(event["trajectory"]["agents"][0], rows);
    // Cut to the agents' length.
    assert_eq!(event["trajectory"]["objects"][1].as_array().expect("rows").len(), 2);
}

#[test]
fn mirrored_entries_are_mended() {
    let Some(folder) = made_up() else { return };
    let events = imported(folder.path(), &[]);
    let (hindered, diagonal) = (&events[1], &events[2]);
    assert_eq!(hindered["id"], "phase-test-002");
    assert_eq!(hindered["layout"], json!({ "base": 0, "flip": 0 }));
    assert_eq!([&hindered["event"], &hindered["row_0"]], ["hindering", "after 1/60 s"]);
    let goal = json!({ "kind": "agent_on_landmark", "agent": 1, "landmark": 3, "sign": -1 });
    assert_eq!([&hindered["agents"][0]["goal"], &hindered["agents"][0]["alpha"]], [&goal, &json!(-1)]);
    assert_eq!(hindered["agents"][1]["goal"]["sign"], 1);
    assert_eq!(
        hindered["trajectory"]["agents"],
        json!([[[8.0, 4.0, 1.0, 0.5, 0.25]], [[9.0, 4.0, 0.0, 0.0, 7.5]]])
    );
    assert_eq!(hindered["trajectory"]["objects"][0], json!([[10.0, 4.0, 2.0, -3.0, -0.3]]));

    assert_eq!([&diagonal["event"], &diagonal["recorded_steps"]], [&json!("chasing"), &json!(60)]);
    let goals = [&diagonal["agents"][0]["goal"], &diagonal["agents"][1]["goal"]];
    assert_eq!(*goals[0], json!({ "kind": "touch", "agent": 0, "other": 1, "sign": 1 }));
    assert_eq!(*goals[1], json!({ "kind": "touch", "agent": 1, "other": 0, "sign": -1 }));
    let agent = &diagonal["trajectory"]["agents"][0];
    assert_eq!(agent[0], json!([8.0, 4.0, 1.0, -0.5, -6.0]));
    assert_eq!([&agent[1][4], &agent[2][4]], [&json!(turn()), &json!(-6.58319)]);
    assert_eq!(diagonal["trajectory"]["objects"][0][0], json!([10.0, 4.0, -3.0, -2.0, -0.3]));

    let recordings = read(&folder.path().join("events.json")).expect("phase-events/1");
    let kinds: Vec<EventKind> = recordings.iter().map(|recording| recording.scene.kind).collect();
    assert_eq!(kinds, [EventKind::Helping, EventKind::Hindering, EventKind::Chasing]);
}

#[test]
fn a_push_against_the_clock_is_told_from_the_jump_on_demand() {
    let Some(folder) = made_up() else { return };
    let angles = |options: &[&str], agent: usize| -> Vec<f64> {
        let events = imported(folder.path(), options);
        let rows = events[2]["trajectory"]["agents"][agent].as_array().expect("rows").clone();
        rows.iter().map(|row| row[4].as_f64().expect("a number")).collect()
    };
    assert_eq!(angles(&[], 1), [-1.0, -1.95664, -1.95664]);
    assert_eq!(angles(&["--angles", "consistent"], 1), [-1.0, -0.7, -0.7]);
    assert_eq!(angles(&["--angles", "consistent"], 0), [-6.0, turn(), -6.58319]);
}

#[test]
fn crafted_and_damaged_files_are_refused() {
    let Some(folder) = made_up() else { return };
    let output = python(folder.path(), BAD).expect("python3");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let plain = "is no pickle of plain data";
    let mut cases = vec![
        ("system", "asks for os.system"),
        ("posix", "asks for posix.system"),
        ("builtins", "asks for numpy.dtypes.__builtins__"),
        ("dotted", "asks for numpy.ndarray.__class__.mro__"),
        ("loader", "asks for numpy.load"),
        ("bytearray-called", "asks for builtins.bytearray"),
        ("empty", plain),
        ("rubbish", plain),
        ("cut", plain),
        ("number", "must hold a list"),
        ("other-list", "entry 0: `name` must be a text"),
        ("nothing", "all entries are empty"),
    ];
    // Elsewhere memory cannot be limited.
    if cfg!(target_os = "linux") {
        cases.extend([("bytearray", "of memory to read"), ("array", "of memory to read")]);
    }
    for (name, wanted) in cases {
        assert_refused(folder.path(), &[&format!("bad-{name}"), "out.json"], wanted);
    }
    assert!(!folder.path().join("harm").exists());
    assert_refused(folder.path(), &["missing.pkl", "out.json"], "cannot be read");
    assert_refused(folder.path(), &["recordings.pkl", "recordings.pkl"], "must be different");
}

/// A sheet with answers to the three catch trials, one to each given video, and blanks up to `lines`.
fn sheet(catches: [&str; 3], answers: &[(&str, &str)], lines: usize) -> String {
    let answer = |video: &str, said: &str| {
        json!([["video_name", video], ["subjectID", "x"], ["likert_response", said]]).to_string()
    };
    let trials = ["D1_E4_G_e1_mm.mp4", "D2_E12_G_e2_mm.mp4", "D3_E0_G_e3_mm.mp4"];
    let mut text = vec![json!([["age", "private"]]).to_string()];
    text.extend(trials.iter().zip(catches).map(|(video, said)| answer(video, said)));
    text.extend(answers.iter().map(|(video, said)| answer(video, said)));
    text.resize(lines + 1, "[]".to_owned());
    text.join("\n") + "\n"
}

#[test]
fn sheets_of_careful_raters_are_counted() {
    let Some(folder) = made_up() else { return };
    let raters = folder.path().join("raters");
    fs::create_dir(&raters).expect("a folder");
    let name = |layout: &str, goals: &str, steps: u32, alphas: &str| {
        format!(
            "D010121_1021040_0_F8_E{layout}_G{goals}_ST0_3_SZ0_1_2_3_P1_5_2_4_A0_0_C0_0_AN0.5_0.12_MCTS_L{steps}_\
             R{alphas}_PL1_EL1_0_0_s1000.mp4"
        )
    };
    let first = name("4", "['LMO', 0, 2, 1]_['LMO', 0, 2, 1]", 100, "0.0_10.0");
    let second = name("0.0", "['LMA', 1, 3, -1]_['LMA', 1, 3, 1]", 80, "-10.0_0.0");
    let right = ["adversarial", "friendly", "neutral"];
    let said = [(first.as_str(), "friendly"), (second.as_str(), "adversarial")];
    let write = |file: &str, text: String| fs::write(raters.join(file), text).expect("written");
    write("a.txt", sheet(right, &said, 23));
    write("b.txt", sheet(right, &[(&first, "neutral"), ("D9_E1_elsewhere.mp4", "friendly")], 23));
    write("failed.txt", sheet(["adversarial", "friendly", "friendly"], &said, 23));
    write("short.txt", sheet(right, &said, 22));
    write("long.txt", sheet(right, &said, 24));
    write("mute.txt", sheet(right, &[(&first, "")], 23));
    write("empty.txt", String::new());
    write(".hidden", "not a sheet".to_owned());
    let arguments = ["recordings.pkl", "out.json", "--raters", "raters", "--ratings", "ratings.json"];
    let output = import(folder.path(), &arguments);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(told.contains("by 2 raters (4 sheets are incomplete, 1 failed a catch trial)"), "{told}");
    let wanted = json!({
        "format": "phase-ratings/1",
        "ratings": {
            "phase-test-000": { "friendly": 1, "neutral": 1, "adversarial": 0 },
            "phase-test-002": { "friendly": 0, "neutral": 0, "adversarial": 1 },
        },
    });
    assert_eq!(json_of(&folder.path().join("ratings.json")), wanted);

    fs::remove_file(folder.path().join("out.json")).expect("removed");
    write("c.txt", "[]\n{\"cut\": \n".to_owned());
    assert_refused(folder.path(), &arguments, "line 2 is no JSON");
    write("c.txt", "[]\n[[\"video_name\", \"a\"], [\"video_name\", \"b\"]]\n".to_owned());
    assert_refused(folder.path(), &arguments, "line 2 gives a name twice");
    write("c.txt", "[]\n[[\"video_name\", {\"a\": 1, \"a\": 2}]]\n".to_owned());
    assert_refused(folder.path(), &arguments, "line 2 has the member `a` twice");
    fs::remove_dir_all(&raters).expect("removed");
    assert_refused(folder.path(), &arguments, "raters: cannot be read");
    fs::create_dir(&raters).expect("a folder");
    assert_refused(folder.path(), &arguments, "no complete sheet");
}

#[test]
fn the_real_recordings_and_ratings_come_out_as_converted_before() {
    let real = PathBuf::from(REAL);
    if !real.join("videos-dev.pkl").is_file() {
        println!("skipped: the published recordings are not at hand");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    if python(folder.path(), "").is_none() {
        return;
    }
    let [pickle, sheets] = ["videos-dev.pkl", "raters-dev"].map(|name| real.join(name).display().to_string());
    let output =
        import(folder.path(), &[&pickle, "out.json", "--raters", &sheets, "--ratings", "ratings.json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(json_of(&folder.path().join("ratings.json")), json_of(&real.join("dev-ratings.json")));
    let found = json_of(&folder.path().join("out.json"));
    let mut wanted = json_of(&real.join("dev.json"));
    for event in wanted["events"].as_array_mut().expect("a list") {
        // They were found by a search; the pickle has none.
        event.as_object_mut().expect("an event").remove("recovered_actions");
    }
    assert_eq!(found["format"], wanted["format"]);
    let [found, wanted] = [found, wanted].map(|file| file["events"].as_array().expect("a list").clone());
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!(found == wanted, "{}", wanted["id"]);
    }
}

/// The other recordings are read in the same way; their file has catch trials, which are no events, and
/// sheets about other catch trials with an answer in every line.
#[test]
fn the_other_recordings_have_ids_of_their_own_and_no_catch_trials() {
    let Some(folder) = made_up() else { return };
    let folder = folder.path();
    let script = r#"
import pickle, json, os
entries = pickle.load(open("recordings.pkl", "rb"))
catch = dict(entries[0], name=entries[0]["name"].replace(".mp4", "_mm.mp4"))
pickle.dump(entries + [catch], open("main.pkl", "wb"))
os.mkdir("sheets")
answer = lambda video, said: json.dumps([["video_name", video], ["likert_response", said]])
right = (("12.1", "adversarial"), ("13.2", "friendly"), ("4", "neutral"))
catches = [answer(f"D1_E{layout}_x_mm.mp4", said) for layout, said in right]
for rater, said in enumerate(["friendly", "friendly", "adversarial", "neutral", "neutral"]):
    lines = ["[]", *catches, *[answer(entries[0]["name"] if k == 0 else f"{k}.mp4", said) for k in range(20)]]
    if rater == 2:
        lines[-1] = "[]"
    if rater == 3:
        lines.pop()
    if rater == 4:
        lines[1] = answer("D1_E12.1_x_mm.mp4", "neutral")
    open(f"sheets/rater-{rater}.txt", "w").write("\n".join(lines) + "\n")
"#;
    assert!(python(folder, script).expect("it was there before").status.success());
    let output = import(
        folder,
        &["main.pkl", "main.json", "--set", "main", "--raters", "sheets", "--ratings", "ratings.json"],
    );
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(told.starts_with("3 events in main.json (empty entries: 1, catch trials: 1)"), "{told}");
    assert!(told.contains("by 2 raters (2 sheets are incomplete, 1 failed a catch trial)"), "{told}");
    let events = json_of(&folder.join("main.json"))["events"].clone();
    let ids: Vec<&str> =
        events.as_array().expect("a list").iter().filter_map(|event| event["id"].as_str()).collect();
    assert_eq!(ids, ["phase-main-000", "phase-main-002", "phase-main-003"]);
    let ratings = json_of(&folder.join("ratings.json"))["ratings"].clone();
    assert_eq!(ratings, json!({ "phase-main-000": { "friendly": 2, "neutral": 0, "adversarial": 0 } }));
}
