//! Clips, regressors, areas of interest, matrices, matched groups and packs, from one small dataset.

use crate::support::{refuse, succeed, tree, whole_or_absent};
use serde_json::Value;
use std::{collections::BTreeSet, fs, path::Path, process::Command};

/// Six events of 12 steps with videos.
fn dataset(path: &Path) {
    let effort = ["--max-steps", "12", "--simulations", "10", "--particles", "4"];
    let made =
        [&["gen-dataset", "--events", "6", "--date-published", "2026-11-23", "--out", "data"], &effort[..]];
    succeed(path, &made.concat());
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON")
}

/// The cells of a table.
fn table(path: &Path, separator: char) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).expect("a table");
    text.lines().map(|line| line.split(separator).map(str::to_owned).collect()).collect()
}

/// BIDS's own validator finds nothing wrong with tables whose videos are in `stimuli/`.
fn valid_bids(folder: &Path) {
    let events = folder.parent().expect("a folder").join("bids");
    fs::create_dir_all(events.join("stimuli")).expect("a folder");
    for file in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
        fs::copy(&file, events.join(file.file_name().expect("a name"))).expect("copied");
    }
    let names = table(&events.join("desc-posterior_events.tsv"), '\t');
    for row in &names[1..] {
        fs::write(events.join("stimuli").join(&row[3]), "a video").expect("written");
    }
    let arguments = ["--format", "json", "--ignoreWarnings"];
    let Ok(output) = Command::new("bids-validator-deno").args(arguments).arg(&events).output() else {
        eprintln!("skipped: there is no bids-validator-deno (PyPI)");
        return;
    };
    let found: Value = serde_json::from_slice(&output.stdout).expect("its report");
    assert_eq!(found["issues"]["issues"], serde_json::json!([]));
}

/// Checks that ffprobe (FFmpeg) reads a clip as a video of so many frames.
fn valid_video(file: &Path, frames: usize) {
    let shown = "stream=codec_name,codec_type,pix_fmt,avg_frame_rate,nb_read_frames";
    let arguments = ["-v", "error", "-count_frames", "-show_entries", shown, "-of", "json"];
    let Ok(output) = Command::new("ffprobe").args(arguments).arg(file).output() else {
        eprintln!("skipped: there is no ffprobe");
        return;
    };
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).expect("its report");
    let wanted = serde_json::json!([{
        "codec_name": "h264", "codec_type": "video", "pix_fmt": "yuv420p", "avg_frame_rate": "20/1",
        "nb_read_frames": frames.to_string(),
    }]);
    assert_eq!(found["streams"], wanted);
}

/// SIMPLE with one kind of minds says what agents see and believe: what an agent sees, it knows the place of.
fn beliefs_agree_with_sight(path: &Path, id: &str) {
    let observe = ["observe", "data", "--id", id, "--every", "1", "--minds", "phase", "--out", "believed"];
    succeed(path, &observe);
    let rows = table(&path.join("believed/desc-posterior_events.tsv"), '\t');
    assert_eq!(rows.len(), 1 + 3);
    let columns: Vec<usize> =
        (0..rows[0].len()).filter(|&column| rows[0][column].contains("_sees_")).collect();
    assert_eq!(columns.len(), 6, "two agents, each with three others");
    let mut seen = 0;
    for row in rows[1..].iter().filter(|row| row[columns[0]] != "n/a") {
        for &column in columns.iter().filter(|&&column| row[column] != "n/a") {
            let misplaced: f64 = row[column + 1].parse().expect("a distance");
            assert!((0.0..50.0).contains(&misplaced));
            if row[column] == "1.000000" {
                seen += 1;
                assert!(misplaced < 1e-3, "{}: {misplaced}", rows[0][column]);
            }
        }
    }
    assert!(seen > 0);
    let minds = ["observe", "data", "--method", "intent-network", "--minds", "published", "--out", "no"];
    assert!(refuse(path, &minds).contains("imagines no minds"));
}

#[test]
fn events_become_stimuli() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    dataset(path);
    let clip = ["clip", "data", "--seconds", "2", "--as", "mp4,png", "--plain", "--size", "96", "--out"];
    succeed(path, &[&clip[..], &["clips"]].concat());
    succeed(path, &[&clip[..], &["again", "--jobs", "1"]].concat());
    assert!(tree(&path.join("clips")) == tree(&path.join("again")), "the same events give the same bytes");
    assert!(succeed(path, &[&clip[..], &["clips"]].concat()).contains("already"));

    // Two of three seconds, from the middle: steps 2 to 10, frames 10 to 49.
    let clips = json(&path.join("clips/clips.json"));
    let first = &clips["clips"][0];
    assert_eq!((&first["first_step"], &first["steps"]), (&Value::from(2), &Value::from(8)));
    let id = first["id"].as_str().expect("an id");
    let source = first["source"].as_str().expect("an id");
    let pictures = fs::read_dir(path.join("clips").join(id)).expect("frames").count();
    assert_eq!(pictures, 40);
    valid_video(&path.join(format!("clips/{id}.mp4")), 40);
    let event = json(&path.join(format!("data/events/{source}.json")));
    let cut = json(&path.join(format!("clips/{id}.json")));
    let whole = &event["events"][0]["trajectory"]["agents"][0];
    let part = &cut["events"][0]["trajectory"]["agents"][0];
    for row in 1..=8 {
        assert_eq!(part[row], whole[row + 2]);
    }
    // Row 0 is the state itself: the last substep of step 2.
    let substep = &event["events"][0]["substeps"]["agents"][0][10];
    assert_eq!((&part[0][0], &part[0][4]), (&substep[0], &substep[4]));
    assert!(
        refuse(path, &["clip", "data", "--quiet", "--seconds", "4", "--out", "long"])
            .contains("does not fit")
    );
    assert!(
        refuse(path, &["clip", "data", "--seconds", "1.1", "--out", "long"])
            .contains("no whole number of steps")
    );
    let left = succeed(path, &["clip", "data", "--seconds", "4", "--shorter", "leave-out", "--out", "short"]);
    assert!(left.contains("0 clips") && left.contains(source), "{left}");

    succeed(path, &["observe", "data", "--method", "intent-network", "--every", "1s", "--out", "observed"]);
    let posterior = table(&path.join("observed/desc-posterior_events.tsv"), '\t');
    assert_eq!(posterior.len(), 1 + 6 * 3);
    let sum: f64 = posterior[1][4..7].iter().map(|cell| cell.parse::<f64>().expect("a number")).sum();
    assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    valid_bids(&path.join("observed"));
    let about = json(&path.join("observed/desc-posterior_events.json"));
    assert!(posterior[0].iter().all(|name| about[name]["Description"].is_string()));
    assert_eq!(table(&path.join("observed/desc-frames_events.tsv"), '\t').len(), 1 + 6 * 60);
    beliefs_agree_with_sight(path, source);
    fs::write(path.join("run.tsv"), format!("onset\tduration\tstim_file\n7.5\t3\t{source}.mp4\n"))
        .expect("it is written");
    let shown = [
        "observe",
        "data",
        "--method",
        "intent-network",
        "--every",
        "1",
        "--presentations",
        "run.tsv",
        "--out",
        "run",
    ];
    succeed(path, &shown);
    let run = table(&path.join("run/desc-motion_events.tsv"), '\t');
    let onsets: Vec<&str> = run[1..].iter().map(|row| row[0].as_str()).collect();
    assert_eq!(onsets, ["7.500", "8.500", "9.500"]);
    // What is no longer shown has no regressors; a table that shows nothing is none.
    let table_of = |rows: &str| format!("onset\tduration\tstim_file\n{rows}");
    for (rows, out, kept) in [("7.5\t1.5\t", "cut", 2), ("7.5\tn/a\t", "whole", 3)] {
        fs::write(path.join("run.tsv"), table_of(&format!("{rows}{source}.mp4\n"))).expect("written");
        succeed(path, &[&shown[..shown.len() - 1], &[out]].concat());
        let rows = table(&path.join(out).join("desc-motion_events.tsv"), '\t');
        assert_eq!(rows.len() - 1, kept, "{out}");
    }
    for (rows, rule) in [("", "shows no video"), ("1e308\t1\tx.mp4\n", "onset must be")] {
        fs::write(path.join("run.tsv"), table_of(rows)).expect("written");
        let told = refuse(path, &[&shown[..shown.len() - 1], &["none", "--quiet"]].concat());
        assert!(told.contains("run.tsv") && told.contains(rule), "{told}");
    }

    succeed(path, &["aoi", "data", "--id", source, "--out", "areas.csv"]);
    let areas = table(&path.join("areas.csv"), ',');
    let frames: BTreeSet<&str> = areas[1..].iter().map(|row| row[1].as_str()).collect();
    assert_eq!(frames.len(), 1 + 61, "landmarks, and the frames of the video");

    let features = "net=observed/desc-posterior_events.tsv:relation_";
    let told = succeed(
        path,
        &["rdm", features, "motion=observed/desc-motion_events.tsv", "--target", "net", "--out", "rdm"],
    );
    assert!(told.contains("2 matrices of 6 stimuli"), "{told}");
    assert_eq!(fs::metadata(path.join("rdm/net.npy")).expect("a file").len() % 64, 15 * 8 % 64);
    assert!(
        refuse(path, &["rdm", features, "--target", "people", "--out", "rdm"]).contains("there is no matrix")
    );

    let matched = succeed(path, &["match", "data", "--on", "length", "--out", "matched"]);
    assert!(matched.contains("1 group of one event of each kind"), "{matched}");
    assert!(refuse(path, &["match", "data", "--on", "charm", "--out", "matched"]).contains("no measure"));

    for platform in ["psychopy", "pavlovia", "gorilla"] {
        succeed(
            path,
            &["pack", "clips", "--for", platform, "--lists", "2", "--checks", "1", "--out", platform],
        );
    }
    let trials = table(&path.join("psychopy/list2.csv"), ',');
    assert_eq!(trials.len(), 1 + 6 + 1);
    for trial in &trials[1..] {
        assert!(path.join("psychopy").join(&trial[2]).is_file(), "{trial:?}");
        assert!(path.join("psychopy").join(&trial[3]).join("0039.png").is_file(), "{trial:?}");
    }
    let again = refuse(path, &["pack", "clips", "--for", "psychopy", "--out", "psychopy"]);
    assert!(again.contains("choose an empty or a new folder"), "{again}");
    whole_or_absent(path, &["pack", "clips", "--for", "gorilla"]);
    assert!(refuse(path, &["pack", "clips", "--for", "qualtrics", "--out", "q"]).contains("--address"));
}
