//! `study check`: whether a study can begin.

use super::options::CheckStudy;
use crate::{context::Context, error::CliError};
use phase_files::{FileError, Problem, json, regular, told};
use phase_study::{config::StudyConfig, forms::Forms};
use serde_json::json;
use std::{io::Read as _, path::Path};

/// Reads a configuration.
pub(super) fn read(file: &Path) -> Result<(StudyConfig, Forms), CliError> {
    let forms = Forms::included().map_err(CliError::Forms)?;
    let config = StudyConfig::read(&json::bytes(file)?, &forms)
        .map_err(|source| CliError::Study { file: file.to_owned(), source: Box::new(source) })?;
    Ok((config, forms))
}

pub(super) fn run(arguments: &CheckStudy, context: &Context) -> Result<(), CliError> {
    let (config, _) = read(&arguments.config)?;
    let base = arguments.config.parent().unwrap_or_else(|| Path::new(""));
    for (_, video) in config.videos() {
        is_video(&base.join(video))?;
    }
    let open = |texts: &[String]| texts.iter().any(|text| text.contains('[') && text.contains(']'));
    let mut notes = Vec::new();
    for (name, texts) in [
        ("introduction", &config.introduction),
        ("consent", &config.consent),
        ("instructions", &config.instructions),
    ] {
        if open(texts) {
            notes.push(format!("`{name}` has a text in [brackets] that you have to replace"));
        }
    }
    if config.completion.code.is_none() && config.completion.url.is_none() {
        notes
            .push("`completion` has neither code nor url: raters cannot show that they have finished".into());
    }
    if !config.one_of_each_set && config.stimuli.iter().any(|stimulus| stimulus.set.is_some()) {
        notes.push("a rater may see several videos of a set, unless `one_of_each_set` is true".into());
    }
    if config.catch_trials.is_empty() {
        notes.push("`catch_trials` is empty: inattentive raters cannot be recognised".into());
    }
    for note in &notes {
        context.note(format!("note: {}: {note}", arguments.config.display()));
    }
    let judgements = u64::from(config.raters) * u64::from(config.videos_per_rater);
    let value = json!({
        "file": told(&arguments.config), "name": config.name, "form": config.form.name(),
        "videos": config.stimuli.len(),
        "sources": config.sources(), "catch_trials": config.catch_trials.len(), "raters": config.raters,
        "videos_per_rater": config.videos_per_rater, "raters_per_video": config.raters_per_video,
        "raters_per_video_at_most": config.raters_per_video_at_most, "judgements": judgements, "notes": notes,
    });
    let text = format!(
        "{}: {} videos, each for {} to {} raters; {} raters with {} videos and {} catch trials each",
        config.name,
        config.stimuli.len(),
        config.raters_per_video,
        config.raters_per_video_at_most,
        config.raters,
        config.videos_per_rater,
        config.catch_trials.len()
    );
    arguments.output.print(text, &value)
}

/// Checks that a file is there and begins like an .mp4 file.
fn is_video(file: &Path) -> Result<(), CliError> {
    let fail = |problem| CliError::File(FileError { file: file.to_owned(), problem });
    let mut start = Vec::new();
    let read = regular::open(file)?.take(8).read_to_end(&mut start);
    read.map_err(|error| fail(Problem::Unreadable(error)))?;
    if start.get(4..8) != Some(b"ftyp") {
        return Err(CliError::Usage(format!("{}: is not an .mp4 file", file.display())));
    }
    Ok(())
}
