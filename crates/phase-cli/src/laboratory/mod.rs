//! Commands that make events into stimuli: `clip`, `observe` and `aoi`, and those on sets of stimuli.

pub mod sets;

use crate::{
    context::Context, effort::MindOptions, error::CliError, interrupt, json_file, named::named,
    output::Output, parallel::Jobs,
};
use clap::{Args, ValueEnum, value_parser};
use phase_laboratory::clip::{Cut, steps_of};
use phase_render::PaletteName;
use phase_runs::laboratory::{AreaRun, ClipForm, ClipRun, Clips, Observation, ObservingMethod, Shorter};
use serde_json::json;
use std::{fmt::Write as _, path::PathBuf};

/// The part of every event that is meant.
#[derive(Args, Clone, Debug)]
pub struct Part {
    /// Length of a clip in seconds of video, 0 to 3600: a multiple of 0.25 above 0
    #[arg(long, value_name = "S", value_parser = within::<0, 3600>)]
    pub seconds: Option<f64>,
    /// Begin of the clips: `middle`, or seconds from the beginning, a multiple of 0.25
    #[arg(long, value_name = "middle|S", default_value = "middle", requires = "seconds")]
    pub at: String,
}

/// Reads a number that need not be whole.
pub(crate) fn within<const LOW: u32, const HIGH: u32>(text: &str) -> Result<f64, String> {
    let range = f64::from(LOW)..=f64::from(HIGH);
    let number = text.parse::<f64>().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("must be a number from {LOW} to {HIGH}"))
}

impl Part {
    /// The part, if not whole events are meant.
    fn cut(&self) -> Result<Option<Cut>, CliError> {
        let at = match self.at.as_str() {
            "middle" => None,
            text => Some(text.parse::<f64>().map_err(|_| {
                CliError::Usage(format!("--at {text}: must be `middle` or seconds, a multiple of 0.25"))
            })?),
        };
        let cut = |seconds| {
            Cut::of_seconds(seconds, at).map_err(|error| CliError::Usage(format!("--seconds, --at: {error}")))
        };
        self.seconds.map(cut).transpose()
    }
}

/// Options of `clip`.
#[derive(Args, Debug)]
pub struct ClipOptions {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// The part of every event.
    #[command(flatten)]
    pub part: Part,
    /// Folder for the clips; new, empty, or of the same command
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Forms of the clips, separated by commas: mp4, png (a folder of frames), gif
    #[arg(long = "as", value_name = "FORMS", value_delimiter = ',', default_value = "mp4")]
    pub forms: Vec<FormName>,
    /// Leave out what only this renderer draws, the dark bars of grips, so that recordings and generated
    /// events look alike
    #[arg(long)]
    pub plain: bool,
    /// Treatment of events that are shorter than a clip: refuse, or leave them out
    #[arg(long, value_name = "WHAT", default_value = "refuse")]
    pub shorter: ShorterName,
    /// Colours: as in the paper, or distinguishable with a colour vision deficiency
    #[arg(
        long,
        value_name = "PALETTE",
        default_value = PaletteName::Paper.name(),
        value_parser = named(PaletteName::ALL, PaletteName::name)
    )]
    pub palette: PaletteName,
    /// Side of the pictures in pixels, 64 to 2000, even for videos
    #[arg(long, value_name = "N", default_value_t = 480, value_parser = value_parser!(u32).range(64..=2000))]
    pub size: u32,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// A form of a clip.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum FormName {
    /// Video
    Mp4,
    /// Frames
    Png,
    /// Animated picture
    Gif,
}

/// Treatment of short events.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum ShorterName {
    /// Refuse
    Refuse,
    /// Leave out
    LeaveOut,
}

/// Runs `clip`.
///
/// # Errors
/// Any [`CliError`].
pub fn clip(arguments: &ClipOptions, context: &Context) -> Result<(), CliError> {
    let cut = arguments.part.cut()?;
    let cut = cut.ok_or_else(|| CliError::Usage("--seconds: is needed: how long a clip is to be".into()))?;
    let forms = arguments.forms.iter().map(|form| match form {
        FormName::Mp4 => ClipForm::Mp4,
        FormName::Png => ClipForm::Png,
        FormName::Gif => ClipForm::Gif,
    });
    let mut forms: Vec<ClipForm> = forms.collect();
    forms.sort_unstable();
    forms.dedup();
    if forms.contains(&ClipForm::Mp4) && arguments.size % 2 == 1 {
        return Err(CliError::Usage(format!("--size: must be even for videos, not {}", arguments.size)));
    }
    interrupt::listen();
    let run = ClipRun {
        events: arguments.events.clone(),
        ids: arguments.id.clone(),
        cut,
        shorter: match arguments.shorter {
            ShorterName::Refuse => Shorter::Refuse,
            ShorterName::LeaveOut => Shorter::LeaveOut,
        },
        out: arguments.out.clone(),
        forms,
        plain: arguments.plain,
        palette: arguments.palette,
        side: arguments.size,
        threads: arguments.jobs.threads(),
    };
    let Clips { clips, left_out, is_new } = run.run(context)?;
    let out = arguments.out.display();
    let mut text = match is_new {
        true => format!("{clips} clips in {out}\n"),
        false => format!("{out} holds these {clips} clips already\n"),
    };
    if !left_out.is_empty() {
        let _ = writeln!(text, "too short and left out: {}", left_out.join(", "));
    }
    arguments.output.print(text, &json!({ "clips": clips, "left_out": left_out, "new": is_new }))
}

/// Options of `observe`.
#[derive(Args, Debug)]
pub struct ObserveOptions {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// The part of every event.
    #[command(flatten)]
    pub part: Part,
    /// Length of a chunk (s of video, with or without `s`), a multiple of 0.25
    #[arg(long, value_name = "S", default_value = "2s")]
    pub every: String,
    /// Observing method: SIMPLE, or its intent network alone
    #[arg(long, value_name = "METHOD", default_value = "simple")]
    pub method: MethodName,
    /// The minds that SIMPLE imagines.
    #[command(flatten)]
    pub minds: MindOptions,
    /// Random seed of the observer
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// The table of a run, with the columns `onset` (s) and `stim_file`: regressors then have its times
    #[arg(long, value_name = "TSV")]
    pub presentations: Option<PathBuf>,
    /// Folder for the tables; new, empty, or of the same command
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// An observing method.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum MethodName {
    /// SIMPLE
    Simple,
    /// The intent network
    IntentNetwork,
}

/// Runs `observe`.
///
/// # Errors
/// Any [`CliError`].
pub fn observe(arguments: &ObserveOptions, context: &Context) -> Result<(), CliError> {
    let text = &arguments.every;
    let every = text.strip_suffix('s').unwrap_or(text).parse::<f64>().ok();
    let every = every.and_then(|seconds| steps_of(seconds).ok()).filter(|&steps| steps > 0);
    let every = every.ok_or_else(|| {
        CliError::Usage(format!("--every {text}: must be seconds above 0, a multiple of 0.25"))
    })?;
    interrupt::listen();
    let run = Observation {
        events: arguments.events.clone(),
        ids: arguments.id.clone(),
        cut: arguments.part.cut()?,
        every,
        method: match arguments.method {
            MethodName::Simple => ObservingMethod::Simple,
            MethodName::IntentNetwork => ObservingMethod::IntentNetwork,
        },
        minds: arguments.minds.into(),
        seed: arguments.seed,
        presentations: arguments.presentations.clone(),
        out: arguments.out.clone(),
        threads: arguments.jobs.threads(),
    };
    let observed = run.run(context)?;
    let lines: String =
        observed.files.iter().map(|file| format!("{}\n", arguments.out.join(file).display())).collect();
    let value = json!({ "files": observed.files, "chunks": observed.chunks, "new": observed.is_new });
    arguments.output.print(lines, &value)
}

/// Options of `aoi`.
#[derive(Args, Debug)]
pub struct AreaOptions {
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only the event with this id; may be given several times
    #[arg(long, value_name = "ID")]
    pub id: Vec<String>,
    /// The part of every event.
    #[command(flatten)]
    pub part: Part,
    /// Side of the pictures in pixels, 64 to 2000
    #[arg(long, value_name = "N", default_value_t = 480, value_parser = value_parser!(u32).range(64..=2000))]
    pub size: u32,
    /// The table to write
    #[arg(long, value_name = "CSV")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs `aoi`.
///
/// # Errors
/// Any [`CliError`].
pub fn areas(arguments: &AreaOptions, context: &Context) -> Result<(), CliError> {
    json_file::check("--out", &arguments.out, [&arguments.events])?;
    interrupt::listen();
    let run = AreaRun {
        events: arguments.events.clone(),
        ids: arguments.id.clone(),
        cut: arguments.part.cut()?,
        side: arguments.size,
        out: arguments.out.clone(),
    };
    let rows = run.run(context)?;
    arguments.output.print(format!("{rows} areas in {}", arguments.out.display()), &json!({ "areas": rows }))
}
