//! `study ratings`: what people answered to jsPsych's plugins, as `phase-ratings/1`.

use super::options::CountRatings;
use crate::{error::CliError, json_file};
use phase_files::{FileError, Problem, atomic, regular, told};
use phase_study::export::{Participant, participants, ratings_of};
use serde_json::{Map, json};
use std::{collections::BTreeSet, path::Path};

pub(super) fn run(arguments: &CountRatings) -> Result<(), CliError> {
    let (out, allowed) = (&arguments.out, arguments.catch_failures_allowed as usize);
    json_file::check("--out", out, &arguments.files)?;
    let mut all = Vec::new();
    let mut read = BTreeSet::new();
    for file in &arguments.files {
        if !read.insert(file.canonicalize().unwrap_or_else(|_| file.clone())) {
            return Err(CliError::Usage(format!("{}: is named twice", file.display())));
        }
        all.extend(of_file(file)?);
    }
    let counted = all.iter().filter(|one| one.failures <= allowed).count();
    if counted == 0 {
        let failed = format!("each of {} participants failed more than {allowed} catch trials", all.len());
        return Err(CliError::Usage(format!("--catch-failures-allowed: {failed}")));
    }
    let ratings = ratings_of(&all, allowed);
    atomic::write_json(out, &ratings).map_err(CliError::Output)?;
    let events = ratings["ratings"].as_object().map_or(0, Map::len);
    let left_out = all.len() - counted;
    let value = json!({ "file": told(out), "events": events, "participants": counted, "left_out": left_out });
    let text = format!(
        "{}: {events} events by {counted} participants; {left_out} left out for catch trials",
        out.display()
    );
    arguments.output.print(text, &value)
}

fn of_file(file: &Path) -> Result<Vec<Participant>, CliError> {
    let wrong = |problem| CliError::File(FileError { file: file.to_owned(), problem });
    let bytes = regular::bytes(file)?;
    let text = core::str::from_utf8(&bytes)
        .map_err(|error| wrong(phase_model::json::JsonError::NotText(error.valid_up_to()).into()))?;
    participants(text).map_err(|error| wrong(Problem::content(error)))
}
