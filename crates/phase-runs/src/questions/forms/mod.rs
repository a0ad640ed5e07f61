//! The files of every evaluator.

use super::{
    QUESTIONS_FILE,
    answers::table,
    line,
    videos::{FOLDERS, FRAME_RATE},
};
use crate::{error::RunError, laboratory::create};
use phase_dataset::parquet::{TableColumn, TableValues, VideoBytes, write_table};
use phase_evidence::Narrative;
use phase_files::{WriteError, atomic, regular};
use phase_model::{arena::STEP_VIDEO_SECONDS, words::Names};
use phase_questions::{Control, Facts, INTRODUCTION, Query, Question};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::Write as _,
    path::Path,
};

/// Rows of the table for Hugging Face that are written at once.
const ROWS_PER_GROUP: usize = 500;

/// Files that are the same for all benchmarks.
const FIXED: [(&str, &str); 8] = [
    ("eval.yaml", include_str!("eval.yaml")),
    ("lmms_eval/_default_template_yaml", include_str!("lmms_template.yaml")),
    ("lmms_eval/utils.py", include_str!("lmms_utils.py")),
    ("vlmevalkit/phase_questions.py", include_str!("vlmevalkit.py")),
    ("inspect/phase_questions.py", include_str!("inspect_task.py")),
    ("lm_eval/phase_questions_text.yaml", include_str!("lm_eval.yaml")),
    ("lm_eval/utils.py", include_str!("lm_eval_utils.py")),
    ("introduction.txt", INTRODUCTION),
];

/// Writes all forms.
pub(super) fn write(
    out: &Path,
    all: &[Question],
    facts: &BTreeMap<&str, &Facts>,
    has_videos: bool,
    _seed: u64,
) -> Result<(), RunError> {
    let texts = texts(all, facts);
    for folder in ["data", "lmms_eval", "vlmevalkit", "inspect", "lm_eval"] {
        create(&out.join(folder))?;
    }
    for (name, text) in FIXED {
        atomic::write(&out.join(name), text.as_bytes())?;
    }
    // A task scores options; free answers are scored by `phase score`.
    for control in Control::ALL.into_iter().filter(|control| *control != Control::FreeForm) {
        let task = task_name(control);
        let text = format!(
            "include: _default_template_yaml\ntask: {task}\nlmms_eval_specific_kwargs:\n  default:\n    control: {}\n    \
             pre_prompt: \"\"\n    post_prompt: \"\\nAnswer with the letter of the right option alone.\"\n",
            control.name()
        );
        atomic::write(&out.join(format!("lmms_eval/{task}.yaml")), text.as_bytes())?;
    }
    let mut lines = String::new();
    for question in all {
        lines += &line(&row(question, &texts, facts))?;
    }
    atomic::write(&out.join("lmms_eval/questions.jsonl"), lines.as_bytes())?;
    atomic::write(&out.join("vlmevalkit/PHASE-Questions.tsv"), &tsv(all)?)?;
    atomic::write(&out.join("inspect/phase_questions.jsonl"), inspect(all)?.as_bytes())?;
    parquet(out, all, &texts, facts, has_videos)?;
    Ok(atomic::write(&out.join("README.md"), card(all).as_bytes())?)
}

/// The task of a control.
fn task_name(control: Control) -> String {
    match control {
        Control::Video => "phase_questions".to_owned(),
        other => format!("phase_questions_{}", other.name().replace('-', "_")),
    }
}

/// The events of every video in words, and the table of positions.
fn texts(all: &[Question], facts: &BTreeMap<&str, &Facts>) -> BTreeMap<String, String> {
    let names = &Names::PAPER;
    let mut texts = BTreeMap::new();
    for question in all {
        if texts.contains_key(&question.video) {
            continue;
        }
        let parts = question.events.iter().filter_map(|event| facts.get(event.as_str())).map(|facts| {
            let track = question.until.map_or_else(|| facts.track.clone(), |step| facts.track.until(step));
            let seen = Narrative::of(&facts.scene, &track, names).seen;
            format!("{seen}\n\n{}", table(&track, names))
        });
        let parts: Vec<String> = parts.collect();
        let text = match &parts[..] {
            [left, right] => format!("Left video:\n{left}\n\nRight video:\n{right}"),
            parts => parts.concat(),
        };
        texts.insert(question.video.clone(), text);
    }
    texts
}

/// Seconds of the video.
fn seconds(question: &Question, facts: &BTreeMap<&str, &Facts>) -> f64 {
    let steps = question.events.iter().filter_map(|event| facts.get(event.as_str()));
    let longest = steps.map(|facts| facts.track.steps()).max().unwrap_or_default();
    question.until.unwrap_or(longest) as f64 * STEP_VIDEO_SECONDS
}

/// A question as one flat object.
fn row(question: &Question, texts: &BTreeMap<String, String>, facts: &BTreeMap<&str, &Facts>) -> Value {
    let (options, answer) = question.shown(Control::Video);
    let (without, _) = question.shown(Control::NoneOfThese);
    json!({
        "question_id": question.id,
        "task": question.query.type_name(),
        "video": format!("{}.mp4", question.video),
        "question": question.text,
        "options": options,
        "options_none": without,
        "accepted": accepted(question),
        "answer": Question::letter(answer).to_string(),
        "answer_index": answer,
        "frames": question.frames.map_or(-1, |frames| frames.number() as i64),
        "p_human": question.p_human.clone().unwrap_or_default(),
        "set": question.set.clone().unwrap_or_default(),
        "duration_s": seconds(question, facts),
        "introduction": INTRODUCTION,
        "text": texts.get(&question.video),
    })
}

/// Words that name the right option where no options are shown.
fn accepted(question: &Question) -> Vec<String> {
    let right = &question.options[question.answer].value;
    let values = phase_questions::accepted(&question.query, &Names::PAPER).into_iter();
    values.filter(|it| it.value == *right).flat_map(|it| it.anywhere.into_iter().chain(it.alone)).collect()
}

/// The table of VLMEvalKit.
fn tsv(all: &[Question]) -> Result<Vec<u8>, RunError> {
    let failed = |error: csv::Error| {
        RunError::Output(WriteError {
            path: "vlmevalkit/PHASE-Questions.tsv".into(),
            action: "write the table",
            source: error.into(),
        })
    };
    let mut writer = csv::WriterBuilder::new().delimiter(b'\t').from_writer(Vec::new());
    let columns = ["index", "video", "question", "candidates", "answer", "dim", "question_id", "frames"];
    writer.write_record(columns).map_err(failed)?;
    for (index, question) in all.iter().enumerate() {
        let (options, answer) = question.shown(Control::Video);
        let candidates = json!(options).to_string();
        let frames = question.frames.map_or_else(|| "-1".to_owned(), |frames| frames.number().to_string());
        writer
            .write_record([
                &index.to_string(),
                &question.video,
                &question.text,
                &candidates,
                &Question::letter(answer).to_string(),
                question.query.type_name(),
                &question.id,
                &frames,
            ])
            .map_err(failed)?;
    }
    writer.into_inner().map_err(|error| failed(error.into_error().into()))
}

/// The samples of Inspect. Videos are relative to the folder of the benchmark.
fn inspect(all: &[Question]) -> Result<String, RunError> {
    let mut lines = String::new();
    for question in all {
        let (options, answer) = question.shown(Control::Video);
        lines += &line(&json!({
            "id": question.id,
            "input": [{ "role": "user", "content": [
                { "type": "video", "video": format!("videos/{}.mp4", question.video), "format": "mp4" },
                { "type": "text", "text": format!("{INTRODUCTION}\n\n{}", question.text) },
            ]}],
            "choices": options,
            "target": Question::letter(answer).to_string(),
            "metadata": {
                "task": question.query.type_name(), "video": question.video, "set": question.set,
                "frames": question.frames, "options_none": question.shown(Control::NoneOfThese).0,
                "question": question.text,
            },
        }))?;
    }
    Ok(lines)
}

/// The table of Hugging Face.
fn parquet(
    out: &Path,
    all: &[Question],
    texts: &BTreeMap<String, String>,
    facts: &BTreeMap<&str, &Facts>,
    has_videos: bool,
) -> Result<(), RunError> {
    // One video, one row after the other: its bytes are then stored once.
    let mut sorted: Vec<&Question> = all.iter().collect();
    sorted.sort_by(|a, b| (&a.video, &a.id).cmp(&(&b.video, &b.id)));
    let mut columns = Vec::new();
    if has_videos {
        let mut known: BTreeMap<&str, VideoBytes> = BTreeMap::new();
        let mut videos = Vec::with_capacity(sorted.len());
        for question in &sorted {
            let name = question.video.as_str();
            if !known.contains_key(name) {
                let path = out.join(FOLDERS[0].1).join(format!("{name}.mp4"));
                known.insert(name, VideoBytes::from(regular::bytes(&path)?));
            }
            videos.push((format!("{name}.mp4"), known.get(name).cloned().unwrap_or_default()));
        }
        columns.push(TableColumn { name: "video", values: TableValues::Videos(videos) });
    }
    let rows: Vec<Value> = sorted.iter().map(|question| row(question, texts, facts)).collect();
    let text = |name: &'static str| {
        let cell = |row: &Value| row[name].as_str().unwrap_or_default().to_owned();
        TableColumn { name, values: TableValues::Texts(rows.iter().map(cell).collect()) }
    };
    let list = |name: &'static str| {
        let of = |cell: &Value| cell.as_str().unwrap_or_default().to_owned();
        let cell = |row: &Value| row[name].as_array().into_iter().flatten().map(of).collect();
        TableColumn { name, values: TableValues::TextLists(rows.iter().map(cell).collect()) }
    };
    let number = |row: &Value, name: &str| row[name].as_i64().unwrap_or_default();
    let letters: Vec<String> = (0..5).map(|k| Question::letter(k).to_string()).collect();
    let tasks = Query::TYPES.map(str::to_owned).to_vec();
    let task = |question: &&Question| {
        let name = question.query.type_name();
        Query::TYPES.iter().position(|it| *it == name).unwrap_or_default() as i64
    };
    let answers = rows.iter().map(|row| number(row, "answer_index")).collect();
    let people = sorted.iter().map(|question| question.p_human.clone().unwrap_or_default()).collect();
    let lengths = sorted.iter().map(|question| seconds(question, facts)).collect();
    let frames = rows.iter().map(|row| number(row, "frames")).collect();
    let proofs = sorted.iter().map(|question| question.proof.to_string()).collect();
    columns.extend([
        text("question_id"),
        TableColumn { name: "task", values: TableValues::Classes(tasks, sorted.iter().map(task).collect()) },
        text("question"),
        list("options"),
        list("options_none"),
        list("accepted"),
        text("answer"),
        TableColumn { name: "answer_index", values: TableValues::Classes(letters, answers) },
        TableColumn { name: "frames", values: TableValues::Numbers(frames) },
        TableColumn { name: "p_human", values: TableValues::RealLists(people) },
        text("set"),
        text("text"),
        TableColumn { name: "duration_s", values: TableValues::Reals(lengths) },
        TableColumn { name: "proof", values: TableValues::Texts(proofs) },
    ]);
    let path = out.join("data/test-00000-of-00001.parquet");
    let bytes = write_table(Vec::new(), &columns, ROWS_PER_GROUP).map_err(|source| WriteError {
        path: path.clone(),
        action: "write the table",
        source,
    })?;
    Ok(atomic::write(&path, &bytes)?)
}

/// The card.
fn card(all: &[Question]) -> String {
    let videos: BTreeSet<&str> = all.iter().map(|question| question.video.as_str()).collect();
    let mut counts = String::new();
    for name in Query::TYPES {
        let of: Vec<&Question> = all.iter().filter(|it| it.query.type_name() == name).collect();
        if let Some(example) = of.first() {
            let options = example.options.len();
            let certified = of.iter().filter(|it| it.frames.is_some()).count();
            let _ =
                writeln!(counts, "| `{name}` | {} | {options} | {certified} | {} |", of.len(), example.text);
        }
    }
    include_str!("card.md")
        .replace("{questions}", &all.len().to_string())
        .replace("{videos}", &videos.len().to_string())
        .replace("{frame_rate}", &FRAME_RATE.to_string())
        .replace("{file}", QUESTIONS_FILE)
        .replace("{counts}", counts.trim_end())
}
