//! Data of jsPsych, in the texts that its own functions make, read back by what reads ratings.

use phase_eval::ratings::{RatingCounts, ratings as read_ratings};
use phase_study::export::{JsPsychError, participants, ratings_of};
use serde_json::{Value, json};

/// Output of `jsPsych.data.get().csv()` of jsPsych 8 for a video, a rating and a catch trial that is passed.
const CSV: &str = concat!(
    "\"trial_type\",\"trial_index\",\"video\",\"rt\",\"form\",\"event\",\"response\",\"correct\"\r\n",
    "\"phase-video\",\"0\",\"a.mp4\",\"3\",\"\",\"\",\"\",\"\"\r\n",
    "\"phase-rating\",\"1\",\"\",\"900\",\"relation\",\"a\",\"{\"\"relation\"\":\"\"friendly\"\"}\",\"null\"\r\n",
    "\"phase-rating\",\"2\",\"\",\"800\",\"relation\",\"c\",\"{\"\"relation\"\":\"\"neutral\"\"}\",\"true\"\r\n",
);

fn rating(event: &str, relation: &str, correct: Option<bool>) -> Value {
    json!({ "trial_type": "phase-rating", "form": "relation", "event": event, "rt": 900,
        "response": {"relation": relation}, "correct": correct })
}

#[test]
fn all_forms_of_data_give_the_same_ratings() {
    let trials = json!([
        {"trial_type": "phase-video", "video": "a.mp4", "rt": 3},
        rating("a", "friendly", None),
        {"trial_type": "phase-rating", "form": "interactions", "event": "a",
            "response": {"interactions": ["chasing"]}, "correct": null},
        rating("c", "neutral", Some(true)),
    ]);
    let one = participants(CSV).expect("CSV");
    for text in [trials.to_string(), format!("{trials:#}"), format!("\u{feff}{trials}\n")] {
        assert_eq!(participants(&text).expect("JSON"), one, "{text}");
    }
    let goals = json!([{"trial_type": "phase-rating", "form": "goals", "event": "a", "correct": null,
        "response": {"goal_0": "x", "goal_1": "y", "relation": "adversarial", "human_likeness": "5"}}]);
    let inattentive = json!([rating("a", "neutral", None), rating("c", "friendly", Some(false))]);
    let all = participants(&format!("{trials}\n{goals}\n{inattentive}\n")).expect("an array a line");
    assert_eq!((all.len(), &all[0], all[2].failures), (3, &one[0], 1));
    for (allowed, neutral) in [(0, 0), (1, 1)] {
        let counts = read_ratings(&ratings_of(&all, allowed)).expect("phase-ratings/1");
        assert_eq!(counts.len(), 1, "catch trials are no ratings");
        assert_eq!(counts["a"], RatingCounts { friendly: 1, adversarial: 1, neutral });
    }
}

#[test]
fn what_is_not_understood_is_refused() {
    let text = |trials: &[Value]| Value::from(trials.to_vec()).to_string();
    for (text, rule) in [
        (String::new(), "is empty"),
        ("[".into(), "truncated"),
        ("{\"a\": 1}".into(), "trial 1: must be an array"),
        ("[1]".into(), "trial 1: field"),
        (text(&[]), "has no trial of the plugin phase-rating"),
        (text(&[rating("c", "neutral", Some(true))]), "has no trial of the plugin phase-rating"),
        (text(&[rating("a", "angry", None)]), "trial 1: field `[0].response.relation` must be one of"),
        (
            text(&[rating("a", "neutral", None), rating("a", "neutral", None)]),
            "trial 2: rates the event \"a\"",
        ),
        (
            text(&[json!({"trial_type": "phase-rating", "form": "mood"})]),
            "must be one of interactions, goals",
        ),
        (CSV.replace("\"true\"", "\"yes\""), "trial 3: field `correct` is not JSON"),
        (CSV.replace("\"correct\"", "\"right\""), "needs one column `correct`"),
        (CSV.replace("\"event\"", "\"form\""), "needs one column `form`"),
        (CSV.replace("\"900\",", ""), "is no table of comma-separated values"),
    ] {
        let told = participants(&text).expect_err(rule).to_string();
        assert!(told.contains(rule), "{rule}: {told}");
    }
    assert_eq!(participants("[]"), Err(JsPsychError::Unrated));
}
