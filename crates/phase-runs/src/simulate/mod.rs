//! Simulation of the scenes of a `phase-events/1` file or of a folder, each from its first row and with one
//! or several seeds.

mod gallery;

use crate::{
    effort::{self, Effort},
    engine::{self, GENERATOR},
    error::RunError,
    event_writer::{EventFiles, EventJob, EventWriter, settings_value},
    listener::Listener,
    parallel::{self, make_all},
    resume::is_finished,
    source::{EventInput, labels_and_rows},
    words,
};
use gallery::Shown;
use phase_dataset::summary::{MeasuredPair, SUMMARY_FILE, SimulationSummary};
use phase_event::Recording;
use phase_files::{
    folder::{self, Folder},
    run::{self, Run},
};
use phase_sim::SimulationSettings;
use serde_json::{Value, json};
use std::path::PathBuf;

/// An event of the input: its index there, and its recording without additional data of an earlier
/// simulation.
type Input = (usize, Recording);

/// Scenes to be simulated.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Simulations {
    /// A file in the format `phase-events/1`, or the folder of a dataset or of simulations.
    pub events: PathBuf,
    /// Only the events with these ids; all if empty.
    pub ids: Vec<String>,
    /// First seed, of events without their own.
    pub seed: u64,
    /// Number of seeds for each scene, at least 1; with more than one, ids end in `-seedK`.
    pub seeds: u16,
    /// Whether the seed of each event is drawn from `seed` alone, and not also from its place in the file.
    pub same_chance: bool,
    /// Whether there are videos, and a page to watch them.
    pub videos: bool,
    /// Folder for the results: new, empty, or of the same simulations.
    pub out: PathBuf,
    /// Engine, minds, and their search.
    pub effort: Effort,
    /// Number of threads; without it that of this machine's cores.
    pub threads: Option<usize>,
}

/// Simulations that are there.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// Their summary.
    pub summary: SimulationSummary,
    /// Whether they were made now.
    pub is_new: bool,
}

impl Simulations {
    /// All events of a file or folder once, with videos in a folder, on all cores.
    #[must_use]
    pub fn new(events: impl Into<PathBuf>, out: impl Into<PathBuf>) -> Self {
        Self {
            events: events.into(),
            ids: Vec::new(),
            seed: 1,
            seeds: 1,
            same_chance: false,
            videos: true,
            out: out.into(),
            effort: Effort::default(),
            threads: None,
        }
    }

    /// Simulates the scenes, goes on with what an interrupted run has left, or finds that they are there.
    ///
    /// # Errors
    /// If the events or the folder cannot be used, a scene cannot be simulated, a file cannot be written, or
    /// a stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<Simulated, RunError> {
        let settings = self.effort.settings()?;
        let chosen = inputs(self, listener)?;
        let seeds = seeds(self)?;
        check_ids(self, &chosen, &seeds)?;
        let run = run_of(self, &settings, &chosen)?;
        let out = &self.out;
        if is_finished(out, SUMMARY_FILE, &run, listener)? {
            return finished(self, &run);
        }
        listener.detail(&format!("seed {}: {}", self.seed, effort::description(&settings)));
        let folder = Folder::claim(out, &run)?;
        let events = chosen.len() * seeds.len();
        let activity = format!("simulating {}", words::events(events));
        let event_writer = EventWriter::new(listener, &activity, &folder, settings, events)?;
        let made = make_all(parallel::threads(self.threads), events, |k| {
            let (index, recording) = &chosen[k / seeds.len()];
            make(&event_writer, self, *index, recording, seeds[k % seeds.len()])
        })?;
        drop(event_writer);
        let Some(made) = made else { return Err(RunError::Interrupted(out.clone())) };
        let (pairs, shown): (Vec<_>, Vec<_>) = made.into_iter().unzip();
        if self.videos {
            gallery::write(out, self.seed, shown)?;
        }
        let summary = SimulationSummary::new(run.value().clone(), pairs);
        summary.write(&out.join(SUMMARY_FILE))?;
        folder.finish()?;
        Ok(Simulated { summary, is_new: true })
    }
}

/// The events to simulate, in the order of the input.
fn inputs(simulations: &Simulations, listener: &dyn Listener) -> Result<Vec<Input>, RunError> {
    let source = EventInput::open(&simulations.events, &simulations.ids, listener)?;
    let input =
        |k: usize| Ok((source.place(k), Recording { simulation: None, ..source.load(k)?.into_owned() }));
    (0..source.len()).map(input).collect()
}

fn make(
    event_writer: &EventWriter,
    simulations: &Simulations,
    index: usize,
    recording: &Recording,
    seed: u64,
) -> Result<Option<(MeasuredPair, Shown)>, RunError> {
    let id = simulated_id(simulations, recording, seed);
    let job = EventJob {
        id: id.clone(),
        seed: event_seed(simulations, index, recording, seed),
        relation: Some(recording.relation),
        lengths: None,
        json: format!("{id}.json"),
        video: simulations.videos.then(|| format!("{id}.mp4")),
    };
    let made = event_writer.make(&job, || Ok(recording.scene.clone()))?;
    let Some((event, EventFiles { json, video })) = made else { return Ok(None) };
    let pair = MeasuredPair::of(recording, id, seed, &event, (json, video));
    let shown = Shown::of(&pair.comparison, &event);
    Ok(Some((pair, shown)))
}

/// The seeds of the run, in order.
fn seeds(simulations: &Simulations) -> Result<Vec<u64>, RunError> {
    let last = simulations.seed.checked_add(u64::from(simulations.seeds) - 1).ok_or_else(|| {
        RunError::Usage(format!(
            "--seed {} leaves no room for --seeds {}: the last one would exceed {}",
            simulations.seed,
            simulations.seeds,
            u64::MAX
        ))
    })?;
    Ok((simulations.seed..=last).collect())
}

/// The seed of a simulated event. An event without its own seed gets one by its index in the file, so that
/// the result is the same with or without the other events; with `--same-chance` all get that of the first.
/// Own seeds are incremented with `--seeds`.
fn event_seed(simulations: &Simulations, index: usize, recording: &Recording, seed: u64) -> u64 {
    match recording.seed {
        Some(own) => own.wrapping_add(seed - simulations.seed),
        None => engine::event_seed(seed, if simulations.same_chance { 0 } else { index }),
    }
}

/// The id of a simulated event: the recording's, with the seed appended if there are several.
fn simulated_id(simulations: &Simulations, recording: &Recording, seed: u64) -> String {
    if simulations.seeds > 1 { format!("{}-seed{seed}", recording.id) } else { recording.id.clone() }
}

/// Ids of simulated events are names of files that are read again, so they must be usable as such.
fn check_ids(simulations: &Simulations, chosen: &[Input], seeds: &[u64]) -> Result<(), RunError> {
    for (_, recording) in chosen {
        for &seed in seeds {
            let id = simulated_id(simulations, recording, seed);
            let rule = if id == SUMMARY_FILE.trim_end_matches(".json") {
                "is taken: the summary is written under that name".into()
            } else if id.len() > phase_event::LONGEST_ID {
                format!(
                    "must leave room for the seed: {id} has more than {} letters",
                    phase_event::LONGEST_ID
                )
            } else {
                continue;
            };
            let file = simulations.events.display();
            return Err(RunError::Usage(format!("{file}: event {}: field `id` {rule}", recording.id)));
        }
    }
    Ok(())
}

/// Everything that determines the results: the events themselves and not the file they came in, the seeds,
/// the settings.
fn run_of(
    simulations: &Simulations,
    settings: &SimulationSettings,
    chosen: &[Input],
) -> Result<Run, RunError> {
    let events = chosen.iter().map(|(index, recording)| json!([index, recording.id])).collect();
    let read = chosen.iter().map(|(index, recording)| {
        Ok(json!([index, recording.id, recording.seed, labels_and_rows(recording)?]))
    });
    let read = read.collect::<Result<Value, RunError>>()?;
    Ok(Run::new([
        ("command", "simulate".into()),
        ("generator", GENERATOR.into()),
        ("seed", simulations.seed.into()),
        ("seeds", simulations.seeds.into()),
        ("same_chance", simulations.same_chance.into()),
        ("videos", simulations.videos.into()),
        ("settings", settings_value(settings)?),
        ("events", Value::Array(events)),
        ("input_sha256", run::digest(&read).into()),
    ]))
}

fn finished(simulations: &Simulations, run: &Run) -> Result<Simulated, RunError> {
    let out = &simulations.out;
    let summary = SimulationSummary::read(&out.join(SUMMARY_FILE))?;
    run.check(out, "a finished", &summary.run)?;
    summary.verify(out).map_err(RunError::Altered)?;
    folder::remove_leftovers(out, run)?;
    Ok(Simulated { summary, is_new: false })
}
