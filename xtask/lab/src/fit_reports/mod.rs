//! `fit-reports`: fits how people report what they saw to raters of recordings.
//!
//! SIMPLE's impression of each event and its ratings come from results of `eval goals --ratings`. Every fold
//! of the events is held out of one fit, and the strength of its regularisation is chosen by the same within
//! the rest, so that the figures of the folds held out are those of events that played no part.

pub mod options;
mod regression;

use crate::{error::LabError, folds};
use options::FitReports;
use phase_cli::{json_file, output::print_result};
use phase_eval::{
    Estimate,
    goals::{Agreement, Protocol, REPORT_TRAINING_FORMAT, RecognisedEvent, ReportTraining},
    results::GOALS_FORMAT,
};
use phase_files::{FileError, Problem, json};
use phase_model::RelationProbabilities;
use phase_runs::error::RunError;
use phase_simple::{Impression, ReportModel};
use regression::{Rated, fit};
use serde::Deserialize;
use serde_json::Value;

/// Values of the ridge, in raters.
const RIDGES: [f64; 6] = [1.0, 4.0, 15.0, 40.0, 100.0, 300.0];
/// Folds within which the ridge is chosen.
const INNER_FOLDS: usize = 5;

/// Members of an event of the results that are read.
#[derive(Deserialize)]
struct Details {
    impression: Impression,
}

/// Runs the command.
///
/// # Errors
/// Results without impressions or ratings, or a file that cannot be read or written.
pub fn run(arguments: &FitReports) -> Result<(), LabError> {
    for (option, file) in [("--out", &arguments.out), ("--record", &arguments.record)] {
        file.as_ref().map_or(Ok(()), |file| json_file::check(option, file, [&arguments.results]))?;
    }
    let Input { events, rated, sha256 } = read(arguments)?;
    let folds = usize::from(arguments.folds);
    if events.len() < folds {
        let rule = format!("--results: {} rated events, fewer than --folds {folds}", events.len());
        return Err(RunError::Usage(rule).into());
    }
    let named: Vec<_> = events.iter().map(|event| (event.id.as_str(), event.label.kind)).collect();
    let fold_of = folds::assign(&named, folds, arguments.seed);
    let mut held_out = events.clone();
    let mut chosen = Vec::new();
    for fold in 0..folds {
        let training: Vec<usize> = (0..events.len()).filter(|&k| fold_of[k] != fold).collect();
        let ridge = choose(&training, &named, &rated, arguments.seed)?;
        let model = fitted(&training, &rated, ridge)?;
        for k in (0..events.len()).filter(|&k| fold_of[k] == fold) {
            held_out[k].answer.reported = Some(model.reports(&rated[k].impression));
        }
        chosen.push(ridge);
    }
    let all: Vec<usize> = (0..events.len()).collect();
    let ridge = choose(&all, &named, &rated, arguments.seed)?;
    let model = fitted(&all, &rated, ridge)?;
    let mut in_sample = events.clone();
    for (event, rated) in in_sample.iter_mut().zip(&rated) {
        event.answer.reported = Some(model.reports(&rated.impression));
    }
    arguments.out.as_ref().map_or(Ok(()), |file| json_file::write(file, &model))?;
    let seed = arguments.seed;
    let agreement = |events: &[RecognisedEvent], protocol| {
        Agreement::of(events, seed).map(|agreement| Agreement { protocol, ..agreement })
    };
    let own = agreement(&in_sample, Protocol::InSample);
    let other = agreement(&held_out, Protocol::HeldOut { folds });
    if let (Some(file), Some(in_sample), Some(held_out)) = (&arguments.record, &own, &other) {
        let record = ReportTraining {
            format: REPORT_TRAINING_FORMAT.into(),
            events_sha256: sha256.ok_or_else(|| {
                let rule = "field run.events_sha256 is missing, which --record needs";
                RunError::Usage(format!("--results {}: {rule}", arguments.results.display()))
            })?,
            seed,
            in_sample: in_sample.clone(),
            held_out: held_out.clone(),
        };
        json_file::write(file, &record)?;
    }
    let mut text = format!(
        "{} events with {} ratings; ridge {ridge}, without one fold {}\n\n{:<40} {:>22} {:>22} {:>22} {:>22}\n",
        events.len(),
        rated.iter().map(|event| event.counts.raters()).sum::<usize>(),
        chosen.iter().map(f64::to_string).collect::<Vec<_>>().join(", "),
        "reports predicted by",
        "correlation",
        "cross-entropy (nat)",
        "similarity",
        "mode"
    );
    text += &line("a model that did not see the event", other.as_ref());
    text += &line("the model fitted to all events", own.as_ref());
    text += &line("the posterior of the relation", Agreement::of_relations(&in_sample, seed).as_ref());
    if let Some(ceiling) = other.and_then(|it| it.ceiling) {
        let number = |it: Option<f64>| it.map_or_else(|| "-".into(), |it| format!("{it:.3}"));
        text += &format!(
            "{:<40} {:>22} {:>22} {:>22} {:>22}\n",
            "people (noise ceiling)",
            number(ceiling.correlation),
            number(Some(ceiling.entropy)),
            number(ceiling.similarity),
            number(Some(ceiling.mode)),
        );
    }
    print_result(text.trim_end())?;
    Ok(())
}

/// The results of an evaluation: the rated events.
struct Input {
    events: Vec<RecognisedEvent>,
    /// The impression and the ratings of each.
    rated: Vec<Rated>,
    /// Digest of all events, if the results name it.
    sha256: Option<String>,
}

fn read(arguments: &FitReports) -> Result<Input, RunError> {
    let file = &arguments.results;
    let fail = |problem: Problem| RunError::File(FileError { file: file.clone(), problem });
    let value = phase_model::json::parse(&json::bytes(file)?).map_err(|error| fail(error.into()))?;
    let rule = |rule: &str| RunError::Usage(format!("--results {}: {rule}", file.display()));
    if value["format"] != GOALS_FORMAT {
        return Err(rule(&format!("field format must be {GOALS_FORMAT:?}")));
    }
    let members: &[Value] = value["events"].as_array().map_or(&[], Vec::as_slice);
    let mut events = Vec::new();
    let mut rated = Vec::new();
    for member in members {
        let event: RecognisedEvent = serde_json::from_value(member.clone())
            .map_err(|error| rule(&format!("an event cannot be read: {error}")))?;
        let Some(counts) = event.label.ratings else { continue };
        let Ok(Details { impression }) = serde_json::from_value(event.details.clone()) else {
            return Err(rule(&format!(
                "event {}: there is no impression of it; its method must be simple",
                event.id
            )));
        };
        events.push(event);
        rated.push(Rated { impression, counts });
    }
    if events.is_empty() {
        return Err(rule("no event was rated; run eval goals with --ratings"));
    }
    let sha256 = value["run"]["events_sha256"].as_str().map(str::to_owned);
    Ok(Input { events, rated, sha256 })
}

/// The ridge under which the reports of events held out are likeliest.
fn choose(
    events: &[usize],
    named: &[(&str, phase_model::EventKind)],
    rated: &[Rated],
    seed: u64,
) -> Result<f64, RunError> {
    let own: Vec<_> = events.iter().map(|&k| named[k]).collect();
    let fold_of = folds::assign(&own, INNER_FOLDS, seed);
    let mut best = (f64::INFINITY, RIDGES[0]);
    for ridge in RIDGES {
        let mut loss = 0.0;
        for fold in 0..INNER_FOLDS {
            let part = |inside: bool| {
                let chosen = events.iter().zip(&fold_of).filter(move |(_, of)| (**of == fold) == inside);
                chosen.map(|(&k, _)| k).collect::<Vec<usize>>()
            };
            let model = fitted(&part(false), rated, ridge)?;
            loss += part(true).iter().map(|&k| cross_entropy(&model, &rated[k])).sum::<f64>();
        }
        if loss < best.0 {
            best = (loss, ridge);
        }
    }
    Ok(best.1)
}

fn fitted(events: &[usize], rated: &[Rated], ridge: f64) -> Result<ReportModel, RunError> {
    let events: Vec<Rated> = events.iter().map(|&k| rated[k]).collect();
    fit(&events, ridge)
        .map_err(|error| RunError::Usage(format!("--results: the model cannot be fitted: {error}")))
}

fn cross_entropy(model: &ReportModel, rated: &Rated) -> f64 {
    let RelationProbabilities { friendly, adversarial, neutral } = model.reports(&rated.impression);
    let shares = rated.counts.counts().map(|count| count as f64 / rated.counts.raters().max(1) as f64);
    let log = |p: f64| libm::log(p.max(f64::MIN_POSITIVE));
    -shares.iter().zip([friendly, adversarial, neutral]).map(|(share, p)| share * log(p)).sum::<f64>()
}

fn line(name: &str, agreement: Option<&Agreement>) -> String {
    let Some(agreement) = agreement else { return String::new() };
    let show = |it: Option<Estimate>| {
        it.map_or_else(|| "-".into(), |it| format!("{:.3} [{:.3}, {:.3}]", it.value, it.low, it.high))
    };
    format!(
        "{name:<40} {:>22} {:>22} {:>22} {:>22}\n",
        show(agreement.correlation),
        show(Some(agreement.cross_entropy)),
        show(agreement.similarity),
        show(Some(agreement.mode)),
    )
}
