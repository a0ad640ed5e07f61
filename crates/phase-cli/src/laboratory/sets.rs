//! Commands on sets of stimuli: `rdm`, `match` and `pack`.

use crate::{
    address, context::Context, error::CliError, interrupt, laboratory::within, named::named, output::Output,
    parallel::Jobs, surroundings,
};
use clap::{Args, ValueEnum, value_parser};
use phase_laboratory::{
    platform::Platform,
    representation::{Distance, Rank, Similarity},
};
use phase_model::EventKind;
use phase_runs::{
    laboratory::{Correlation, MEASURES, MatrixRun, Pack, Pairing, Source},
    words,
};
use serde_json::json;
use std::{fmt::Write as _, path::PathBuf};

/// Options of `rdm`.
#[derive(Args, Debug)]
pub struct MatrixOptions {
    /// Features: results.json of `eval goals`, phase-ratings/1, or a table (.tsv or .csv) of features by
    /// stimulus; of a table, COLUMNS is what the names of the columns begin with
    #[arg(value_name = "[NAME=]FILE[:COLUMNS]", required = true)]
    pub sources: Vec<String>,
    /// Only the stimulus with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Dissimilarity of two stimuli
    #[arg(
        long,
        value_name = "DISTANCE",
        default_value = "euclidean",
        value_parser = named(Distance::ALL, Distance::name)
    )]
    pub distance: Distance,
    /// Correlation of two matrices
    #[arg(long, value_name = "RANK", default_value = "spearman")]
    pub correlation: RankName,
    /// The matrix that the others are to explain, such as that of people: semipartial correlations are shown
    #[arg(long, value_name = "NAME")]
    pub target: Option<String>,
    /// Random seed of the intervals
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Folder for the matrices
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// A rank correlation.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum RankName {
    /// Spearman's
    Spearman,
    /// Kendall's
    Kendall,
}

/// A source as it is written on the command line.
fn source(text: &str) -> Source {
    let (name, file) = match text.split_once('=') {
        Some((name, file)) => (Some(name), file),
        None => (None, text),
    };
    // A colon in a folder's name, or of a drive of Windows, is no separator.
    let (file, columns) = match file.rsplit_once(':') {
        Some((path, columns)) if path.ends_with(".tsv") || path.ends_with(".csv") => (path, columns),
        _ => (file, ""),
    };
    let file = PathBuf::from(file);
    let stem = || file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    Source { name: name.map_or_else(stem, str::to_owned), columns: columns.to_owned(), file }
}

/// Runs `rdm`.
///
/// # Errors
/// Any [`CliError`].
pub fn matrices(arguments: &MatrixOptions, context: &Context) -> Result<(), CliError> {
    surroundings::check_itself(&arguments.out).map_err(CliError::Usage)?;
    let sources: Vec<Source> = arguments.sources.iter().map(|text| source(text)).collect();
    for Source { file, .. } in &sources {
        if surroundings::is_in(file, &arguments.out) {
            let (out, file) = (arguments.out.display(), file.display());
            let rule = format!("has the input {file}, which a matrix might replace; choose another folder");
            return Err(CliError::Usage(format!("--out {out}: {rule}")));
        }
    }
    let run = MatrixRun {
        sources,
        ids: arguments.id.clone(),
        distance: arguments.distance,
        rank: match arguments.correlation {
            RankName::Spearman => Rank::Spearman,
            RankName::Kendall => Rank::Kendall,
        },
        target: arguments.target.clone(),
        seed: arguments.seed,
        out: arguments.out.clone(),
    };
    let made = run.run(context)?;
    let mut text = format!(
        "{} of {} in {}\n\n",
        words::counted(made.names.len(), "matrix", "matrices"),
        words::counted(made.stimuli.len(), "stimulus", "stimuli"),
        arguments.out.display()
    );
    if !made.correlations.is_empty() {
        text += "| | | correlation | semipartial |\n|---|---|---|---|\n";
    }
    let shown = |similarity: Option<Similarity>| {
        similarity
            .map_or_else(|| "–".to_owned(), |it| format!("{:.3} [{:.3}, {:.3}]", it.value, it.low, it.high))
    };
    for Correlation { one, other, correlation, unique } in &made.correlations {
        let _ = writeln!(text, "| {one} | {other} | {} | {} |", shown(*correlation), shown(*unique));
    }
    for (name, ceiling) in &made.ceilings {
        let ceiling = ceiling.map_or_else(|| "–".to_owned(), |ceiling| format!("{ceiling:.3}"));
        let _ =
            writeln!(text, "\nNoise ceiling of {name} (halves of the raters, corrected to all): {ceiling}");
    }
    let value = json!({
        "matrices": made.names,
        "stimuli": made.stimuli,
        "correlations": made.correlations,
        "ceilings": made.ceilings,
    });
    arguments.output.print(text, &value)
}

/// Options of `match`.
#[derive(Args, Debug)]
pub struct PairingOptions {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Measures to match on, separated by commas: length, path, speed, acceleration, distance, contact,
    /// motion_energy
    #[arg(long, value_name = "MEASURES", value_delimiter = ',', default_value = "speed,path,contact,length")]
    pub on: Vec<String>,
    /// Only events of this kind; may be given several times
    #[arg(long, value_name = "KIND", value_parser = named(EventKind::ALL, EventKind::name))]
    pub kind: Vec<EventKind>,
    /// Most that two events of a group may differ in a measure, 0 to 100 standard deviations
    #[arg(long, value_name = "C", default_value_t = 0.5, value_parser = within::<0, 100>)]
    pub caliper: f64,
    /// Folder for the groups
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Runs `match`.
///
/// # Errors
/// Any [`CliError`].
pub fn pairing(arguments: &PairingOptions, context: &Context) -> Result<(), CliError> {
    surroundings::check_itself(&arguments.out).map_err(CliError::Usage)?;
    interrupt::listen();
    let run = Pairing {
        events: arguments.events.clone(),
        ids: arguments.id.clone(),
        on: arguments.on.clone(),
        kinds: arguments.kind.iter().map(|kind| kind.name().to_owned()).collect(),
        caliper: arguments.caliper,
        out: arguments.out.clone(),
        threads: arguments.jobs.threads(),
    };
    let matched = run.run(context)?;
    let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |value| format!("{value:.3}"));
    let unit = |name: &str| MEASURES.iter().find(|(known, _)| *known == name).map_or("", |(_, unit)| unit);
    let mut text = format!(
        "{} of one event of each kind in {}\n\n| measure | kind | events | mean before | after | sd before | after |\n|---|---|---|---|---|---|---|\n",
        words::counted(matched.groups.len(), "group", "groups"),
        arguments.out.display()
    );
    for row in &matched.balance {
        let [before, after] = row.events;
        let _ = writeln!(
            text,
            "| {} ({}) | {} | {before} → {after} | {} | {} | {} | {} |",
            row.measure,
            unit(&row.measure),
            row.kind,
            number(row.mean[0]),
            number(row.mean[1]),
            number(row.sd[0]),
            number(row.sd[1])
        );
    }
    text += "\n| measure | greatest difference of means (sd) before | after |\n|---|---|---|\n";
    for row in &matched.differences {
        let _ = writeln!(
            text,
            "| {} | {} | {} |",
            row.measure,
            number(row.standardised[0]),
            number(row.standardised[1])
        );
    }
    arguments.output.print(text, &matched)
}

/// Options of `pack`.
#[derive(Args, Debug)]
pub struct PackOptions {
    /// Folder of a finished dataset, or of `clip`
    #[arg(value_name = "DIR")]
    pub from: PathBuf,
    /// Only the event or clip with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// The platform
    #[arg(long = "for", value_name = "PLATFORM", value_parser = named(Platform::ALL, Platform::name))]
    pub platform: Platform,
    /// Lists, 1 to 1000, each for some of the participants
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=1000))]
    pub lists: u16,
    /// Attention checks in every list, 0 to 100
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = value_parser!(u16).range(0..=100))]
    pub checks: u16,
    /// Address of the folder of videos, https:// or http://, for qualtrics and children-helping-science
    #[arg(long, value_name = "URL", value_parser = address::folder)]
    pub address: Option<String>,
    /// Random seed of the order
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Folder for the pack, new or empty
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs `pack`.
///
/// # Errors
/// Any [`CliError`].
pub fn pack(arguments: &PackOptions, context: &Context) -> Result<(), CliError> {
    let hosted = matches!(arguments.platform, Platform::Qualtrics | Platform::ChildrenHelpingScience);
    let address = match (&arguments.address, hosted) {
        (Some(address), true) => address.trim_end_matches('/').to_owned(),
        (None, false) => String::new(),
        (None, true) => {
            let name = arguments.platform.name();
            return Err(CliError::Usage(format!(
                "--address: {name} loads videos from elsewhere; give the address of their folder"
            )));
        }
        (Some(_), false) => {
            let name = arguments.platform.name();
            return Err(CliError::Usage(format!(
                "--address: {name} has videos in the pack and needs no address"
            )));
        }
    };
    let run = Pack {
        from: arguments.from.clone(),
        ids: arguments.id.clone(),
        platform: arguments.platform,
        lists: arguments.lists.into(),
        checks: arguments.checks.into(),
        address,
        seed: arguments.seed,
        out: arguments.out.clone(),
    };
    let packed = run.run(context)?;
    let videos = words::counted(packed.videos, "video", "videos");
    let lists = words::counted(packed.trials.len(), "list", "lists");
    let text = format!("{videos}, {lists} in {}", arguments.out.display());
    arguments
        .output
        .print(text, &json!({ "videos": packed.videos, "trials": packed.trials, "files": packed.files }))
}

#[cfg(test)]
mod tests {
    use super::source;

    #[test]
    fn a_source_has_a_name_a_file_and_columns() {
        let of = |text| {
            let source = source(text);
            (source.name, source.file.to_string_lossy().into_owned(), source.columns)
        };
        let texts = |a: &str, b: &str, c: &str| (a.to_owned(), b.to_owned(), c.to_owned());
        assert_eq!(of("people=ratings.json"), texts("people", "ratings.json", ""));
        assert_eq!(of("out/a.tsv:relation_"), texts("a", "out/a.tsv", "relation_"));
        assert_eq!(of("x=C:/a/b.csv"), texts("x", "C:/a/b.csv", ""));
        assert_eq!(of("a:b.json"), texts("a:b", "a:b.json", ""));
    }
}
