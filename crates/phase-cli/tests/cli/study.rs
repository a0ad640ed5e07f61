//! `study`, from the configuration to figures, and in a program without it.

use crate::support::{refuse, tree};

#[cfg(not(feature = "serve"))]
#[test]
fn a_program_without_studies_says_how_to_get_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    for arguments in
        [&["study", "check", "s.json"][..], &["study", "new", "--experiment", "relations", "--videos", "v"]]
    {
        let sentence = refuse(path, arguments);
        assert!(sentence.contains("`cargo install --path crates/phase-cli`"), "{sentence}");
    }
    assert!(tree(path).is_empty());
}

#[cfg(feature = "serve")]
mod built_in {
    use super::*;
    use crate::support::{recording, run, succeed, text, whole_or_absent, write_events};
    #[cfg(all(feature = "serve", unix))]
    use crate::{serve::Served, walks::walk_and_look};
    use phase_study::{
        config::StudyConfig,
        forms::Forms,
        store::Store,
        study::{Stage, Study, Token},
    };
    use serde_json::{Value, json};
    use std::{collections::BTreeMap, fs, path::Path};

    /// A dataset of four events with videos.
    fn dataset(path: &Path) {
        let effort = ["--max-steps", "2", "--simulations", "10", "--particles", "4"];
        succeed(path, &[&["gen-dataset", "--events", "4", "--out", "data"], &effort[..]].concat());
    }

    /// Lets three people answer a study of relations as a server would.
    fn answer(path: &Path, config: &str, answers: &str, relation: &str) {
        let forms = Forms::included().expect("forms");
        let config = StudyConfig::read(&fs::read(path.join(config)).expect("bytes"), &forms).expect("valid");
        let store = Store::open(&path.join(answers), &config.name, config.form.name()).expect("a store");
        let mut study = Study::new(config, forms, store).expect("a study");
        for k in 0..3_u8 {
            let id = BTreeMap::from([("PROLIFIC_PID".to_owned(), format!("person-{k}"))]);
            let token = study.join(&id, k.into(), Token::new([k; 16])).expect("let in").token;
            study.consent(&token, true, k.into()).expect("agreed");
            let mut stage = study.instructed(&token, k.into()).expect("read");
            while let Stage::Trial(page) = stage {
                let answer = json!({
                    "trial": page.trial, "answer": {"relation": relation}, "response_time": 1000, "plays": 1,
                });
                stage = study.answer(&token, &answer, k.into()).expect("answered");
            }
        }
    }

    /// Files of two participants of jsPsych become ratings that `eval` reads; one file that is not understood
    /// is named, and nothing is written.
    #[test]
    fn answers_to_jspsych_are_counted() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        write_events(&path.join("events.json"), &[recording("a")]);
        for (file, relation, correct) in [("1.json", "friendly", true), ("2.json", "neutral", false)] {
            let trial = |event: &str, correct: Value| {
                json!({ "trial_type": "phase-rating", "form": "relation", "event": event, "correct": correct,
                    "response": {"relation": relation} })
            };
            let trials = json!([trial("a", Value::Null), trial("catch", correct.into())]);
            fs::write(path.join(file), trials.to_string()).expect("written");
        }
        let told = succeed(path, &["study", "ratings", "1.json", "2.json"]);
        assert!(told.contains("1 events by 1 participants; 1 left out"), "{told}");
        succeed(path, &["study", "ratings", "1.json", "2.json", "--catch-failures-allowed", "1"]);
        let eval = ["eval", "goals", "--method", "chance", "--events", "events.json"];
        succeed(path, &[&eval[..], &["--ratings", "ratings.json", "--out", "out"]].concat());

        fs::write(path.join("3.json"), "[]").expect("written");
        for files in [&["1.json", "3.json"][..], &["2.json"], &["none.json"]] {
            let told = refuse(path, &[&["study", "ratings"], files, &["--out", "new.json"]].concat());
            assert!(told.contains(files[files.len() - 1]) || told.contains("--catch-failures"), "{told}");
            assert!(!path.join("new.json").exists());
        }
    }

    #[test]
    fn from_a_dataset_to_figures() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        dataset(path);
        let new =
            ["study", "new", "--experiment", "relations", "--videos", "data", "--catch", "demo-0001=neutral"];
        let told = succeed(path, &new);
        assert!(told.contains("3 videos") && told.contains("phase study check study.json"), "{told}");
        let checked: Value =
            serde_json::from_str(&succeed(path, &["study", "check", "study.json", "--json"])).expect("JSON");
        assert_eq!(
            (&checked["videos"], &checked["catch_trials"], &checked["raters"]),
            (&json!(3), &json!(1), &json!(10))
        );
        assert!(checked["notes"].to_string().contains("[brackets]"), "{checked}");

        answer(path, "study.json", "answers.sqlite", "neutral");
        let answers = ["study.json", "--answers", "answers.sqlite"];
        let told = succeed(path, &[&["study", "export"], &answers[..], &["--out", "export"]].concat());
        assert!(told.contains("ratings of 3 events"), "{told}");
        let export = tree(&path.join("export"));
        assert!(export.contains_key(Path::new("dataset_description.json")));
        let tables: Vec<String> = export.values().map(|bytes| text(bytes)).collect();
        assert!(tables.iter().all(|table| !table.contains("person-0")), "ids stay here");
        whole_or_absent(path, &[&["study", "export"], &answers[..]].concat());
        succeed(path, &[&["study", "export"], &answers[..], &["--out", "named", "--external-ids"]].concat());
        assert!(tree(&path.join("named")).values().any(|bytes| text(bytes).contains("person-0")));
        assert!(
            refuse(path, &[&["study", "export"], &answers[..], &["--out", "named"]].concat())
                .contains("contains other files")
        );

        let evaluated = succeed(
            path,
            &[
                "eval",
                "goals",
                "--method",
                "chance",
                "--events",
                "data",
                "--ratings",
                "export/products/ratings.json",
                "--out",
                "eval",
                "--json",
            ],
        );
        let evaluated: Value = serde_json::from_str(&evaluated).expect("JSON");
        assert_eq!(evaluated["agreement"]["n"], 3);
        assert_eq!(evaluated["agreement"]["ratings"], 9);

        let report =
            succeed(path, &[&["study", "report"], &answers[..], &["--out", "report", "--json"]].concat());
        let analysis: Value = serde_json::from_str(&report).expect("JSON");
        assert_eq!(
            (&analysis["raters"]["complete"], &analysis["coverage"]["judgements"]),
            (&json!(3), &json!(9))
        );
        // The folder of a server, and one that has another study.
        fs::create_dir_all(path.join("served/studies")).expect("a folder");
        fs::copy(path.join("answers.sqlite"), path.join("served/studies/relations.sqlite")).expect("copied");
        let of_folder = ["study", "report", "study.json", "--answers", "served", "--out", "again", "--json"];
        assert_eq!(succeed(path, &of_folder), report);
        let renamed = fs::read_to_string(path.join("study.json")).expect("a study");
        fs::write(path.join("other.json"), renamed.replace("\"relations\"", "\"other\"")).expect("written");
        let other = ["study", "report", "other.json", "--answers", "served", "--out", "other"];
        assert!(refuse(path, &other).contains("no answers of the study other; it has those of relations"));
        let files = tree(&path.join("report"));
        for file in ["confusion.svg", "conditions.svg"] {
            assert!(files.contains_key(Path::new(file)), "{file}");
        }
        for file in ["report.md", "report.html", "analysis.json"] {
            assert!(files.contains_key(Path::new(file)), "{file}");
        }
    }

    /// docs/how-to/studies.md, from top to bottom: the server shows the page that it names, then programs
    /// answer in the place of people.
    #[cfg(all(feature = "serve", unix))]
    #[test]
    fn as_documented() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        let before = |arguments: &[&str]| match arguments {
            ["serve", options @ ..] => {
                let served = Served::start(path, options);
                let page = &served.first;
                assert!(page.ends_with("/study/relations/"), "{page}");
                assert!(served.get("/").contains("404") && served.get("/api/game").contains("404"));
                assert!(served.get("/study/relations/").starts_with("HTTP/1.1 200"));
                assert!(served.get("/api/study/relations/").contains("404"));
                served.stop();
                true
            }
            ["study", "report", ..] => {
                answer(path, "study/study.json", "study/answers/studies/relations.sqlite", "friendly");
                false
            }
            _ => false,
        };
        walk_and_look("how-to/studies.md", path, "study/", before);
    }

    #[test]
    fn two_sources_with_labels_from_events() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        dataset(path);
        fs::create_dir(path.join("human")).expect("a folder");
        for k in 0..2 {
            let from = path.join(format!("data/videos/demo-000{k}.mp4"));
            fs::copy(from, path.join(format!("human/played-{k}.mp4"))).expect("copied");
        }
        write_events(&path.join("events.json"), &[recording("played-0"), recording("another")]);
        let told = succeed(
            path,
            &[
                "study",
                "new",
                "--experiment",
                "experiment-2",
                "--videos",
                "data",
                "--videos",
                "human=human",
                "--events",
                "events.json",
                "--sample",
                "2",
                "--json",
            ],
        );
        let told: Value = serde_json::from_str(&told).expect("JSON");
        assert_eq!((&told["videos"], &told["videos_per_rater"]), (&json!(4), &json!(2)));
        let config: Value =
            serde_json::from_slice(&fs::read(path.join("study.json")).expect("bytes")).expect("JSON");
        assert_eq!(config["between_sources"], true);
        let stimuli = config["stimuli"].as_array().expect("a list");
        let played = stimuli.iter().find(|it| it["id"] == "played-0").expect("there");
        assert_eq!((&played["source"], &played["objects"]), (&json!("human"), &json!(1)));
        assert_eq!(
            (&played["goals"], &played["relation"]),
            (&json!(["agent on blue", "agent on green"]), &json!("neutral"))
        );
        assert!(stimuli.iter().any(|it| it["id"] == "played-1" && it["relation"].is_null()));
        succeed(path, &["study", "check", "study.json"]);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        dataset(path);
        fs::create_dir(path.join("empty")).expect("a folder");
        fs::create_dir(path.join("plain")).expect("a folder");
        fs::copy(path.join("data/videos/demo-0000.mp4"), path.join("plain/played.mp4")).expect("copied");
        write_events(&path.join("played.json"), &[recording("played")]);
        write_events(&path.join("others.json"), &[recording("another")]);
        let both = ["--videos", "plain", "--events", "played.json", "--events", "others.json"];
        let new = ["study", "new", "--experiment", "relations"];
        let cases: &[(&[&str], &[&str])] = &[
            (&["--videos", "nowhere"], &["nowhere"]),
            (&["--videos", "empty"], &["empty", "no videos"]),
            (&["--videos", "data", "--catch", "demo-0001"], &["ID=ANSWER"]),
            (&["--videos", "data", "--catch", "demo-0009=neutral"], &["demo-0009"]),
            (&["--videos", "data", "--catch", "demo-0001=angry"], &["expected.relation", "friendly"]),
            (&["--videos", "data", "--name", "A study"], &["`name`", "small letters"]),
            (&["--videos", "data", "--one-of-each-set"], &["`one_of_each_set`", "`set`"]),
            (&["--videos", "data", "--videos-per-rater", "9"], &["`videos_per_rater`", "1 to 4"]),
            (&["--videos", "data", "--videos", "data"], &["twice"]),
            (&["--videos", "a b=data"], &["`stimuli[0].source`"]),
            (&["--videos", "plain", "--events", "others.json"], &["--events others.json", ".mp4"]),
            (&["--videos", "data", "--events", "played.json"], &["--events played.json", ".mp4"]),
            (&both, &["--events others.json"]),
        ];
        let before = tree(path);
        for (arguments, parts) in cases {
            let sentence = refuse(path, &[&new[..], arguments].concat());
            assert!(parts.iter().all(|part| sentence.contains(part)), "{arguments:?}: {sentence}");
            assert_eq!(tree(path), before, "{arguments:?}");
        }
        succeed(path, &[&new[..], &["--videos", "data"]].concat());
        assert!(refuse(path, &[&new[..], &["--videos", "data"]].concat()).contains("exists"));
        // Videos from elsewhere are copied into a folder that is made.
        let elsewhere = ["--videos", "data", "--name", "mine", "--out", "new/folder/s.json"];
        succeed(path, &[&new[..], &elsewhere].concat());
        succeed(path, &["study", "check", "new/folder/s.json"]);
        let copied = fs::read(path.join("new/folder/videos/phase/demo-0001.mp4")).expect("a copy");
        assert_eq!(copied, fs::read(path.join("data/videos/demo-0001.mp4")).expect("a video"));
        fs::write(path.join("new/folder/videos/phase/demo-0001.mp4"), "another").expect("written");
        fs::remove_file(path.join("new/folder/s.json")).expect("removed");
        assert!(refuse(path, &[&new[..], &elsewhere].concat()).contains("demo-0001.mp4: is there"));
        let none = ["study", "report", "study.json", "--answers", "none.sqlite", "--out", "report"];
        assert!(refuse(path, &none).contains("none.sqlite: no such file"));
        let other = ["study", "report", "study.json", "--answers", "study.json", "--out", "report"];
        assert!(refuse(path, &other).contains("is not a file with answers"));
        fs::write(path.join("data/videos/demo-0002.mp4"), "<html>").expect("written");
        assert!(
            refuse(path, &["study", "check", "study.json"]).contains("demo-0002.mp4: is not an .mp4 file")
        );
        fs::remove_file(path.join("data/videos/demo-0002.mp4")).expect("removed");
        assert!(refuse(path, &["study", "check", "study.json"]).contains("demo-0002.mp4"));
        let output = run(path, &["study", "check", "data/manifest.json"]);
        assert!(text(&output.stderr).contains("phase-study/1"));
    }
}
