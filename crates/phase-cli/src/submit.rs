//! `submit`: checks and scores the answers of a method, and writes the files of a pull request for the
//! leaderboard.

use crate::{address, context::Context, error::CliError, interrupt, output::Output};
use clap::Args;
use phase_report::evaluation::Measures;
use phase_runs::leaderboard::{Sealed, Submission, Submitted};
use std::path::PathBuf;

/// Options of `submit`.
#[derive(Args, Debug)]
pub struct Submit {
    /// File of predictions, with answers to one or both tasks (docs/how-to/method.md)
    #[arg(value_name = "PREDICTIONS")]
    pub predictions: PathBuf,
    /// The events: the folder of PHASE-500 or of phase-pairs, or the file of the recordings
    #[arg(long, value_name = "DIR|FILE")]
    pub events: PathBuf,
    /// Folder that `seal` published: the predictions are about its events, --events is what was sealed
    #[arg(long, value_name = "DIR")]
    pub sealed: Option<PathBuf>,
    /// Folder of the questions, if they were sealed, too
    #[arg(long, value_name = "DIR", requires = "sealed")]
    pub questions: Option<PathBuf>,
    /// Name of the method [default: that of the file]
    #[arg(long, value_name = "NAME")]
    pub method: Option<String>,
    /// The authors
    #[arg(long, value_name = "NAMES")]
    pub by: String,
    /// Address of the code, or of a description of the method, https:// or http://
    #[arg(long, value_name = "ADDRESS", value_parser = address::page)]
    pub source: String,
    /// Checkout of PHASE, or another folder, to write the files of the pull request into
    #[arg(long, value_name = "DIR", default_value = "out/submission")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Submit, context: &Context) -> Result<(), CliError> {
    interrupt::listen();
    let Submit { predictions, events, sealed, questions, method, by, source, out, output } = arguments;
    let sealed = sealed.clone().map(|published| Sealed { published, questions: questions.clone() });
    let submission = Submission {
        predictions: predictions.clone(),
        events: events.clone(),
        sealed,
        method: method.clone(),
        by: by.clone(),
        source: source.clone(),
        out: out.clone(),
    };
    let submitted = submission.submit(context)?;
    output.print(text(&submitted), &submitted)
}

fn text(submitted: &Submitted) -> String {
    let scores = submitted.scores.iter().map(|score| match &score.measures {
        Measures::Goals { top1, relation, whole_sets } => {
            let sets = whole_sets.map_or_else(String::new, |sets| format!(", whole sets {:.3}", sets.value));
            format!("{}: goals {:.3}, relations {:.3}{sets}\n", score.set, top1.value, relation.value)
        }
        Measures::Trajectories { ade, fde } => {
            format!("{}: ADE {:.2} u, FDE {:.2} u\n", score.set, ade.value, fde.value)
        }
    });
    let other = if submitted.same_events {
        ""
    } else {
        "The events are not, byte for byte, those of the other scores: another version or other settings made \
         them. The scores that count are those that the workflow of the pull request finds.\n"
    };
    let files = submitted.files.iter().map(|file| format!("{}\n", file.display()));
    let scores: String = scores.collect();
    format!("{scores}{other}Open a pull request with these files:\n{}", files.collect::<String>())
}
