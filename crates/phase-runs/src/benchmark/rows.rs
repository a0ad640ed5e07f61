//! One method on one set of events after the other.

use super::{
    BenchmarkRun,
    plan::{BenchmarkEntry, BenchmarkTask, minds_of},
};
use crate::{
    engine::GENERATOR,
    error::RunError,
    eval::{
        Evaluation,
        answers::AnswerSource,
        goals::Goals,
        input::{Event, Input},
        methods::{forecaster, recogniser},
        ratings::Ratings,
        scored::ScoredEvent,
        task::evaluate,
        trajectories::Trajectories,
    },
    laboratory::unusable,
    listener::Listener,
};
use phase_dataset::splits::Split;
use phase_eval::{
    benchmark::{
        self, BENCHMARK_FORMAT, EventSet, Familiarity, GENERATED, Origin, PAIRS, RECORDED, Row, Subset,
        Training,
    },
    goals::{RecognisedEvent, ReportTraining},
    trajectories::ForecastEvent,
};
use phase_files::{FileError, Problem, json};
use serde_json::Value;
use std::path::Path;

/// The rows so far, and the events that they are about.
pub(super) struct Rows<'a> {
    run: &'a BenchmarkRun,
    inputs: Vec<(Input, Evaluation)>,
    ratings: Option<Ratings>,
    /// Events that the bundled model of reports was fitted to.
    reports: ReportTraining,
    benchmark: benchmark::Benchmark,
}

impl<'a> Rows<'a> {
    /// No rows yet.
    pub(super) fn open(run: &'a BenchmarkRun, listener: &dyn Listener) -> Result<Self, RunError> {
        let common = |events: &Path, split| Evaluation {
            split,
            limit: run.limit,
            seed: run.seed,
            shard: run.shard,
            threads: run.threads,
            ..Evaluation::new(events)
        };
        let generated = (GENERATED, common(&run.data, Some(Split::Test)));
        let real = run.real.as_deref().map(|file| (RECORDED, common(file, None)));
        let pairs = run.pairs.as_deref().map(|folder| (PAIRS, common(folder, None)));
        let mut inputs = Vec::new();
        let mut sets = Vec::new();
        for (label, common) in [generated].into_iter().chain(real).chain(pairs) {
            let input = Input::open(&common, listener)?;
            if label == PAIRS && input.events.iter().all(|event| event.set.is_none()) {
                let rule = "has no event with the field `set`, which --pairs needs";
                return Err(unusable(&common.events, rule));
            }
            let name = input.description.clone();
            let label = label.into();
            let sha256 = input.sha256.clone();
            sets.push(EventSet { name, label, sha256, events: input.events.len() });
            inputs.push((input, common));
        }
        let of_file = |file: &Path| {
            let inputs: Vec<&Input> = inputs.iter().map(|(input, _)| input).collect();
            Ratings::read(file, &inputs, listener)
        };
        let ratings = run.ratings.as_deref().map(of_file).transpose()?;
        let reports = serde_json::from_str(phase_data::REPORT_TRAINING);
        let reports = reports.map_err(|error| {
            let problem = Problem::Shape { what: "record of a fit", rule: error.to_string() };
            RunError::File(FileError { file: "data/report-model.training.json".into(), problem })
        })?;
        let benchmark = benchmark::Benchmark {
            format: BENCHMARK_FORMAT.into(),
            generator: GENERATOR.into(),
            options: run.measured(),
            seed: run.seed,
            sets,
            goals: Vec::new(),
            trajectories: Vec::new(),
            trainings: Vec::new(),
        };
        Ok(Self { run, inputs, ratings, reports, benchmark })
    }

    /// Number of sets of events.
    pub(super) const fn sets(&self) -> usize {
        self.inputs.len()
    }

    /// Whether a method is asked about a set.
    pub(super) fn asks(&self, entry: &BenchmarkEntry, set: usize) -> bool {
        self.benchmark.sets[set].label != PAIRS || entry.does_pairs()
    }

    /// A set in words.
    pub(super) fn name(&self, set: usize) -> &str {
        &self.benchmark.sets[set].name
    }

    /// Adds a training and returns its index.
    pub(super) fn add_training(&mut self, training: Training) -> usize {
        let known = self.benchmark.trainings.iter().position(|other| *other == training);
        known.unwrap_or_else(|| {
            self.benchmark.trainings.push(training);
            self.benchmark.trainings.len() - 1
        })
    }

    /// Has a method evaluated, unless that is already done.
    pub(super) fn add(
        &mut self,
        entry: &BenchmarkEntry,
        training: Option<usize>,
        set: usize,
        listener: &dyn Listener,
    ) -> Result<(), RunError> {
        let BenchmarkEntry { task, name, method, weights } = entry;
        let (input, common) = &mut self.inputs[set];
        let mut folder = format!("{}-{name}-{}", task.name(), input.name);
        if let Some(limit) = self.run.limit {
            folder += &format!("-first{limit}");
        }
        // Each part has its evaluations in a folder of its own, by the same names.
        common.merge = self.run.merge.iter().map(|part| part.join(&folder)).collect();
        common.out = Some(self.run.evaluations.join(folder));
        let origin = if weights.is_some() { Origin::Trained } else { Origin::Ours };
        let weights = weights.as_deref();
        let name = name.clone();
        let seed = self.run.seed;
        let recorded = self.benchmark.sets[set].label == RECORDED;
        let minds = minds_of(self.run, method, recorded);
        match task {
            BenchmarkTask::Goals => {
                // Ratings are of recordings.
                let ratings = self.ratings.clone().filter(|_| recorded);
                let task = Goals::from(AnswerSource::of_method(&name, recogniser(method, weights, &minds)?))
                    .with_ratings(ratings);
                let Some(done) = evaluate(&task, input, common, listener)? else { return Ok(()) };
                let events = done.events;
                let mut row = row(name, origin, set, training, input, &events, seed);
                if let Some(row) = &mut row {
                    self.reports.label(&mut row.summary, &self.benchmark.sets[set].sha256);
                }
                self.benchmark.goals.extend(row);
            }
            BenchmarkTask::Trajectories => {
                let answers = AnswerSource::of_method(&name, forecaster(method, weights, &minds)?);
                let task = Trajectories { answers };
                let Some(done) = evaluate(&task, input, common, listener)? else { return Ok(()) };
                let events = done.events;
                self.benchmark.trajectories.extend(row(name, origin, set, training, input, &events, seed));
            }
        }
        Ok(())
    }

    /// Takes over a finished evaluation.
    pub(super) fn add_results(&mut self, file: &Path) -> Result<(), RunError> {
        let results = json::read(file)?;
        let fail = |rule: String| {
            let problem = Problem::Shape { what: "results file", rule };
            RunError::File(FileError { file: file.to_owned(), problem })
        };
        let format = results["format"].as_str();
        let sha256 = results["run"]["events_sha256"].as_str();
        let name = results["method"].as_str().unwrap_or_default().to_owned();
        let set = self.benchmark.sets.iter().position(|set| Some(set.sha256.as_str()) == sha256);
        let set = set.ok_or_else(|| fail("field `run.events_sha256` is not that of these events".into()))?;
        let input = &self.inputs[set].0;
        let seed = self.run.seed;
        match format {
            Some(RecognisedEvent::FORMAT) => {
                let events: Vec<RecognisedEvent> = events_of(&results, input).map_err(fail)?;
                self.benchmark.goals.extend(row(name, Origin::Given, set, None, input, &events, seed));
            }
            Some(ForecastEvent::FORMAT) => {
                let events: Vec<ForecastEvent> = events_of(&results, input).map_err(fail)?;
                self.benchmark.trajectories.extend(row(name, Origin::Given, set, None, input, &events, seed));
            }
            _ => {
                return Err(fail(format!(
                    "field `format` must be {:?} or {:?}",
                    RecognisedEvent::FORMAT,
                    ForecastEvent::FORMAT
                )));
            }
        }
        Ok(())
    }

    /// The whole benchmark.
    pub(super) fn finish(self) -> benchmark::Benchmark {
        self.benchmark
    }
}

/// The events of results, which have to be those of the input.
fn events_of<A: ScoredEvent>(results: &Value, input: &Input) -> Result<Vec<A>, String> {
    let events = serde_json::from_value(results["events"].clone());
    let events: Vec<A> = events.map_err(|error| format!("field `events`: {error}"))?;
    let ids = events.iter().map(ScoredEvent::id);
    match ids.eq(input.events.iter().map(|event| event.id.as_str())) {
        true => Ok(events),
        false => Err("field `events` does not have the ids of these events, in order".into()),
    }
}

fn row<A: ScoredEvent>(
    method: String,
    origin: Origin,
    set: usize,
    training: Option<usize>,
    input: &Input,
    events: &[A],
    seed: u64,
) -> Option<Row<A::Summary>> {
    let part = |familiarity: Familiarity| {
        let like = |(event, _): &(&Event, &A)| familiar(event, familiarity);
        let events = input.events.iter().zip(events).filter(like).map(|(_, answered)| answered.clone());
        Some(Subset { familiarity, summary: A::sum_up(&events.collect::<Vec<A>>(), seed)? })
    };
    let parts = Familiarity::ALL.into_iter().filter_map(part).collect();
    let summary = A::sum_up(events, seed)?;
    let mistakes = A::mistakes(events);
    Some(Row { method, origin, set, training, summary, mistakes, parts })
}

fn familiar(event: &Event, familiarity: Familiarity) -> bool {
    match familiarity {
        Familiarity::SeenLayout => event.layout_seen == Some(true),
        Familiarity::UnseenLayout => event.layout_seen == Some(false),
        Familiarity::SeenInteraction => event.interaction_seen == Some(true),
        Familiarity::UnseenInteraction => event.interaction_seen == Some(false),
    }
}
