//! `study export`, `study report` and `study backup`.

use super::{
    check::read,
    options::{BackupStudy, ExportStudy, ReportStudy},
};
use crate::{console::print_message, error::CliError, surroundings};
use phase_files::{FileError, Problem, WriteError, atomic, new_folder::NewFolder, private, regular, told};
use phase_runs::error::RunError;
use phase_study::{
    analysis::{Analysis, document},
    config::StudyConfig,
    export::{psych_ds, ratings},
    forms::Forms,
    record::Rater,
    store::{Answers, StoreError, backup as copy},
};
use serde_json::json;
use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
};

/// The ratings of each event, in the folder that Psych-DS has for what was made of the data.
const RATINGS_FILE: &str = "products/ratings.json";

/// The file with the answers of a study: the one that is given, or that of the study's name in the folder of
/// a server.
fn file_of(config: &StudyConfig, answers: &Path) -> Result<PathBuf, CliError> {
    if !answers.is_dir() {
        return Ok(answers.to_owned());
    }
    let studies = answers.join("studies");
    let folder = if studies.is_dir() { studies } else { answers.to_owned() };
    let file = folder.join(format!("{}.sqlite", config.name));
    if file.is_file() {
        return Ok(file);
    }
    let listed = fs::read_dir(&folder).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let listed = listed.map_err(|error| {
        CliError::File(FileError { file: folder.clone(), problem: Problem::Unreadable(error) })
    })?;
    let is_answers = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "sqlite");
    let mut others: Vec<String> = listed
        .iter()
        .map(fs::DirEntry::path)
        .filter(is_answers)
        .filter_map(|path| path.file_stem().map(|name| name.to_string_lossy().into_owned()))
        .collect();
    others.sort();
    let there = if others.is_empty() { "of no study".into() } else { format!("of {}", others.join(", ")) };
    let folder = folder.display();
    let name = &config.name;
    Err(CliError::Usage(format!(
        "--answers: {folder} has no answers of the study {name}; it has those {there}"
    )))
}

/// The raters of a study.
fn raters(config: &StudyConfig, forms: &Forms, answers: &Path) -> Result<Vec<Rater>, CliError> {
    let answers = &file_of(config, answers)?;
    let read = Answers::read(answers, config, forms).map_err(CliError::Answers)?;
    if let Some(log) = read.missing_log {
        // Also with --quiet: what follows may be wrong.
        print_message(format!(
            "warning: {}: answers may be missing: it was written with a log, {}, that is not there",
            answers.display(),
            log.display()
        ));
    }
    Ok(read.raters)
}

/// Copies the answers of a study, which may be under way.
pub(super) fn backup(arguments: &BackupStudy) -> Result<(), CliError> {
    let (from, out) = (&arguments.answers, &arguments.out);
    if out.exists() {
        return Err(CliError::Usage(format!("--out: {} exists; choose another file", out.display())));
    }
    let failed = |action| move |source| CliError::Output(WriteError { path: out.clone(), action, source });
    let Some(name) = out.file_name() else {
        return Err(CliError::Usage(format!("--out: {} is not a file", out.display())));
    };
    // Under its name it is whole.
    let mut hidden = OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.part", std::process::id()));
    let part = out.with_file_name(hidden);
    private::options().write(true).create_new(true).open(&part).map_err(failed("write"))?;
    let of_copy = |error: StoreError| {
        // Nobody knows the hidden file.
        let file = if error.file == part { out.clone() } else { error.file };
        CliError::Answers(StoreError { file, ..error })
    };
    let copied = copy(from, &part).map_err(of_copy).and_then(|()| {
        regular::open(&part)?.sync_all().map_err(failed("write"))?;
        fs::rename(&part, out).map_err(failed("name"))
    });
    if copied.is_err() {
        // What cannot be removed is harmless, and the first error tells more.
        let _ = fs::remove_file(&part);
    }
    copied?;
    let text = format!("{}: a copy of {}", out.display(), from.display());
    arguments.output.print(text, &json!({ "file": told(out), "answers": told(from) }))
}

/// Creates a folder for what raters said.
fn folder(path: &Path) -> Result<(), CliError> {
    let failed =
        |source| CliError::Output(WriteError { path: path.to_owned(), action: "create the folder", source });
    private::create_folder(path).map_err(failed)
}

pub(super) fn export(arguments: &ExportStudy) -> Result<(), CliError> {
    let out = &arguments.out;
    let (config, forms) = read(&arguments.config)?;
    let raters = raters(&config, &forms, &arguments.answers)?;
    let ratings = ratings(&config, &raters);
    let files = psych_ds(&config, &forms, &raters, arguments.external_ids);
    let new = NewFolder::create_private(out).map_err(RunError::Folder)?;
    for file in &files {
        new.write(&file.path, file.text.as_bytes()).map_err(CliError::Output)?;
    }
    let rated =
        ratings.as_ref().map_or(0, |ratings| ratings["ratings"].as_object().map_or(0, serde_json::Map::len));
    if let Some(ratings) = ratings.filter(|_| rated > 0) {
        new.write(RATINGS_FILE, format!("{ratings:#}\n").as_bytes()).map_err(CliError::Output)?;
    }
    new.commit().map_err(RunError::Folder)?;
    let file = out.join(RATINGS_FILE);
    let paths: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
    let rated_file = (rated > 0).then_some(&file);
    let rated_file = rated_file.map(|file| told(file));
    let value = json!({ "folder": told(out), "files": paths, "ratings": rated_file, "rated": rated });
    let mut text = format!("{} files in {}", files.len(), out.display());
    if rated > 0 {
        text += &format!("\nratings of {rated} events for eval goals --ratings in {}", file.display());
    }
    arguments.output.print(text, &value)
}

pub(super) fn report(arguments: &ReportStudy) -> Result<(), CliError> {
    let out = &arguments.out;
    surroundings::check_itself(out).map_err(CliError::Usage)?;
    let (config, forms) = read(&arguments.config)?;
    let analysis = Analysis::of(&config, &forms, &raters(&config, &forms, &arguments.answers)?);
    let document = document(&config.title, &analysis);
    folder(out)?;
    let write =
        |name: &str, text: &str| atomic::write(&out.join(name), text.as_bytes()).map_err(CliError::Output);
    for (file, svg) in document.plots() {
        write(file, svg)?;
    }
    write("report.md", &document.to_markdown())?;
    write("report.html", &document.to_html())?;
    atomic::write_json(&out.join("analysis.json"), &analysis).map_err(CliError::Output)?;
    let text = format!("{}\nreport in {}", document.first_table(), out.display());
    arguments.output.print(text, &analysis)
}
