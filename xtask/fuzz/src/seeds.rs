//! Inputs to begin with: what the project itself writes.

use phase_event::{Recording, to_json};
use phase_model::{
    EventKind,
    random::{Purpose, stream},
};
use phase_sim::{SimulationSettings, simulate};

/// Simulations of a decision in the event that is one of the seeds.
const SIMULATIONS: usize = 8;
/// Length of that event (steps).
const STEPS: usize = 2;
/// Most bytes of a file of weights that are used.
const WEIGHT_BYTES: usize = 4096;
/// Lengths of inputs that are choices, and not texts.
const CHOICES: [usize; 3] = [16, 64, 256];

/// The seeds of a target, at least one.
#[must_use]
pub fn seeds(target: &str) -> Vec<Vec<u8>> {
    let texts = |texts: &[&str]| texts.iter().map(|text| text.as_bytes().to_vec()).collect();
    match target {
        "events" => EventKind::ALL.into_iter().filter_map(event).collect(),
        "scene" => EventKind::ALL.into_iter().filter_map(scene).collect(),
        "preset" => phase_data::PRESETS.iter().map(|(_, text)| text.as_bytes().to_vec()).collect(),
        "paths" => {
            texts(&["events/phase-500-0000.json", "videos/a.mp4", "data/train-00000-of-00001.parquet"])
        }
        "settings" => serde_json::to_vec(&SimulationSettings::default()).into_iter().collect(),
        "predictions" => texts(&[
            r#"{"events": [{"id": "a", "goals": [[{"goal": {"kind": "touch", "agent": 0, "other": 1, "sign": 1}, "p": 1.0}], [{"goal": {"kind": "touch", "agent": 1, "other": 0, "sign": 1}, "p": 1.0}]], "relation": {"friendly": 0.04201006613406606, "adversarial": 0.8437947344813396, "neutral": 0.1141951993845945}}]}"#,
            r#"{"events": [{"id": "a", "forecast": [[[8.1, 19.2], [8.2, 19.3]], [[20, 8], [20, 8]]]}]}"#,
        ]),
        "ratings" => texts(&[
            r#"{"format": "phase-ratings/1", "ratings": {"a": {"friendly": 1, "neutral": 0, "adversarial": 2}}}"#,
        ]),
        "jspsych" => texts(&[
            r#"[{"trial_type": "phase-rating", "form": "relation", "event": "a", "response": {"relation": "neutral"}, "correct": null}]"#,
            "\"trial_type\",\"form\",\"event\",\"response\",\"correct\"\r\n\"phase-rating\",\"relation\",\"a\",\"{\"\"relation\"\":\"\"neutral\"\"}\",\"null\"\r\n",
        ]),
        "answers" => texts(&[
            r#"{"relation": "friendly"}"#,
            r#"{"interactions": ["chasing", "helping"]}"#,
            r#"{"goal_0": "agent on blue", "goal_1": "touch", "relation": "neutral", "human_likeness": "5"}"#,
        ]),
        "journal" => texts(&[concat!(
            "{\"entry\":\"began\",\"round\":0}\n",
            "{\"entry\":\"step\",\"actions\":[\"up\",\"left\"]}\n",
            "{\"entry\":\"ended\",\"round\":0}\n",
        )]),
        "message" => texts(&[
            r#"{"type": "hold", "action": "up"}"#,
            r#"{"type": "away", "away": true}"#,
            r#"{"type": "leave"}"#,
        ]),
        "study" => texts(&[
            r#"{"format":"phase-study/1","name":"a","title":"A","form":"relation","consent":["c"],"instructions":["i"],"stimuli":[{"id":"s","video":"s.mp4"}],"raters_per_video":1,"videos_per_rater":1}"#,
        ]),
        "forms" => texts(&[phase_data::FORMS]),
        "report_model" => texts(&[phase_data::REPORT_MODEL]),
        "calibration" => texts(&[r#"{"family":"free","engine":"world","steps":[]}"#]),
        "weights" => {
            let weights = phase_data::STRENGTH_WEIGHTS;
            vec![weights.to_vec(), weights[..weights.len().min(WEIGHT_BYTES)].to_vec()]
        }
        "table" => texts(&["time,body,x,y,angle\n0,a,8,8,0\n1,a,12,8,1\n0,b,20,20,0\n1,b,20,20,0\n"]),
        "pictures" => vec![vec![255; 8], vec![0, 0, 0, 255, 255, 255]],
        "shapes" => vec![vec![10, 10, 30, 3, 2, 1, 60, 50, 40, 130, 125, 2], vec![0; 30]],
        "manifest" => texts(&[
            r#"{"format":"phase-dataset/3","name":"a","generator":"phase 0.1.0","seed":1,"events":[]}"#,
        ]),
        "records" => texts(&[
            r#"{"format":"phase-shard/1","shard":[1,2]}"#,
            r#"{"fingerprint":"fuzz","refused":[],"entries":[]}"#,
        ]),
        _ => CHOICES.into_iter().map(choices).collect(),
    }
}

/// Bytes that make any choices.
fn choices(length: usize) -> Vec<u8> {
    use rand::RngExt;
    let mut random = stream(length as u64, Purpose::Scene, 0);
    (0..length).map(|_| random.random()).collect()
}

fn scene(kind: EventKind) -> Option<Vec<u8>> {
    let scene = phase_sampler::sample_kind(kind, &mut stream(1, Purpose::Scene, 0)).ok()?;
    scene.to_json().ok().map(String::into_bytes)
}

fn event(kind: EventKind) -> Option<Vec<u8>> {
    let scene = phase_sampler::sample_kind(kind, &mut stream(1, Purpose::Scene, 0)).ok()?;
    let mut settings =
        SimulationSettings { max_steps: STEPS, min_steps: STEPS, ..SimulationSettings::default() };
    settings.minds = settings.minds.with_simulations(SIMULATIONS);
    let event = simulate(&scene, 1, &settings).ok()?;
    let text =
        to_json(&[Recording::of_event("seed", event, "phase".into(), serde_json::Value::Null)]).ok()?;
    Some(text.into_bytes())
}
