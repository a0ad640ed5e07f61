//! Studies to test with.

use phase_study::{
    config::StudyConfig,
    forms::{Form, Forms},
    question::{Kind, Question},
    store::Store,
    study::{Stage, Study, Token, TrialPage},
};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::{Map, Value, json};
use std::{collections::BTreeMap, path::Path};

pub(crate) fn forms() -> Forms {
    Forms::included().expect("the forms are valid")
}

/// A study of so many videos, each wanted by `k` raters who see `each`.
pub(crate) fn document(form: Form, videos: usize, k: u32, each: usize) -> Value {
    let stimuli: Vec<Value> = (0..videos)
        .map(|n| json!({"id": format!("event-{n}"), "video": format!("videos/event-{n}.mp4")}))
        .collect();
    json!({
        "format": "phase-study/1", "name": "a-study", "title": "A study", "form": form.name(),
        "consent": ["Do you agree?"], "instructions": ["Watch, then answer."],
        "stimuli": stimuli, "raters_per_video": k, "videos_per_rater": each, "seed": 7,
    })
}

pub(crate) fn read(document: &Value) -> StudyConfig {
    StudyConfig::read(document.to_string().as_bytes(), &forms()).expect("a valid configuration")
}

/// A study with its answers in a folder.
pub(crate) fn open(folder: &Path, document: &Value) -> Study {
    let config = read(document);
    let store =
        Store::open(&folder.join("answers.sqlite"), &config.name, config.form.name()).expect("a store");
    Study::new(config, forms(), store).expect("a study")
}

pub(crate) fn random(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// A token that a test can predict.
pub(crate) fn token_of(seed: u64) -> Token {
    let mut bytes = [0; 16];
    random(seed).fill_bytes(&mut bytes);
    Token::new(bytes)
}

pub(crate) fn parameters(id: &str) -> BTreeMap<String, String> {
    BTreeMap::from([("PROLIFIC_PID".to_owned(), id.to_owned())])
}

/// A random answer to some questions.
pub(crate) fn some_answer(questions: &[Question], random: &mut impl Rng) -> Value {
    let members = questions.iter().map(|question| {
        let choices = question.kind.choices();
        let mut choice = || choices[random.random_range(0..choices.len())].value.clone();
        let value = match &question.kind {
            Kind::Many { .. } => json!([choice()]),
            Kind::One { .. } | Kind::List { .. } => json!(choice()),
            Kind::Whole { from, .. } => json!(from),
            Kind::Text { .. } => json!("a text"),
        };
        (question.name.clone(), value)
    });
    Value::Object(members.collect::<Map<_, _>>())
}

/// The answer to a trial as a page sends it.
pub(crate) fn submission(trial: usize, answer: Value) -> Value {
    json!({"trial": trial, "answer": answer, "response_time": 1500, "plays": 1})
}

/// Lets a rater agree and read; the first trial, or what it sees instead.
pub(crate) fn begin(study: &mut Study, token: &Token, now: i64) -> Stage {
    let mut stage = study.consent(token, true, now).expect("agreed");
    if let Stage::Demographics { questions } = &stage {
        let answer = some_answer(questions, &mut random(1));
        stage = study.demographics(token, &answer, now).expect("said");
    }
    if let Stage::Instructions { .. } = stage {
        stage = study.instructed(token, now).expect("read");
    }
    stage
}

/// A new rater who answers everything as `answer` says; `None` if the study is full.
pub(crate) fn complete(
    study: &mut Study,
    id: &str,
    now: i64,
    mut answer: impl FnMut(&TrialPage) -> Value,
) -> Option<Token> {
    let seed = id
        .bytes()
        .fold(u64::from(now.unsigned_abs() as u32), |sum, byte| sum * 31 % 1_000_003 + u64::from(byte));
    let joined = study.join(&parameters(id), now, token_of(seed)).expect("let in");
    let mut stage = begin(study, &joined.token, now);
    while let Stage::Trial(page) = &stage {
        let given = submission(page.trial, answer(page));
        stage = study.answer(&joined.token, &given, now).expect("answered");
    }
    match stage {
        Stage::Done { .. } => Some(joined.token),
        _ => None,
    }
}
