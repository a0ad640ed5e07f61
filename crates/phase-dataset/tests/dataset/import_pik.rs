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
               "name": "D_F8_E2_GLMO_0_2_1_LMO_0_2_1_ST0_2_SZ0_1_2_3_P1_5_2_4_L100_R10_0_e3"})
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
