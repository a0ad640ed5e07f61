//! Files of the importer in `data/` can be read here.

use phase_dataset::phase_events::read;
use phase_model::EventKind;
use std::process::Command;

#[test]
fn what_the_importer_writes_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("events.json");
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/import_pik.py");
    let Ok(output) = Command::new("python3").args([script, "--self-test", "--out"]).arg(&file).output()
    else {
        eprintln!("skipped: there is no python3");
        return;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    #[cfg(unix)]
    {
        // What is no regular file is not replaced by one.
        let pipe = folder.path().join("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
        let refused = Command::new("python3").args([script, "--self-test", "--out"]).arg(&pipe).output();
        let refused = refused.expect("python3");
        assert_eq!(refused.status.code(), Some(1), "{}", String::from_utf8_lossy(&refused.stderr));
        assert!(String::from_utf8_lossy(&refused.stderr).contains("no regular file"));
        assert!(!std::fs::metadata(&pipe).expect("it is there").is_file());
    }
    let recordings = read(&file).expect("phase-events/1");
    assert_eq!(recordings.len(), 9);
    for recording in recordings {
        assert_eq!(recording.scene.kind, EventKind::Helping, "{}", recording.id);
        assert_eq!(recording.trajectory.steps(), 6, "{}", recording.id);
        // Raw records contain actions, reflected ones do not.
        assert_eq!(recording.recovered_actions.is_some(), recording.id.ends_with("raw"), "{}", recording.id);
    }
}

const IMPORTER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/import_pik.py");

/// Files that would harm whoever trusts them, and a good one.
const CRAFTED: &str = r#"
import os, pickle, sys
sys.path.insert(0, sys.argv[1])
import import_pik
record, _ = import_pik.made_up(None, False)
record.update({"sizes": [0.8, 1.2, 1.6, 1.01], "strengths": [90, 30], "entity_color_code": {0: 0, 1: 1, 2: 2, 3: 3},
               "name": "D_F8_E2_GLMO_0_2_1_LMO_0_2_1_ST2_0_SZ0_1_3_2_P1_5_2_4_L100_R10_0_e3"})
record["trajectories"][0][0][0] = 10.06
def keep(name, content):
    with open(name, "wb") as stream:
        stream.write(content)
keep("good.pik", pickle.dumps(record))
class Call:
    def __init__(self, *call):
        self.call = call
    def __reduce__(self):
        return self.call
keep("system.pik", pickle.dumps(Call(os.system, ("touch harmed",))))
keep("getattr.pik", pickle.dumps(Call(getattr, ("", "join"))))
keep("memory.pik", pickle.dumps(Call(bytearray, (3_100_000_000,))))
# From now on float is int, for whoever reads the next file in the same process.
keep("builtins.pik", b"cnumpy.dtypes\n__builtins__\n(S'float'\ncbuiltins\nint\ndu.")
for name in ["__loader__", "__spec__", "Float64DType"]:
    keep(f"{name}.pik", f"cnumpy.dtypes\n{name}\n.".encode())
# Attributes of what is admitted.
keep("build.pik", b"ccollections\nOrderedDict\n(N(S'__getitem__'\nI1\ndtb.")
# Lists of lists, each a hundred times the one in it.
keep("laughs.pik", b"\x80\x02](" + b"q\x00".join([b"K\x01" * 100 + b"e"]) + b"".join(
    b"q" + bytes([k]) + b"](" + (b"h" + bytes([k])) * 100 + b"e" for k in range(1, 8)) + b".")
keep("codec.pik", pickle.dumps(Call(__import__("codecs").encode, (b"a", "zlib"))).replace(b"encode", b"encode"))
if hasattr(os, "mkfifo"):
    os.mkfifo("pipe.pik")
os.mkdir("folder.pik")
"#;

#[test]
fn crafted_files_are_refused_and_harm_nobody() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");
    let made = Command::new("python3").args(["-c", CRAFTED, data]).current_dir(folder.path()).output();
    let Ok(made) = made else {
        eprintln!("skipped: there is no python3");
        return;
    };
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let import = |files: &[&str]| {
        let out = folder.path().join("events.json");
        let command = Command::new("python3")
            .arg(IMPORTER)
            .args(files)
            .arg("--out")
            .arg(&out)
            .current_dir(folder.path())
            .output();
        (command.expect("python3"), out)
    };
    let first = |out: &std::path::Path| read(out).expect("phase-events/1")[0].trajectory.agents[0][0][0];
    let (output, out) = import(&["good.pik"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!((first(&out) - 10.06).abs() < 1e-5);
    std::fs::remove_file(&out).expect("it was there");
    let mut files: Vec<String> = std::fs::read_dir(folder.path())
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".pik") && name != "good.pik")
        .collect();
    files.sort();
    assert!(files.len() >= 11, "{files:?}");
    for file in files {
        // Also before a good one.
        let (output, out) = import(&[&file, "good.pik"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{file}: {said}");
        assert_eq!(said.lines().count(), 1, "{file}: {said}");
        assert!(said.starts_with(&format!("error: {file}: ")), "{file}: {said}");
        assert!(!out.exists() && !folder.path().join("harmed").exists(), "{file}");
    }
}

/// Gives `folder` a record for each change of a name or of a field, none of which means anything.
const NOT_UNDERSTOOD: &str = r#"
import pickle, sys
NAME = "D010121_1_0_F8_E2_G['LMO', 0, 2, 1]_['LMO', 0, 2, 1]_ST1_1_SZ0_0_1_1_P1_5_2_4_A0_0_AN0.0_0.0_MCTS_L6_R0.0_10.0_e3"
row = lambda k, t: [10.0 + 3 * k + 0.02 * t, 14.0, 0.0, 0.0, 0.1 * t]
whole = {"trajectories": [[row(k, t) for t in range(7)] for k in range(4)], "entity_sizes": [0.8, 0.8, 1.2, 1.2],
         "entity_color_code": {0: 1, 1: 0, 2: 2, 3: 3}, "social_goals": "friendly"}
count = 0
def keep(**changes):
    global count
    with open(f"{'bad' if changes else 'good'}-{count}.pik", "wb") as stream:
        pickle.dump({**whole, "name": NAME, **changes}, stream)
    count += 1
keep()
for old, new in [("R0.0_10.0", "Rnone_10"), ("_R0.0_10.0", ""), ("R0.0_10.0", "R0.0"), ("R0.0_10.0", "R0.0_1e1"),
                 ("E2_", "E99_"), ("E2_", "E2.7_"), ("['LMO', 0, 2, 1]_", ""), ("'LMO', 0, 2, 1]_", "'LMX', 0, 2, 1]_"),
                 ("ST1_1", "ST1_9"), ("SZ0_0_1_1", "SZ0_1_1_1"), ("P1_", "P77_"), ("_L6", "_L"), ("_L6", "_L6_L7"),
                 ("AN0.0", "AN0.5"), ("AN0.0_0.0", "AN0.0"), ("AN0.0", "ANx"), ("AN0.0", "AN6.3"), ("AN0.0", "AN0.0_AN0.0"),
                 ("_e3", "_R10.0_0.0_e3"), ("D010121_1_0_F8", "any thing"), ("R0.0_10.0", "R0.0_10.0_5"),
                 ("_L6", "_L5"), ("_L6", "_L0"), ("_e3", "_mm"),
                 ("G['LMO', 0, 2, 1]_['LMO', 0, 2, 1]", "G['TE', 0, 0, 1]_['TE', 0, 0, 1]")]:
    assert old in NAME
    keep(name=NAME.replace(old, new, 1))
keep(name=7)
keep(video_name="another")
keep(sizes=[0.8, 0.8, 1.2, 0.8])
keep(strengths=[30, 30])
keep(entity_color_code=None)
keep(entity_color_code={0: "1", 1: 0, 2: 2, 3: 3})
keep(social_goals="kind")
keep(landmark_centers=[[1, 1], [2, 2], [3, 3], [4, 4]])
keep(trajectories=[[[1e300, *row[1:]] for row in track] for track in whole["trajectories"]])
keep(actions=[[0, 99]] * 6)
keep(actions=[[0] * 6, [0] * 5])
for k in range(4):
    keep(trajectories=[track + track[-1:] * (j == k) for j, track in enumerate(whole["trajectories"])])
"#;

#[test]
fn a_name_or_record_is_understood_whole_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let made = Command::new("python3").args(["-c", NOT_UNDERSTOOD]).current_dir(folder.path()).output();
    let Ok(made) = made else {
        eprintln!("skipped: there is no python3");
        return;
    };
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let out = folder.path().join("events.json");
    let mut refused = 0;
    let files = std::fs::read_dir(folder.path()).expect("a folder");
    for file in files.map(|entry| entry.expect("an entry").path()).collect::<Vec<_>>() {
        let output = Command::new("python3").arg(IMPORTER).arg(&file).arg("--out").arg(&out).output();
        let output = output.expect("python3");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if file.file_name().is_some_and(|name| name == "good-0.pik") {
            assert!(output.status.success(), "{said}");
            let recordings = read(&out).expect("phase-events/1");
            assert_eq!(recordings[0].scene.kind, EventKind::Helping);
            std::fs::remove_file(&out).expect("it was there");
        } else {
            assert_eq!(output.status.code(), Some(2), "{}: {said}", file.display());
            assert_eq!(said.lines().count(), 1, "{said}");
            assert!(!out.exists(), "{}", file.display());
            refused += 1;
        }
    }
    assert_eq!(refused, 40);
}

/// Real recordings, absent from the repository.
const REAL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/real-phase/videos-dev.pkl");

#[test]
fn both_importers_agree_on_the_published_recordings() {
    let numpy = Command::new("python3").args(["-c", "import numpy"]).output();
    if !std::path::Path::new(REAL).is_file() || !numpy.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: the published recordings, or python3 with numpy, are not at hand");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let other = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/import_socialgnn.py");
    let events = |script: &str, out: &[&str], angles: &str| {
        let mut command = Command::new("python3");
        command.arg(script).arg(REAL).args(out).args(["--angles", angles]).current_dir(folder.path());
        let output = command.output().expect("python3");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = std::fs::read(folder.path().join("events.json")).expect("written");
        let mut file: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
        let mut events = file["events"].take();
        for event in events.as_array_mut().expect("a list") {
            // The importers give ids in their own ways.
            event.as_object_mut().expect("an event").remove("id");
        }
        events
    };
    for angles in ["one-way", "consistent"] {
        let found = events(IMPORTER, &["--out", "events.json"], angles);
        let wanted = events(other, &["events.json"], angles);
        assert_eq!(found.as_array().expect("a list").len(), 50);
        assert!(found == wanted, "{angles}");
    }
}
