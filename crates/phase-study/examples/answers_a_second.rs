//! How many answers a second one file of answers takes, each of them on the disk before it is acknowledged:
//!
//! ```sh
//! cargo run --release --package phase-study --example answers_a_second -- FOLDER
//! ```

use phase_study::{
    config::StudyConfig,
    forms::Forms,
    store::Store,
    study::{Stage, Study, Token},
};
use serde_json::json;
use std::{collections::BTreeMap, error::Error, path::PathBuf, time::Instant};

const RATERS: usize = 200;
const VIDEOS: usize = 20;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("which folder?")?);
    let stimuli: Vec<_> =
        (0..100).map(|k| json!({"id": k.to_string(), "video": format!("{k}.mp4")})).collect();
    let config = json!({
        "format": "phase-study/1", "name": "bench", "title": "Bench", "form": "goals",
        "consent": ["?"], "instructions": ["!"],
        "stimuli": stimuli, "raters_per_video": RATERS, "videos_per_rater": VIDEOS, "raters": RATERS,
    });
    let forms = Forms::included()?;
    let config = StudyConfig::read(config.to_string().as_bytes(), &forms)?;
    let file = folder.join("answers-a-second.sqlite");
    let store = Store::open(&file, &config.name, config.form.name())?;
    let mut study = Study::new(config, forms, store)?;
    let begun = Instant::now();
    let mut tokens = Vec::new();
    for k in 0..RATERS {
        let token = study.join(&BTreeMap::new(), 0, Token::new((k as u128).to_le_bytes()))?.token;
        study.consent(&token, true, 0)?;
        study.instructed(&token, 0)?;
        tokens.push(token);
    }
    println!("{RATERS} raters let in: {:.1} ms each", begun.elapsed().as_secs_f64() * 1000.0 / RATERS as f64);
    let answer =
        json!({"goal_0": "touch", "goal_1": "get away", "relation": "adversarial", "human_likeness": "4"});
    let mut times = Vec::new();
    for trial in 1..=VIDEOS {
        for token in &tokens {
            let begun = Instant::now();
            let given = json!({"trial": trial, "answer": answer, "response_time": 9000, "plays": 1});
            let stage = study.answer(token, &given, 1)?;
            times.push(begun.elapsed().as_secs_f64() * 1000.0);
            assert!(matches!(stage, Stage::Trial(_) | Stage::Done { .. }));
        }
    }
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    let total: f64 = times.iter().sum();
    println!(
        "{} answers, one after another: {:.0} a second; median {:.2} ms, 99th percentile {:.2} ms, slowest {:.1} ms",
        times.len(),
        times.len() as f64 * 1000.0 / total,
        at(0.5),
        at(0.99),
        at(1.0)
    );
    Ok(())
}
