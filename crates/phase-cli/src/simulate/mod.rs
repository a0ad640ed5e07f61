//! `simulate`: the scenes of a `phase-events/1` file or of a folder, each from its first row and with one or several seeds.

mod gallery;
pub mod options;
mod outcomes;

use crate::{
    console,
    context::Context,
    engine::{self, GENERATOR},
    error::CliError,
    event_writer::{EventJob, EventWriter, settings_value},
    interrupt,
    parallel::make_all,
    source::{EventInput, labels_and_rows},
};
use gallery::Shown;
use options::Simulate;
use phase_dataset::{
    manifest::PAGE_FILE,
    summary::{MeasuredPair, SUMMARY_FILE, SimulationSummary},
};
use phase_event::Recording;
use phase_files::{
    folder::{self, Contents, Folder},
    run::{self, Run},
};
use phase_report::summary;
use serde_json::{Value, json};

/// An event of the input: its index there, and its recording without additional data of an earlier
/// simulation.
type Input = (usize, Recording);

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Simulate, context: &Context) -> Result<(), CliError> {
    let chosen = inputs(arguments, context)?;
    let seeds = seeds(arguments)?;
    check_ids(arguments, &chosen, &seeds)?;
    let settings = arguments.effort.settings()?;
    let run = run_of(arguments, &settings, &chosen)?;
    let out = &arguments.out;
    match folder::inspect(out, SUMMARY_FILE)? {
        Contents::Finished => return check_finished(arguments, &run),
        Contents::Unfinished(other) => {
            run.check(out, "an unfinished", &other)?;
            context.note(format!("continuing in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    interrupt::listen();
    context.detail(format!("seed {}: {}", arguments.seed, crate::effort::description(&settings)));
    let folder = Folder::claim(out, &run)?;
    let events = chosen.len() * seeds.len();
    let activity = format!("simulating {}", console::events(events));
    let event_writer = EventWriter::new(context, &activity, &folder, settings, events)?;
    let made = make_all(&arguments.jobs, events, |k| {
        let (index, recording) = &chosen[k / seeds.len()];
        make(&event_writer, arguments, *index, recording, seeds[k % seeds.len()])
    })?;
    drop(event_writer);
    let Some(made) = made else { return Err(CliError::Interrupted(out.clone())) };
    let (pairs, shown): (Vec<_>, Vec<_>) = made.into_iter().unzip();
    if !arguments.no_video {
        gallery::write(out, arguments.seed, shown)?;
    }
    let summary = SimulationSummary::new(run.value().clone(), pairs);
    summary.write(&out.join(SUMMARY_FILE))?;
    folder.finish()?;
    let line = format!("simulated {} in {}", console::events(summary.events.len()), out.display());
    print(arguments, &summary, &line, true)
}

/// The events to simulate, in the order of the input.
fn inputs(arguments: &Simulate, context: &Context) -> Result<Vec<Input>, CliError> {
    let source = EventInput::open(&arguments.events, &arguments.id, context)?;
    let input =
        |k: usize| Ok((source.place(k), Recording { simulation: None, ..source.load(k)?.into_owned() }));
    (0..source.len()).map(input).collect()
}

fn make(
    event_writer: &EventWriter,
    arguments: &Simulate,
    index: usize,
    recording: &Recording,
    seed: u64,
) -> Result<Option<(MeasuredPair, Shown)>, CliError> {
    let (id, out) = (simulated_id(arguments, recording, seed), &arguments.out);
    let video = !arguments.no_video;
    let job = EventJob {
        id: id.clone(),
        seed: event_seed(arguments, index, recording, seed),
        relation: Some(recording.relation),
        lengths: None,
        json: out.join(format!("{id}.json")),
        video: video.then(|| out.join(format!("{id}.mp4"))),
    };
    let Some(event) = event_writer.make(&job, || Ok(recording.scene.clone()))? else { return Ok(None) };
    let pair = MeasuredPair::of(out, recording, id, seed, &event, video).map_err(CliError::ReadBack)?;
    let shown = Shown::of(&pair.comparison, &event);
    Ok(Some((pair, shown)))
}

/// The seeds of the run, in order.
fn seeds(arguments: &Simulate) -> Result<Vec<u64>, CliError> {
    let last = arguments.seed.checked_add(u64::from(arguments.seeds) - 1).ok_or_else(|| {
        CliError::Usage(format!(
            "--seed {} leaves no room for --seeds {}: the last one would exceed {}",
            arguments.seed,
            arguments.seeds,
            u64::MAX
        ))
    })?;
    Ok((arguments.seed..=last).collect())
}

/// The seed of a simulated event. An event without its own seed gets one by its index in the file, so that
/// the result is the same with or without the other events; with `--same-chance` all get that of the first.
/// Own seeds are incremented with `--seeds`.
fn event_seed(arguments: &Simulate, index: usize, recording: &Recording, seed: u64) -> u64 {
    match recording.seed {
        Some(own) => own.wrapping_add(seed - arguments.seed),
        None => engine::event_seed(seed, if arguments.same_chance { 0 } else { index }),
    }
}

/// The id of a simulated event: the recording's, with the seed appended if there are several.
fn simulated_id(arguments: &Simulate, recording: &Recording, seed: u64) -> String {
    if arguments.seeds > 1 { format!("{}-seed{seed}", recording.id) } else { recording.id.clone() }
}

/// Ids of simulated events are names of files that are read again, so they must be usable as such.
fn check_ids(arguments: &Simulate, chosen: &[Input], seeds: &[u64]) -> Result<(), CliError> {
    for (_, recording) in chosen {
        for &seed in seeds {
            let id = simulated_id(arguments, recording, seed);
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
            let file = arguments.events.display();
            return Err(CliError::Usage(format!("{file}: event {}: field `id` {rule}", recording.id)));
        }
    }
    Ok(())
}

/// Everything that determines the results: the events themselves and not the file they came in, the seeds,
/// the settings.
fn run_of(
    arguments: &Simulate,
    settings: &phase_sim::SimulationSettings,
    chosen: &[Input],
) -> Result<Run, CliError> {
    let events = chosen.iter().map(|(index, recording)| json!([index, recording.id])).collect();
    let read = chosen.iter().map(|(index, recording)| {
        Ok(json!([index, recording.id, recording.seed, labels_and_rows(recording)?]))
    });
    let read = read.collect::<Result<Value, CliError>>()?;
    Ok(Run::new([
        ("command", "simulate".into()),
        ("generator", GENERATOR.into()),
        ("seed", arguments.seed.into()),
        ("seeds", arguments.seeds.into()),
        ("same_chance", arguments.same_chance.into()),
        ("videos", (!arguments.no_video).into()),
        ("settings", settings_value(settings)?),
        ("events", Value::Array(events)),
        ("input_sha256", run::digest(&read).into()),
    ]))
}

fn check_finished(arguments: &Simulate, run: &Run) -> Result<(), CliError> {
    let out = &arguments.out;
    let summary = SimulationSummary::read(&out.join(SUMMARY_FILE))?;
    run.check(out, "a finished", &summary.run)?;
    summary.verify(out).map_err(CliError::Altered)?;
    folder::remove_leftovers(out, run)?;
    let line = format!("{} holds these {} simulated events already", out.display(), summary.events.len());
    print(arguments, &summary, &line, false)
}

/// Prints the result of the run: compared with the recordings if there are any, otherwise of the simulations
/// alone.
fn print(arguments: &Simulate, summary: &SimulationSummary, line: &str, new: bool) -> Result<(), CliError> {
    let recorded = summary.events.iter().any(|event| event.recorded_steps > 0);
    let table = if recorded { summary::table(&summary.kinds) } else { outcomes::table(&summary.events) };
    let page = Some(arguments.out.join(PAGE_FILE)).filter(|page| page.exists());
    let open = page.as_ref().map_or_else(String::new, |it| format!("\nopen {} to watch them", it.display()));
    let value = json!({
        "folder": arguments.out, "page": page, "new": new, "recorded": recorded,
        "kinds": summary.kinds, "events": summary.events,
    });
    arguments.output.print(format!("{}\n{line}{open}", table.trim_end()), &value)
}
