//! `fit-forecast`: fits how SIMPLE combines simulated futures to events whose continuation is known.
//!
//! The likeliest hypotheses after the seconds watched are simulated once, more of them than SIMPLE takes. How many of them are used,
//! the inverse temperature of their weights, and the share of a learnt forecaster's future among them, are compared on a grid by the
//! mean displacement error.

pub mod options;

use crate::{
    check_minds,
    error::XtaskError,
    evaluations_file::{EvaluationsFile, Line},
    json_file,
};
use core::ops::ControlFlow;
use options::FitForecast;
use phase_cli::{
    console::{self, print_result},
    context::Context,
    effort::MindOptions,
    error::CliError,
    eval::methods,
    event_writer::program,
    interrupt,
    output::json_text,
    parallel::make_all,
};
use phase_dataset::checksum::{hexadecimal, sha256};
use phase_eval::{
    Forecaster, MethodError,
    trajectories::{Errors, PREDICTED_STEPS, Prediction, WATCHED_STEPS},
};
use phase_event::Recording;
use phase_model::{Forecast, Vec2};
use phase_simple::{
    Cues, ForecastSettings, Futures, Guidance, Guide, InferenceSettings, IntentNetwork, PreparedEvent,
    UniformStrength, futures, infer,
};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, path::Path};

/// Hypotheses that are simulated.
const HYPOTHESES: usize = 12;
/// Numbers of hypotheses that are compared.
const COUNTS: [usize; 6] = [1, 2, 3, 5, 8, HYPOTHESES];
/// Inverse temperatures that are compared.
const INVERSE_TEMPERATURES: [f64; 6] = [0.1, 0.25, 0.4, 0.6, 0.8, 1.0];
/// Shares of the learnt forecaster that are compared.
const SHARES: [f64; 6] = [0.0, 0.05, 0.1, 0.2, 0.3, 0.5];
/// The learnt forecaster.
const LEARNT: &str = "social-lstm";

/// How futures are combined.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
struct Combination {
    hypotheses: usize,
    inverse_temperature: f64,
    /// Share of the learnt forecaster's future.
    learnt: f64,
}

/// The futures of one event: by hypothesis, its weight and the places of all entities by repeat, entity and step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct KnownFutures {
    hypotheses: Vec<(f64, Vec<Places>)>,
    learnt: Places,
    truth: Places,
}

/// Positions by entity and step (u).
type Places = Vec<Vec<[f32; 2]>>;

/// Runs the command.
///
/// # Errors
/// Any [`XtaskError`] about the files, or an interruption.
pub fn run(arguments: &FitForecast, context: &Context) -> Result<(), XtaskError> {
    if let Some(out) = &arguments.out {
        let inputs = arguments.events.iter().chain(&arguments.held_out);
        json_file::check("--out", out, inputs.map(|file| file.as_path()))?;
    }
    let read = |files: &[std::path::PathBuf]| -> Result<Vec<Recording>, XtaskError> {
        let mut recordings = Vec::new();
        for file in files {
            recordings.extend(some(arguments, file, context)?);
        }
        Ok(recordings)
    };
    let (own, others) = (read(&arguments.events)?, read(&arguments.held_out)?);
    interrupt::listen();
    let learnt = methods::forecaster(LEARNT, None, &MindOptions::default())?;
    let own = known(&own, &*learnt, arguments, context)?;
    let others = known(&others, &*learnt, arguments, context)?;
    let mut ranked: Vec<(f64, Combination)> =
        combinations().into_iter().map(|it| (mean(&own, &it)[0], it)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = format!(
        "{:<34} {:>10} {:>8} {:>8} {:>8} {:>8} {:>13} {:>13}\n",
        "", "hypotheses", "1/T", "learnt", "ADE", "FDE", "ADE held out", "FDE held out"
    );
    let mut line = |name: &str, combination: &Combination| {
        let [ade, fde] = mean(&own, combination);
        let [other_ade, other_fde] = mean(&others, combination);
        let Combination { hypotheses, inverse_temperature, learnt } = combination;
        text += &format!(
            "{name:<34} {hypotheses:>10} {inverse_temperature:>8} {learnt:>8} {ade:>8.3} {fde:>8.3} {other_ade:>13.3} \
             {other_fde:>13.3}\n"
        );
    };
    let ForecastSettings { hypotheses, inverse_temperature, .. } = ForecastSettings::default();
    line("present", &Combination { hypotheses, inverse_temperature, learnt: 0.0 });
    let best = |among: &dyn Fn(&Combination) -> bool| ranked.iter().map(|it| it.1).find(|it| among(it));
    for (name, found) in [
        ("fitted", best(&|_| true)),
        ("fitted, without the learnt", best(&|it| it.learnt == 0.0)),
        ("fitted, present hypotheses", best(&|it| it.learnt == 0.0 && it.hypotheses == hypotheses)),
    ] {
        if let Some(found) = found {
            line(name, &found);
        }
    }
    line("the learnt alone", &Combination { hypotheses: 1, inverse_temperature: 1.0, learnt: 1.0 });
    if let Some((_, fitted)) = ranked.first() {
        json_file::write(arguments.out.as_deref(), &json_text(fitted, "the settings")?)?;
    }
    print_result(text.trim_end());
    Ok(())
}

fn combinations() -> Vec<Combination> {
    let mut all = Vec::new();
    for hypotheses in COUNTS {
        for inverse_temperature in INVERSE_TEMPERATURES {
            all.extend(SHARES.map(|learnt| Combination { hypotheses, inverse_temperature, learnt }));
        }
    }
    all
}

/// Mean ADE and FDE of a combination.
fn mean(events: &[KnownFutures], combination: &Combination) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for event in events {
        let errors = Errors::of(&event.combined(combination), &forecast_of(&event.truth));
        if let Ok([agents, _]) = errors {
            sums[0] += agents.ade;
            sums[1] += agents.fde;
        }
    }
    sums.map(|sum| sum / events.len().max(1) as f64)
}

impl KnownFutures {
    fn combined(&self, combination: &Combination) -> Forecast {
        let mut paths: Vec<(Forecast, f64)> = Vec::new();
        for (weight, repeats) in self.hypotheses.iter().take(combination.hypotheses) {
            let weight = libm::pow(*weight, combination.inverse_temperature);
            paths.extend(repeats.iter().map(|places| (forecast_of(places), weight)));
        }
        let total: f64 = paths.iter().map(|(_, weight)| weight).sum();
        if combination.learnt >= 1.0 {
            return forecast_of(&self.learnt);
        }
        if combination.learnt > 0.0 {
            paths.push((forecast_of(&self.learnt), total * combination.learnt / (1.0 - combination.learnt)));
        }
        Futures::new(paths).median()
    }
}

fn forecast_of(places: &Places) -> Forecast {
    places.iter().map(|path| path.iter().map(|&place| Vec2::from_array(place)).collect()).collect()
}

fn places_of(forecast: &Forecast) -> Places {
    forecast.iter().map(|path| path.iter().map(|place| place.to_array()).collect()).collect()
}

/// The futures of events that are long enough, simulated or taken from the file beside `--out`.
fn known(
    recordings: &[Recording],
    learnt: &dyn Forecaster,
    arguments: &FitForecast,
    context: &Context,
) -> Result<Vec<KnownFutures>, XtaskError> {
    let kept = arguments.out.as_deref().map(EvaluationsFile::beside).transpose()?;
    let (file, lines) = kept.map_or_else(|| (None, Vec::new()), |(file, lines)| (Some(file), lines));
    let before: BTreeMap<String, KnownFutures> =
        lines.into_iter().map(|line: Line<KnownFutures>| (line.key, line.figures)).collect();
    let long: Vec<&Recording> =
        recordings.iter().filter(|recording| recording.trajectory.steps() > WATCHED_STEPS).collect();
    let activity = format!("simulating the futures of {}", console::events(long.len()));
    let each = HYPOTHESES * ForecastSettings::default().repeats;
    let progress = context.progress(&activity, long.len(), each);
    let made = make_all(&arguments.jobs, long.len(), |k| {
        let recording = long[k];
        let event = recording.to_json().map_err(CliError::EventWrite)?;
        let made_by = format!("{} {}", hexadecimal(&program()), arguments.seed);
        let key = hexadecimal(&sha256(format!("{made_by} {event}").as_bytes()));
        if let Some(known) = before.get(&key) {
            progress.event(0, &recording.id);
            return Ok(Some(known.clone()));
        }
        let mut ticks = 0;
        let found = simulated(recording, learnt, arguments.seed, &mut || {
            ticks += 1;
            progress.step();
            if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let found = found.map_err(|source| CliError::Method { id: recording.id.clone(), source })?;
        if let (Some(file), Some(found)) = (&file, &found) {
            file.add(&Line { key, event: recording.id.clone(), figures: found.clone() })?;
        }
        progress.event(ticks, &recording.id);
        Ok::<_, CliError>(found)
    })?;
    drop(progress);
    made.ok_or_else(|| match &file {
        Some(file) => CliError::Interrupted(file.path().to_owned()).into(),
        None => XtaskError::Interrupted,
    })
}

fn simulated(
    recording: &Recording,
    learnt: &dyn Forecaster,
    seed: u64,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<KnownFutures>, MethodError> {
    let whole = recording.observed().map_err(MethodError::new)?;
    let observed = whole.prefix(WATCHED_STEPS);
    let steps = (whole.steps() - WATCHED_STEPS).min(PREDICTED_STEPS);
    let network = IntentNetwork::bundled().map_err(MethodError::new)?;
    let guide = Guide { network: &network, guidance: Guidance::default() };
    let settings = InferenceSettings::averaged();
    let prepared = PreparedEvent::new(&observed, settings.minds, seed);
    let cues = Cues { strengths: &UniformStrength, guide: Some(guide) };
    let inference = infer(&prepared, &cues, seed, &settings, tick).map_err(MethodError::new)?;
    let Some(inference) = inference else { return Ok(None) };
    // With an inverse temperature of 1 the weights are the posterior's.
    let repeats = ForecastSettings::default().repeats;
    let settings = ForecastSettings { hypotheses: HYPOTHESES, repeats, inverse_temperature: 1.0 };
    let found = futures(&prepared, &inference, steps, seed, &settings, tick).map_err(MethodError::new)?;
    let Some(found) = found else { return Ok(None) };
    let hypotheses = found.paths.chunks(repeats).map(|repeats| {
        let weight = repeats.first().map_or(0.0, |(_, weight)| *weight);
        (weight, repeats.iter().map(|(path, _)| places_of(path)).collect())
    });
    let Some((Prediction { forecast, .. }, _)) = learnt.forecast(&observed, steps, seed, tick)? else {
        return Ok(None);
    };
    let rows = || whole.rows().iter().skip(1 + WATCHED_STEPS).take(steps);
    let path = |entity: usize| rows().map(|row| row[entity].position.to_array()).collect();
    Ok(Some(KnownFutures {
        hypotheses: hypotheses.collect(),
        learnt: places_of(&forecast),
        truth: whole.entities().map(|entity| path(entity.index())).collect(),
    }))
}

/// The events of a file, as many as were asked for.
fn some(arguments: &FitForecast, file: &Path, context: &Context) -> Result<Vec<Recording>, CliError> {
    let mut recordings = check_minds::recordings(file, None, context)?;
    recordings.truncate(arguments.limit.map_or(usize::MAX, |limit| limit as usize));
    Ok(recordings)
}
