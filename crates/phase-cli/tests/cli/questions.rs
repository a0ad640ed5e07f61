//! A benchmark of questions about a few short events and pairs, its forms, and the score of answers.

use crate::support::{fail, phase, refuse, succeed, tree};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    path::Path,
    process::Stdio,
    thread::sleep,
    time::{Duration, SystemTime},
};

const EFFORT: [&str; 4] = ["--simulations", "40", "--particles", "5"];

/// Two pairs and twelve events.
fn datasets(path: &Path) {
    let preset = json!({
        "format": "phase-preset/3", "name": "pairs", "seed": 1, "layouts": {"open": [0, 2, 6]},
        "selection": {"min_steps": 40, "max_steps": 48, "attempts": 400, "ends": "drawn"},
        "sets": [{"stances": ["hinder", "indifferent"], "about": "place", "layouts": "open", "sets": 2}],
    });
    fs::write(path.join("pairs.json"), preset.to_string()).expect("written");
    succeed(
        path,
        &[&["gen-dataset", "--preset", "pairs.json", "--no-video", "--out", "pairs"], &EFFORT[..]].concat(),
    );
    let twelve = ["gen-dataset", "--events", "12", "--no-video", "--max-steps", "44", "--out", "twelve"];
    succeed(path, &[&twelve[..], &EFFORT].concat());
}

fn lines(path: &Path) -> Vec<Value> {
    let text = fs::read_to_string(path).expect("a file");
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn questions_are_asked_and_answers_scored() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    datasets(path);
    let ask = ["questions", "twelve", "pairs", "--size", "64", "--answers", "cue,guess,rules,still", "--out"];
    succeed(path, &[&ask[..], &["asked"]].concat());
    succeed(path, &[&ask[..], &["again", "--jobs", "1"]].concat());
    assert!(tree(&path.join("asked")) == tree(&path.join("again")), "the same events give the same bytes");
    assert!(succeed(path, &[&ask[..], &["asked"]].concat()).contains("already"));

    let questions = lines(&path.join("asked/questions.jsonl"));
    assert!(questions.len() >= 20, "{}", questions.len());
    let mut strata: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for question in &questions {
        let options = question["options"].as_array().expect("options");
        let answer = question["answer"].as_u64().expect("a number") as usize;
        assert!(answer < options.len() && options.len() >= 2, "{question}");
        let texts: Vec<&str> = options.iter().filter_map(|it| it["text"].as_str()).collect();
        assert!(
            (1..texts.len()).all(|k| !texts[..k].contains(&texts[k]) && !texts[k].is_empty()),
            "{texts:?}"
        );
        assert!(question["proof"]["rule"].is_string(), "{question}");
        let words = question["text"].as_str().expect("words");
        assert!(
            !words.contains(", which wants to"),
            "no question names a goal that another asks for: {words}"
        );
        let video = path.join(format!("asked/videos/{}.mp4", question["video"].as_str().expect("a name")));
        assert!(video.is_file(), "{}", video.display());
        let stratum = format!("{} {}", question["query"]["type"], question["stratum"]);
        let value = options[answer]["value"].to_string();
        *strata.entry(stratum).or_default().entry(value).or_default() += 1;
    }
    for (stratum, counts) in &strata {
        let (least, most) = (counts.values().min(), counts.values().max());
        let slack = if stratum.contains("pair-") { 1 } else { 0 };
        assert!(most.zip(least).is_some_and(|(most, least)| most - least <= slack), "{stratum}: {counts:?}");
    }
    // A cap takes whole rounds of a stratum, so that its answers stay equally frequent.
    let capped = ["questions", "twelve", "pairs", "--no-video", "--per-type", "7", "--out", "capped"];
    succeed(path, &capped);
    let mut left: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for question in lines(&path.join("capped/questions.jsonl")) {
        let value = &question["options"][question["answer"].as_u64().unwrap_or_default() as usize]["value"];
        *left
            .entry(question["query"]["type"].to_string())
            .or_default()
            .entry(value.to_string())
            .or_default() += 1;
    }
    assert!(left.values().all(|counts| counts.values().sum::<usize>() <= 7), "{left:?}");
    let seen: Vec<usize> = left["\"seen\""].values().copied().collect();
    assert_eq!(seen, [3, 3], "six of the most frequent type, three of each answer");
    // Everybody who knows the answers is right, and no answer is right by its letter.
    let letter = |question: &Value| char::from(b'A' + question["answer"].as_u64().unwrap_or_default() as u8);
    let answers = |of: &dyn Fn(&Value) -> String| {
        let line = |it: &Value| json!({ "id": it["id"], "answer": of(it) }).to_string() + "\n";
        fs::write(path.join("answers.jsonl"), questions.iter().map(line).collect::<String>())
            .expect("written");
        let text = succeed(path, &["score", "answers.jsonl", "--questions", "asked", "--json"]);
        serde_json::from_str::<Value>(&text).expect("JSON")
    };
    let all = |score: &Value| score["score"]["rows"][0]["accuracy"].as_f64().expect("an accuracy");
    assert_eq!(all(&answers(&|question| format!("({})", letter(question)))), 1.0);
    let text_of = |question: &Value| {
        let text = &question["options"][question["answer"].as_u64().unwrap_or_default() as usize]["text"];
        format!("I think it is {}.", text.as_str().unwrap_or_default())
    };
    assert!(all(&answers(&text_of)) > 0.95, "the words of the right option count, too");
    let rooms = questions.iter().filter(|it| it["query"]["type"] == "end-room");
    let free = |it: &Value| {
        let words = text_of(it);
        json!({ "id": it["id"], "answer": words, "control": "free-form" }).to_string() + "\n"
    };
    fs::write(path.join("free.jsonl"), rooms.map(free).collect::<String>()).expect("written");
    let text = succeed(path, &["score", "free.jsonl", "--questions", "asked", "--json"]);
    let scored: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!((all(&scored), &scored["score"]["rows"][0]["chance"]), (1.0, &json!(0.25)));
    assert_eq!(all(&answers(&|_| "I do not know".to_owned())), 0.0);
    assert!(all(&answers(&|_| "A".to_owned())) < 0.6);
    // A guess answers every question without the video, and with the first frame.
    let guessed = succeed(path, &["score", "asked/answers/guess.jsonl", "--questions", "asked", "--json"]);
    let guessed: Value = serde_json::from_str(&guessed).expect("JSON");
    assert_eq!(guessed["answers"].as_u64(), Some(2 * questions.len() as u64));
    judged(path, &questions);
    refused(path, &questions);
    forms(path, questions.len());
    killed(path, &[&ask[..], &["killed", "--jobs", "1"]].concat());
    assert!(
        tree(&path.join("asked")) == tree(&path.join("killed")),
        "a killed run goes on to the same bytes"
    );
}

/// Methods answer the types of questions that they judge, and no others.
fn judged(path: &Path, questions: &[Value]) {
    let types = |method: &str| -> Vec<Value> {
        let answered = lines(&path.join(format!("asked/answers/{method}.jsonl")));
        let of = |answer: &Value| questions.iter().find(|it| it["id"] == answer["id"]);
        answered.iter().filter_map(of).map(|question| question["query"]["type"].clone()).collect()
    };
    let (cue, rules, still) = (types("cue"), types("rules"), types("still"));
    for physical in ["end-room", "seen"] {
        assert!(rules.contains(&json!(physical)) && !cue.contains(&json!(physical)), "{physical}");
    }
    assert!(rules.iter().all(|name| !cue.contains(name)));
    assert!(still.iter().all(|name| name == "ahead"), "{still:?}");
}

/// A run that is killed twice, each time when it has looked into more events, keeps what it made before.
fn killed(path: &Path, arguments: &[&str]) {
    let kept = || -> BTreeMap<String, SystemTime> {
        let Ok(files) = fs::read_dir(path.join("killed/.cache")) else { return BTreeMap::new() };
        let looked_into = |name: &String| name.starts_with("inside-") && name.ends_with(".bin");
        let named = files.flatten().map(|file| (file.file_name().to_string_lossy().into_owned(), file));
        let about = named.filter(|(name, _)| looked_into(name)).map(|(name, file)| {
            (name, file.metadata().and_then(|it| it.modified()).expect("a time of change"))
        });
        about.collect()
    };
    let until = |count: usize| {
        let mut child =
            phase(path).args(arguments).stderr(Stdio::null()).spawn().expect("the program starts");
        while kept().len() < count {
            assert!(child.try_wait().expect("its state").is_none(), "it ended before it was killed");
            sleep(Duration::from_millis(2));
        }
        child.kill().expect("killed");
        child.wait().expect("it ends");
        kept()
    };
    let first = until(2);
    let second = until(first.len() + 2);
    assert!(first.iter().all(|(name, time)| second.get(name) == Some(time)), "{first:?} {second:?}");
    assert!(!path.join("killed/questions.json").exists());
    let other = fail(path, &[arguments, &["--seed", "9"]].concat());
    assert!(other.contains("an unfinished run of another kind"), "{other}");
    succeed(path, arguments);
    assert!(!path.join("killed/.cache").exists());
}

/// Answers that are refused, each in one sentence.
fn refused(path: &Path, questions: &[Value]) {
    let id = questions[0]["id"].as_str().expect("an id");
    let score = |text: &str| {
        fs::write(path.join("bad.jsonl"), text).expect("written");
        fail(path, &["score", "bad.jsonl", "--questions", "asked"])
    };
    assert!(score("{\"id\": \"nobody\", \"answer\": \"A\"}").contains("there is no question \"nobody\""));
    let twice = format!("{{\"id\": \"{id}\", \"answer\": \"A\"}}\n");
    assert!(score(&twice.repeat(2)).contains("line 2: question"));
    assert!(score("not JSON").contains("line 1"));
    let number = format!("{{\"id\": \"{id}\", \"answer\": 0}}");
    assert!(score(&number).contains("line 1: field `answer` must be a text, not 0"));
    let again = format!("{{\"id\": \"{id}\", \"answer\": \"A\", \"answer\": \"B\"}}");
    assert!(score(&again).contains("has the member `answer` twice"));
    assert!(score("").contains("has no answers"));
    let control = format!("{{\"id\": \"{id}\", \"answer\": \"A\", \"control\": \"sound\"}}");
    assert!(score(&control).contains("control must be one of"));
    let role = questions.iter().find(|it| it["query"]["type"] == "without").map(|it| it["id"].clone());
    if let Some(id) = role {
        let free = score(&json!({ "id": id, "answer": "worse", "control": "free-form" }).to_string());
        assert!(free.contains("asked with options only"), "{free}");
    }
    let shares = format!("{{\"id\": \"{id}\", \"answer\": \"A\", \"probabilities\": [0.5]}}");
    assert!(score(&shares).contains("probabilities must be"));
    refuse(path, &["questions", "nowhere", "--out", "x"]);
    fail(path, &["questions", "twelve", "twelve", "--out", "x"]);
    refuse(path, &["questions", "twelve", "--size", "65", "--out", "y"]);
}

/// Every form has all questions.
fn forms(path: &Path, count: usize) {
    for file in ["lmms_eval/questions.jsonl", "inspect/phase_questions.jsonl"] {
        assert_eq!(lines(&path.join("asked").join(file)).len(), count, "{file}");
    }
    let table = fs::read_to_string(path.join("asked/vlmevalkit/PHASE-Questions.tsv")).expect("a table");
    assert_eq!(table.lines().count(), count + 1);
    let parquet = fs::read(path.join("asked/data/test-00000-of-00001.parquet")).expect("a table");
    assert!(parquet.starts_with(b"PAR1") && parquet.ends_with(b"PAR1"));
    for control in ["first-frame", "shuffled", "reversed"] {
        let folder = path.join(format!("asked/videos-{control}"));
        let videos = fs::read_dir(path.join("asked/videos")).expect("videos").count();
        assert_eq!(fs::read_dir(folder).expect("videos").count(), videos);
    }
}
