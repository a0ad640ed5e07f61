//! `render`: events as videos, or as pictures of their key frames.

use crate::{
    context::Context, error::CliError, interrupt, look::LookOptions, output::Output, parallel::Jobs,
};
use clap::{Args, ValueEnum, value_parser};
use phase_model::AgentId;
use phase_runs::render::{Rendered, Rendering, View};
use std::path::PathBuf;

/// Options of `render`.
#[derive(Args, Debug)]
pub struct Render {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub file: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// Folder for the results, or for a single event a file ending in .mp4 (.png with --contact-sheet)
    #[arg(long, value_name = "DIR|FILE", default_value = "out/render")]
    pub out: PathBuf,
    /// Overlay what agent 0 or 1 sees and believes, or both side by side, and explain its actions below
    /// (simulated events only). Videos of a dataset with an overlay get a page to watch them
    #[arg(long, value_name = "AGENT")]
    pub belief: Option<Belief>,
    /// Show below the picture what SIMPLE makes of the event while it watches it: goals, relation, who helps
    /// or hinders whom, and how people would report it; and write all of it to a file ending in
    /// .observer.json beside the video
    #[arg(long, conflicts_with = "belief")]
    pub observer: bool,
    /// Random seed of the observer
    #[arg(long, value_name = "S", default_value_t = 1, requires = "observer", conflicts_with = "belief")]
    pub seed: u64,
    /// Look of the pictures; contact sheets have their own size.
    #[command(flatten)]
    pub look: LookOptions,
    /// Instead of a video, one picture of N frames, 1 to 100, evenly spaced over the event
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=100),
        conflicts_with_all = ["size", "frame_rate"])]
    pub contact_sheet: Option<u16>,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Whose beliefs `render` shows.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum Belief {
    /// Agent 0's.
    #[value(name = "0", help = "agent 0")]
    First,
    /// Agent 1's.
    #[value(name = "1", help = "agent 1")]
    Second,
    /// Both agents', side by side.
    #[value(name = "both", help = "both agents side by side")]
    Both,
}

impl Render {
    fn view(&self) -> View {
        match self.belief {
            _ if self.observer => View::Observer(self.seed),
            None => View::World,
            Some(Belief::First) => View::Belief(AgentId::ZERO),
            Some(Belief::Second) => View::Belief(AgentId::ONE),
            Some(Belief::Both) => View::Beliefs,
        }
    }
}

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Render, context: &Context) -> Result<(), CliError> {
    let rendering = Rendering {
        events: arguments.file.clone(),
        ids: arguments.id.clone(),
        out: arguments.out.clone(),
        view: arguments.view(),
        look: arguments.look.into(),
        contact_sheet: arguments.contact_sheet.map(usize::from),
        threads: arguments.jobs.given(),
    };
    interrupt::listen();
    let made = rendering.run(context)?;
    let mut lines = made.files.iter().map(line).collect::<String>();
    if let Some(page) = &made.page {
        lines += &format!("open {} to watch them\n", page.display());
    }
    arguments.output.print(lines, &made)
}

fn line(made: &Rendered) -> String {
    let note = if made.interpolated { " (frames interpolated between recorded steps)" } else { "" };
    let mut lines = format!("{}{note}\n", made.file.display());
    if let Some(observer) = &made.observer {
        let ms = |seconds: f64| 1000.0 * seconds;
        lines += &format!(
            "{} ({:.0} ms a step, {:.0} ms the slowest)\n",
            observer.file.display(),
            ms(observer.mean_step_seconds),
            ms(observer.slowest_step_seconds)
        );
    }
    lines
}
