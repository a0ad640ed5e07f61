//! Readers of texts and bytes.

use phase_calibration::{Probe, Run};
use phase_dataset::preset::Preset;
use phase_eval::{predictions, ratings};
use phase_event::{from_json, to_json};
use phase_game::{FromPlayer, journal};
use phase_model::{
    Scene,
    json::{self, Field},
    path::RelativePath,
};
use phase_sim::SimulationSettings;
use phase_simple::{IntentNetwork, ReportModel, StrengthRegressor};
use phase_study::{
    config::StudyConfig,
    export::{participants, ratings_of},
    forms::{Form, Forms},
    question::Responses,
};
use phase_tensors::TensorFile;
use phase_track::{Picture, Survey, TableOptions, Tracker};
use serde_json::json;
use std::{path::Path, sync::LazyLock};

/// The forms that come with the program.
static FORMS: LazyLock<Forms> = LazyLock::new(|| Forms::included().expect("they can be read"));

/// Events: what is accepted is written, and read again the same.
pub(super) fn events(data: &[u8]) {
    let Ok(recordings) = phase_event::parse(data) else { return };
    let text = to_json(&recordings).expect("what is read can be written");
    let again = from_json(&text).expect("what is written can be read");
    assert_eq!(again, recordings, "read from its own text, it differs");
    assert_eq!(to_json(&again).expect("written"), text, "its text differs");
}

/// Scenes: what is valid has a physics and a start.
pub(super) fn scene(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let Ok(scene) = Scene::from_json(text) else { return };
    assert!(scene.validate().is_ok(), "an invalid scene was accepted: {scene:?}");
    assert!(scene.initial_state().is_finite(&scene.physics()));
}

/// Compositions of datasets.
pub(super) fn preset(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let _ = Preset::parse("fuzz.json", text);
}

/// Paths in files: what is accepted stays below its folder and has one form.
pub(super) fn paths(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let Ok(path) = RelativePath::new(text) else { return };
    assert_eq!(path.as_str(), text);
    let folder = Path::new("/folder");
    let below = path.below(folder);
    assert!(below.starts_with(folder) && below != folder, "{below:?} is not below its folder");
    let plain = |part: std::path::Component<'_>| {
        matches!(part, std::path::Component::Normal(_) | std::path::Component::RootDir)
    };
    assert!(below.components().all(plain), "{below:?} does not stay where it is");
}

/// Settings of simulations.
pub(super) fn settings(data: &[u8]) {
    let Ok(settings) = serde_json::from_slice::<SimulationSettings>(data) else { return };
    let Ok(text) = serde_json::to_string(&settings) else { return };
    let again: SimulationSettings = serde_json::from_str(&text).expect("what is written can be read");
    assert_eq!(serde_json::to_string(&again).expect("written"), text);
}

/// Answers of external methods.
pub(super) fn predictions(data: &[u8]) {
    let Ok(value) = json::parse(data) else { return };
    let _ = predictions::goals(&value);
    if let Ok(forecasts) = predictions::forecasts(&value) {
        for prediction in forecasts.values() {
            let _ = predictions::fit_prediction(prediction, 4, 20);
        }
    }
}

/// Ratings by people: what is accepted is written, and read again the same.
pub(super) fn ratings(data: &[u8]) {
    let Ok(value) = json::parse(data) else { return };
    let Ok(counts) = ratings::ratings(&value) else { return };
    let again = json!({ "format": ratings::RATINGS_FORMAT, "ratings": counts });
    assert_eq!(ratings::ratings(&again).expect("what is written can be read"), counts);
}

/// Data of jsPsych: what is accepted becomes ratings that can be read.
pub(super) fn jspsych(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let Ok(people) = participants(text) else { return };
    ratings::ratings(&ratings_of(&people, usize::MAX)).expect("what is written can be read");
}

/// Answers of raters' pages to each form: what is accepted is written, and read again the same.
pub(super) fn answers(data: &[u8]) {
    let Ok(value) = json::parse(data) else { return };
    for form in Form::ALL {
        let questions = FORMS.questions(form, 2);
        let Ok(answer) = Responses::read(&Field::root(&value), &questions) else { continue };
        let again = Responses::read(&Field::root(&answer.to_json()), &questions);
        assert_eq!(again.expect("what is written can be read"), answer);
    }
}

/// Journals of games: what is read can be resumed or is refused.
pub(super) fn journal(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let Ok(entries) = journal::entries(text) else { return };
    for entry in &entries {
        let text = serde_json::to_string(entry).expect("what is read can be written");
        let again = journal::entries(&format!("{text}\n")).expect("what is written can be read");
        assert_eq!(serde_json::to_string(&again).expect("written"), format!("[{text}]"));
    }
}

/// Messages of players.
pub(super) fn message(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let _ = FromPlayer::parse(text);
}

/// Configurations of studies.
pub(super) fn study(data: &[u8]) {
    let _ = StudyConfig::read(data, &FORMS);
}

/// Forms of studies.
pub(super) fn forms(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let _ = Forms::read(text);
}

/// Models of how people report.
pub(super) fn report_model(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let _ = ReportModel::from_json(text);
}

/// Probes and runs of `check-physics`.
pub(super) fn calibration(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    let _ = (Probe::parse(text), Run::parse(text));
}

/// Weights of networks.
pub(super) fn weights(data: &[u8]) {
    if let Ok(file) = TensorFile::open(data, "fuzz") {
        for name in file.names() {
            let _ = file.tensor(name);
        }
    }
    let _ = (StrengthRegressor::from_safetensors(data), IntentNetwork::from_safetensors(data));
}

/// Tables of positions: what is accepted is an event that can be written and read again.
pub(super) fn table(data: &[u8]) {
    for ending in ["csv", "jsonl"] {
        let Ok((event, tracking)) = phase_track::table(data, ending, &TableOptions::default()) else {
            continue;
        };
        let events = [("fuzz", &event, Some(&tracking))];
        let text = phase_event::observed_to_json(&events).expect("what is read can be written");
        let again = phase_event::parse_observed(text.as_bytes()).expect("what is written can be read");
        assert_eq!(again[0].1.rows(), event.rows());
    }
}

/// Pictures of any pixels, three times the same but for one row.
pub(super) fn pictures(data: &[u8]) {
    const SIDE: usize = 96;
    let mut pixels = vec![255; 3 * SIDE * SIDE];
    pixels.iter_mut().zip(data.iter().cycle()).for_each(|(pixel, byte)| *pixel = *byte);
    let mut tracker = Tracker::new();
    for frame in 0..3 {
        pixels[..3 * SIDE].rotate_left(3 * frame);
        let picture = Picture::new(SIDE, SIDE, &pixels).expect("a picture of a good size");
        if tracker.push(&picture, frame as f64 / 8.0).is_err() {
            return;
        }
    }
    let Ok(track) = tracker.finish() else { return };
    let (event, _) = track.event(track.meaning(), None).expect("what is tracked is an event");
    assert!(event.steps() > 0);
}

/// Rectangles that move over a white ground, six bytes each: x, y, side, both speeds and a colour.
pub(super) fn shapes(data: &[u8]) {
    const SIDE: usize = 64;
    let frames = (0..8_usize).map(|frame| {
        let mut pixels = vec![255; 3 * SIDE * SIDE];
        for shape in data.chunks_exact(6).take(12) {
            let [x, y, side, across, down, colour] = [0, 1, 2, 3, 4, 5].map(|k| usize::from(shape[k]));
            let moved = |start: usize, speed: usize| (start + frame * speed) % SIDE;
            for row in moved(y, down)..(moved(y, down) + side % 24).min(SIDE) {
                for column in moved(x, across)..(moved(x, across) + side % 24).min(SIDE) {
                    let k = 3 * (row * SIDE + column);
                    let channels = [colour % 4 * 60, colour / 4 % 4 * 60, colour / 16 % 4 * 60];
                    pixels[k..k + 3].copy_from_slice(&channels.map(|channel| channel as u8));
                }
            }
        }
        pixels
    });
    let frames: Vec<Vec<u8>> = frames.collect();
    let pictures = || frames.iter().map(|it| Picture::new(SIDE, SIDE, it).expect("a picture of a good size"));
    let mut survey = Survey::new();
    for picture in pictures() {
        survey.push(&picture).expect("pictures of one size");
    }
    let Ok(mut tracker) = survey.finish() else { return };
    for (frame, picture) in pictures().enumerate() {
        tracker.push(&picture, frame as f64 / 8.0).expect("pictures of one size");
    }
    let Ok(track) = tracker.finish() else { return };
    // Paths may all lie in one place.
    let Ok((event, tracking)) = track.event(None) else { return };
    let events = [("fuzz", &event, Some(&tracking))];
    let text = phase_event::observed_to_json(&events).expect("what is read can be written");
    let again = phase_event::parse_observed(text.as_bytes()).expect("what is written can be read");
    assert_eq!(again[0].1.missing(), event.missing());
}
