//! `results`: rewrites the documents that show results from `data/results.json`, which `benchmark --figures`
//! wrote.

use crate::{error::XtaskError, leaderboard};
use clap::Args;
use phase_cli::{error::CliError, output::print_result};
use phase_eval::{benchmark::Benchmark, goals::ReportTraining};
use phase_files::{FileError, Problem, WriteError, atomic};
use phase_report::evaluation;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// The benchmark's figures.
const FIGURES: &str = "data/results.json";
/// The record of the fit of the model of reports.
const REPORT_TRAINING: &str = "data/report-model.training.json";
/// The page of all results.
const PAGE: &str = "docs/results/overview.md";
/// The description of PHASE-Questions 1.0, as `questions` wrote it, and its page.
const QUESTIONS: [&str; 2] = ["data/questions.json", "docs/results/questions.md"];
/// The first page, with the most important ones between two comments.
const README: &str = "README.md";
/// Lines before and after its table.
const MARKS: [&str; 2] =
    ["<!-- Written by `cargo xtask results`. -->\n", "<!-- End of what `cargo xtask results` writes. -->\n"];

/// Options of `results`.
#[derive(Args, Debug)]
pub struct Results {
    /// Write nothing, and fail if a document is not what would be written
    #[arg(long)]
    pub check: bool,
}

/// Rewrites the documents of the workspace that this program was built from, or compares them.
///
/// # Errors
/// [`XtaskError`] if a file cannot be used, or, with `--check`, if one differs.
pub fn run(options: &Results) -> Result<(), XtaskError> {
    let root = root();
    let mut different = 0;
    for (file, text) in documents(root)? {
        let path = root.join(&file);
        if fs::read_to_string(&path).is_ok_and(|there| there == text) {
            continue;
        }
        different += 1;
        if !options.check {
            atomic::write(&path, text.as_bytes()).map_err(CliError::Output)?;
        }
        print_result(format!("{}: {}", file.display(), if options.check { "differs" } else { "rewritten" }))?;
    }
    match different {
        0 => print_result("the documents have the figures of data/results.json")?,
        count if options.check => return Err(XtaskError::Results(count)),
        _ => {}
    }
    Ok(())
}

/// The workspace that this program was built from.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// The documents as they must be: paths relative to the workspace, and contents.
///
/// # Errors
/// [`XtaskError`] if a file cannot be used.
pub fn documents(root: &Path) -> Result<Vec<(PathBuf, String)>, XtaskError> {
    let benchmark = benchmark(root)?;
    let figures = evaluation::to_lines(&evaluation::figures(&benchmark))
        .map_err(|error| CliError::Output(WriteError::json(Path::new(FIGURES), error)))?;
    check_protocols(root, &benchmark)?;
    let page = evaluation::page(&benchmark)
        .map_err(|error| CliError::Usage(format!("{FIGURES}: the page lacks a figure: {error}")))?;
    let readme = with_table(&read(&root.join(README))?, &evaluation::overview(&benchmark).to_markdown());
    let readme = readme.ok_or_else(|| shape(&root.join(README), "has no place for the table of results"))?;
    let pictures = page.pictures.into_iter().map(|(picture, svg)| (Path::new("docs").join(picture), svg));
    let leaderboard = leaderboard::page(root, &benchmark)?;
    let asked: evaluation::AskedQuestions = read_json(&root.join(QUESTIONS[0]))?;
    let texts = [
        (QUESTIONS[1].into(), evaluation::questions_page(&asked)),
        (PathBuf::from(FIGURES), figures),
        (PAGE.into(), page.text),
        (README.into(), readme),
        (leaderboard::PAGE.into(), leaderboard),
    ];
    Ok(texts.into_iter().chain(pictures).collect())
}

/// The benchmark whose figures are shown.
pub(crate) fn benchmark(root: &Path) -> Result<Benchmark, XtaskError> {
    read_json(&root.join(FIGURES))
}

/// Checks that no agreement with people is labelled as something else than it is: the record of the fit has
/// both that of the model itself and that of folds held out.
fn check_protocols(root: &Path, benchmark: &Benchmark) -> Result<(), XtaskError> {
    let record: ReportTraining = read_json(&root.join(REPORT_TRAINING))?;
    for row in &benchmark.goals {
        record.check(&row.summary).map_err(|error| {
            let set = benchmark.sets.get(row.set).map_or("", |set| &set.label);
            shape(&root.join(FIGURES), &format!("{} on {set} events: {error}", row.method))
        })?;
    }
    Ok(())
}

/// A text with a table between the two marks; `None` without them.
fn with_table(text: &str, table: &str) -> Option<String> {
    let (before, rest) = text.split_once(MARKS[0])?;
    let (_, after) = rest.split_once(MARKS[1])?;
    Some(format!("{before}{}\n{table}\n{}{after}", MARKS[0], MARKS[1]))
}

fn read(file: &Path) -> Result<String, XtaskError> {
    fs::read_to_string(file).map_err(XtaskError::unreadable(file))
}

pub(crate) fn read_json<T: serde::de::DeserializeOwned>(file: &Path) -> Result<T, XtaskError> {
    serde_json::from_str(&read(file)?).map_err(|error| shape(file, &error.to_string()))
}

pub(crate) fn shape(file: &Path, rule: &str) -> XtaskError {
    let problem = Problem::Shape { what: "document", rule: rule.into() };
    CliError::File(FileError { file: file.to_owned(), problem }).into()
}
