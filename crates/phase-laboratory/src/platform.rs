//! The files that experiment platforms read.

use core::fmt::Write as _;
use serde::Serialize;
use serde_json::{Value, json};

/// A platform for experiments.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Platform {
    /// PsychoPy on one's own computer.
    Psychopy,
    /// PsychoPy in a browser.
    Pavlovia,
    /// Gorilla's task builder.
    Gorilla,
    /// Children Helping Science (Lookit).
    ChildrenHelpingScience,
    /// Qualtrics.
    Qualtrics,
}

impl Platform {
    /// Every platform.
    pub const ALL: [Self; 5] =
        [Self::Psychopy, Self::Pavlovia, Self::Gorilla, Self::ChildrenHelpingScience, Self::Qualtrics];

    /// The name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Psychopy => "psychopy",
            Self::Pavlovia => "pavlovia",
            Self::Gorilla => "gorilla",
            Self::ChildrenHelpingScience => "children-helping-science",
            Self::Qualtrics => "qualtrics",
        }
    }

    /// The folder of the videos in the pack.
    #[must_use]
    pub const fn stimuli(self) -> &'static str {
        match self {
            // Lookit looks for a video below a folder named after its type.
            Self::ChildrenHelpingScience => "stimuli/mp4",
            _ => "stimuli",
        }
    }
}

/// A trial of a list.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Trial {
    /// Id of the stimulus.
    pub id: String,
    /// File name of its video.
    pub video: String,
    /// Number of pictures in the folder of its frames, `ID/0000.png` …; 0 if there is none.
    pub frames: usize,
    /// Length of the video (ms).
    pub milliseconds: u64,
    /// Kind of event.
    pub kind: String,
    /// Intended relation.
    pub relation: String,
    /// The set of minimal pairs that it belongs to, or nothing.
    pub set: String,
    /// The answer that an attention check asks for, or nothing.
    pub check: String,
}

/// The question of a pack and its answers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Question<'a> {
    /// The question.
    pub text: &'a str,
    /// The answers, in the order in which they are offered.
    pub answers: &'a [&'a str],
}

/// A file of a pack: its name, in the pack's folder, and its text.
pub type PackFile = (String, String);

/// The texts of a pack: a table of all trials for every list, what the platform imports, and a page of
/// instructions. `address` is where Qualtrics and Lookit find the videos.
///
/// # Errors
/// If a table cannot be written, which does not happen in memory.
pub fn files(
    platform: Platform,
    lists: &[Vec<Trial>],
    question: Question<'_>,
    address: &str,
) -> Result<Vec<PackFile>, csv::Error> {
    let mut files = Vec::new();
    for (k, list) in lists.iter().enumerate() {
        let number = k + 1;
        files.extend(match platform {
            Platform::Psychopy | Platform::Pavlovia => {
                vec![(format!("list{number}.csv"), conditions(platform, list)?)]
            }
            Platform::Gorilla => vec![(format!("list{number}.csv"), spreadsheet(list, question)?)],
            Platform::ChildrenHelpingScience => vec![
                (format!("list{number}.csv"), conditions(platform, list)?),
                (format!("list{number}.json"), protocol(list, question, address)),
            ],
            Platform::Qualtrics => vec![
                (format!("list{number}.csv"), conditions(platform, list)?),
                (format!("list{number}.txt"), survey(list, question, address)),
            ],
        });
    }
    files.push(("README.md".into(), instructions(platform, lists, question)));
    Ok(files)
}

fn table(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A row for each trial, paths relative to the table.
fn conditions(platform: Platform, list: &[Trial]) -> Result<String, csv::Error> {
    const HEADER: [&str; 10] = [
        "trial",
        "stim_id",
        "stim_file",
        "frames_folder",
        "frames",
        "duration",
        "kind",
        "relation",
        "stim_set",
        "check_answer",
    ];
    let folder = platform.stimuli();
    let row = |(k, trial): (usize, &Trial)| {
        let Trial { id, video, frames, milliseconds, kind, relation, set, check } = trial.clone();
        let seconds = (milliseconds as f64 / 1000.0).to_string();
        let stem = video.strip_suffix(".mp4").unwrap_or(&video);
        let pictures = if frames > 0 { format!("{folder}/{stem}") } else { String::new() };
        let number = (k + 1).to_string();
        let file = format!("{folder}/{video}");
        vec![number, id, file, pictures, frames.to_string(), seconds, kind, relation, set, check]
    };
    table(&HEADER, list.iter().enumerate().map(row))
}

/// Gorilla's spreadsheet: the columns that it manages itself, then ours; stimuli by file name alone.
fn spreadsheet(list: &[Trial], question: Question<'_>) -> Result<String, csv::Error> {
    let header = [
        "randomise_blocks",
        "randomise_trials",
        "display",
        "video",
        "question",
        "answers",
        "ANSWER",
        "stim_id",
        "kind",
        "relation",
        "stim_set",
    ];
    let page = |display: &str| {
        let mut row = vec![String::new(); header.len()];
        row[2] = display.to_owned();
        row
    };
    let trial = |trial: &Trial| {
        let mut row = page("trial");
        let text = if trial.check.is_empty() { question.text.to_owned() } else { check_text(&trial.check) };
        row[3] = trial.video.clone();
        row[4] = text;
        row[5] = question.answers.join("|");
        row[6] = trial.check.clone();
        row[7..].clone_from_slice(&[
            trial.id.clone(),
            trial.kind.clone(),
            trial.relation.clone(),
            trial.set.clone(),
        ]);
        row
    };
    let rows = core::iter::once(page("instructions")).chain(list.iter().map(trial)).chain([page("end")]);
    table(&header, rows)
}

/// The question of an attention check.
fn check_text(answer: &str) -> String {
    format!("This question checks that you are paying attention. Please choose \u{201c}{answer}\u{201d}.")
}

fn text_of(trial: &Trial, question: Question<'_>) -> String {
    if trial.check.is_empty() { question.text.to_owned() } else { check_text(&trial.check) }
}

/// A protocol of Lookit's experiment runner: a video, then a survey page, for each trial.
fn protocol(list: &[Trial], question: Question<'_>, address: &str) -> String {
    let mut frames = serde_json::Map::new();
    let mut sequence = Vec::new();
    for (k, trial) in list.iter().enumerate() {
        let stem = trial.video.strip_suffix(".mp4").unwrap_or(&trial.video);
        let video = json!({
            "kind": "exp-lookit-video",
            "baseDir": address,
            "videoTypes": ["mp4"],
            "video": { "source": stem, "loop": false },
            "requireVideoCount": 1,
            "autoProceed": true,
            "doRecording": false,
        });
        let title = text_of(trial, question);
        let answer = json!({ "type": "string", "title": title, "enum": question.answers, "required": true });
        let ask = json!({
            "kind": "exp-lookit-survey",
            "formSchema": {
                "schema": { "type": "object", "title": "", "properties": { "answer": answer } },
                "options": { "fields": { "answer": { "type": "radio", "vertical": true, "sort": false } } },
            },
        });
        for (name, frame) in
            [(format!("video-{}", k + 1), video), (format!("question-{}-{}", k + 1, trial.id), ask)]
        {
            sequence.push(Value::from(name.clone()));
            frames.insert(name, frame);
        }
    }
    format!("{:#}\n", json!({ "frames": frames, "sequence": sequence }))
}

/// A survey in the advanced format of Qualtrics: a page for each trial, the video above its question.
fn survey(list: &[Trial], question: Question<'_>, address: &str) -> String {
    let mut text = String::from("[[AdvancedFormat]]\n");
    for (k, trial) in list.iter().enumerate() {
        let number = k + 1;
        let separator = if k == 0 { "[[Block:Videos]]" } else { "[[PageBreak]]" };
        let video = &trial.video;
        let asked = text_of(trial, question);
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n{separator}\n\n[[Question:MC:SingleAnswer:Horizontal]]\n[[ID:Q{number}_{id}]]\n\
             <video src=\"{address}/{video}\" width=\"480\" autoplay muted playsinline></video><br>{asked}\n\
             [[Choices]]\n{choices}\n",
            id = trial.id.replace(['-', '.'], "_"),
            choices = question.answers.join("\n"),
        );
    }
    text
}

/// Instructions for the pack, in some ten lines.
fn instructions(platform: Platform, lists: &[Vec<Trial>], question: Question<'_>) -> String {
    let trials = lists.iter().map(Vec::len).max().unwrap_or(0);
    let checks = lists.iter().flatten().filter(|trial| !trial.check.is_empty()).count();
    let steps: &[&str] = match platform {
        Platform::Psychopy => &[
            "Put this folder beside your `.psyexp` file.",
            "Give a loop `$'list' + expInfo['list'] + '.csv'` as its conditions, and each participant one list.",
            "In the loop, a Movie component plays `$stim_file` and a Keyboard or Slider component follows.",
            "PsychoPy 2025.2 to 2026.1 may show black frames in movies. Cut clips with `--as mp4,png` then: `frames_folder` has the `frames` pictures 0000.png … for an Image component, each for three frames of a 60 Hz screen.",
        ],
        Platform::Pavlovia => &[
            "Put this folder beside your `.psyexp` file, and add it to the experiment's resources.",
            "Give a loop `$'list' + expInfo['list'] + '.csv'` as its conditions; `stim_file` is relative to the table.",
            "In the loop, a Movie component plays `$stim_file` and a Keyboard or Slider component follows.",
        ],
        Platform::Gorilla => &[
            "Upload every file of `stimuli` under *Stimuli* of a task; the spreadsheet names them without a folder.",
            "Upload a list under *Spreadsheet*; several lists become several spreadsheets, and a randomiser node picks one.",
            "The task needs the displays `instructions`, `trial` (a video zone bound to `video`, a text bound to `question`, buttons bound to `answers`) and `end`.",
        ],
        Platform::ChildrenHelpingScience => &[
            "Host the folder `stimuli` so that its address is the `baseDir` of the protocol; videos lie below `mp4`.",
            "Paste a `listN.json` into the study's protocol, with your consent and exit frames around its `sequence`.",
        ],
        Platform::Qualtrics => &[
            "Host the folder `stimuli` under the address in the survey.",
            "Import a `listN.txt` (Tools, Import/Export, Import Survey), and add consent before it.",
        ],
    };
    let mut text = format!(
        "# Stimuli for {}\n\n{} list(s) of at most {trials} trials; each participant sees one. The question is \u{201c}{}\u{201d}\n\n",
        platform.name(),
        lists.len(),
        question.text
    );
    for (k, step) in steps.iter().enumerate() {
        let _ = writeln!(text, "{}. {step}", k + 1);
    }
    if checks > 0 {
        let _ = writeln!(
            text,
            "\nTrials with a `check_answer` (Gorilla: `ANSWER`) are attention checks: they ask for that answer."
        );
    }
    text
}
