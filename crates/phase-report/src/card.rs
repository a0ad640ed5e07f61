//! The `README.md` inside a generated dataset, which is also a dataset card: its front matter tells
//! `datasets.load_dataset` which files to read.

use crate::features::features;
use phase_dataset::{
    form::StimulusForm,
    overview::Overview,
    parquet::{self, FOLDER},
    splits::Split,
};
use phase_evidence::{Manner, narrative::manner_in_words};
use phase_model::{EventKind, Level, words};

const PAGE: &str = "| `index.html` | opens in a browser, offline, and shows every video with its labels |\n";
const VIDEO_TABLE: &str = "| `videos/metadata.csv` | their labels, for `load_dataset(\"videofolder\", data_dir=\".../videos\")` |\n";
const SET_VIDEOS: &str = "| `videos/<set>.mp4` | the events of a set side by side |\n";
const SETS: &str = "| `pairs.csv` | where and when every two events of a set part |\n";

/// The line about videos.
fn videos(form: &StimulusForm) -> String {
    let StimulusForm { size, palette, frame_rate, .. } = form;
    let usual = StimulusForm::default();
    let frames = if *frame_rate == usual.frame_rate { ", five frames a step" } else { "" };
    let look = if (*size, palette) == (usual.size, &usual.palette) {
        String::new()
    } else {
        format!(", {size} × {size} pixels, palette {palette}")
    };
    format!("| `videos/<id>.mp4` | H.264, {frame_rate} frames a second{frames}{look} |\n")
}

/// The dataset's file for people: what it is, how it was generated, what it contains, and its licence.
/// `shortcuts` tells what can be predicted without looking at motion, in Markdown.
#[must_use]
pub fn card(overview: &Overview, command: &str, shortcuts: &str) -> String {
    let has_videos = overview.videos;
    format!(
        "{front}# {preset}: {count} PHASE events\n\n\
         {about}\n\n\
         ```python\nfrom datasets import load_dataset\n\nevents = load_dataset(\"path/to/this/folder\")\n```\n\n\
         ## What is in it\n\n\
         | kind | events | what it is meant to show |\n|---|---|---|\n{kinds}\n\
         {splits}{knowledge}\
         | file | what it is |\n|---|---|\n\
         {page}| `{FOLDER}/*.parquet` | every event as a row, by split; the columns are below |\n\
         | `events/<id>.json` | format `phase-events/1`: the same and every thought of the agents |\n\
         {videos}{set_videos}{sets}| `croissant.json` | the dataset in the vocabulary Croissant 1.0 |\n\
         | `manifest.json` | format `phase-dataset/1`: settings, seeds, and the checksum of every file |\n\n\
         ## Columns\n\n\
         Lengths are in world units u (the arena is 20 u wide, x from 6 to 26, y from 2 to 22), angles in \
         radians (0 faces +y, positive ones turn counter-clockwise). A step takes 5/60 s of physics and is shown \
         for 0.25 s of video. Lists for both agents have agent 0 (red) first.\n\n\
         | column | shape | type | unit | what it is |\n|---|---|---|---|---|\n{columns}\n\
         ## How it was made\n\n\
         By {generator}, a simulator after Netanyahu, Shu, Katz, Barbu and Tenenbaum, *PHASE: \
         PHysically-grounded Abstract Social Events for Machine Social Perception* (AAAI 2021). Each agent \
         has a belief of 50 particles unless the command says otherwise, plans symbolically in them, and \
         searches its actions with POMCP.\n\n```sh\n{command}\n```\n\n\
         The same command makes the same files, byte for byte, on the same platform. \
         `phase verify` checks that all of them are whole and agree.\n\n\
         ## What can be told without looking\n\n\
         A random forest (100 trees, five-fold cross-validation; events that share their bodies are in one fold) \
         that knows nothing of motion:\n{shortcuts}\n\
         ## Known limits\n\n\
         - Everything here is simulated; no person acted or was recorded.\n\
         - There are never more than two agents and two objects, in a square arena with four landmarks.\n\
         - At most one agent helps or hinders; the other minds its own goal.\n\
         - `kind`, `relation` and goals are what a scene was set up for. {selected} An agent need not get what it \
         wants: see `reached`.\n\
         - Beliefs are in it as far as they show in subgoals and their shares; the particles themselves are \
         recomputed from an event file.\n\n\
         ## Licence\n\nMIT OR Apache-2.0, as the program's.\n",
        front = front_matter(overview),
        page = if has_videos { PAGE } else { "" },
        videos = if has_videos { videos(&overview.form) + VIDEO_TABLE } else { String::new() },
        set_videos = if has_videos && overview.sets > 0 { SET_VIDEOS } else { "" },
        sets = if overview.sets > 0 { SETS } else { "" },
        preset = overview.preset,
        count = overview.events,
        about = about(),
        kinds = kinds(overview),
        splits = splits(overview),
        knowledge = knowledge(overview),
        columns = columns(),
        selected = selected(overview),
        generator = overview.generator,
    )
}

/// Whether events were checked to show their labels.
const fn selected(overview: &Overview) -> &'static str {
    if overview.selection.is_empty() {
        "Nothing has checked that it shows."
    } else {
        "Events in which a program did not find it shown were left out; how many, and why, is in `selection` of \
         `manifest.json`."
    }
}

/// Description of the events, in two sentences.
#[must_use]
pub const fn about() -> &'static str {
    "Physically grounded social events: two agents see, believe, plan and act in a physical world, and what they \
     want of each other shows in how they move. Each event has its scene, labels, trajectories, actions, \
     subgoals and a video."
}

/// Metadata for programs: licence, size, and which files make up which split.
fn front_matter(overview: &Overview) -> String {
    let size = match overview.events {
        0..1_000 => "n<1K",
        1_000..10_000 => "1K<n<10K",
        10_000..100_000 => "10K<n<100K",
        100_000..1_000_000 => "100K<n<1M",
        _ => "1M<n<10M",
    };
    let mut files = String::new();
    for name in overview.splits.keys().map(|split| split.name()) {
        files.push_str(&format!("  - split: {name}\n    path: {FOLDER}/{name}-*.parquet\n"));
    }
    // JSON strings are valid YAML strings.
    let name = serde_json::Value::from(format!("PHASE events: {}", overview.preset));
    format!(
        "---\npretty_name: {name}\nlicense:\n- mit\n- apache-2.0\nlanguage:\n- en\nsize_categories:\n- {size}\n\
         task_categories:\n- time-series-forecasting\n- video-classification\n\
         tags:\n- social-perception\n- theory-of-mind\n- multi-agent\n- physics\n- simulation\n- goal-inference\n\
         configs:\n- config_name: default\n  data_files:\n{files}{features}---\n\n",
        features = features(),
    )
}

fn kinds(overview: &Overview) -> String {
    let line = |(&kind, count): (&EventKind, &usize)| {
        format!("| {} | {count} | {} |\n", kind.name(), words::kind(kind))
    };
    let present = EventKind::ALL.iter().filter_map(|kind| overview.kinds.get_key_value(kind));
    present.map(line).collect()
}

fn splits(overview: &Overview) -> String {
    let line = |(split, count): (&Split, &usize)| format!("| {} | {count} |\n", split.name());
    format!("| split | events |\n|---|---|\n{}\n", overview.splits.iter().map(line).collect::<String>())
}

/// The agents that do not know the other's goal, if there are any, and how the events come about.
fn knowledge(overview: &Overview) -> String {
    if overview.levels.is_empty() {
        return String::new();
    }
    let line = |(&level, count): (&Level, &usize)| {
        let reasoning = match level {
            Level::Zero => "ignores the other's mind",
            Level::One => "infers the other's goal from what it sees the other do",
            Level::Two => "infers it, and assumes that the other infers, too",
        };
        format!("| {} | {count} | {reasoning} |\n", u8::from(level))
    };
    format!(
        "| level of reasoning | agents that do not know the other's goal | reasoning |\n|---|---|---|\n{}\n",
        overview.levels.iter().map(line).collect::<String>()
    ) + &manners(overview)
}

fn manners(overview: &Overview) -> String {
    let line = |(&manner, count): (&Manner, &usize)| {
        format!("| {} | {count} | {} |\n", manner.name(), manner_in_words(manner))
    };
    format!(
        "| manner | events that show it | evidence |\n|---|---|---|\n{}\n",
        overview.manners.iter().map(line).collect::<String>()
    )
}

fn columns() -> String {
    let line = |column: parquet::Description| {
        let shape = if column.shape.is_empty() { String::new() } else { format!("`{}`", column.shape) };
        format!("| `{}` | {shape} | {} | {} | {} |\n", column.name, column.kind, column.unit, column.what)
    };
    parquet::descriptions().into_iter().map(line).collect()
}
