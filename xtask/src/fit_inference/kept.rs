//! The evidence on events: simulated once, and kept in a file from which an interrupted command goes on.

use super::{
    options::FitInference,
    subject::{EventEvidence, INTENTS, Subject},
};
use crate::{
    error::XtaskError,
    evaluations_file::{EvaluationsFile, Line},
};
use core::ops::ControlFlow;
use phase_agent::MindParameters;
use phase_cli::{
    console, context::Context, error::CliError, event_writer::program, interrupt, output::json_text,
    parallel::make_all,
};
use phase_dataset::checksum::{hexadecimal, sha256};
use phase_event::Recording;
use phase_model::AGENT_COUNT;
use phase_simple::{IntentNetwork, InversePlanningSettings};
use std::collections::BTreeMap;

/// Makes evidence, and knows what was made before.
pub(super) struct KeptEvidence<'a> {
    kinds: &'a [MindParameters],
    arguments: &'a FitInference,
    context: &'a Context,
    planning: InversePlanningSettings,
    network: IntentNetwork,
    /// Program, minds and seed, as they enter every key.
    made_by: String,
    file: Option<EvaluationsFile>,
    known: BTreeMap<String, EventEvidence>,
}

impl<'a> KeptEvidence<'a> {
    /// Nothing yet but what the file beside `--out` holds.
    ///
    /// # Errors
    /// If that file cannot be used.
    pub(super) fn new(
        kinds: &'a [MindParameters],
        planning: InversePlanningSettings,
        arguments: &'a FitInference,
        context: &'a Context,
    ) -> Result<Self, XtaskError> {
        let minds = json_text(&kinds, "the minds")?;
        let made_by = format!("{} {minds} {} {}", hexadecimal(&program()), planning.interval, arguments.seed);
        let network = IntentNetwork::bundled().map_err(XtaskError::IntentNetwork)?;
        let kept = arguments.out.as_deref().map(EvaluationsFile::beside).transpose()?;
        let (file, lines) = kept.map_or_else(|| (None, Vec::new()), |(file, lines)| (Some(file), lines));
        let known = lines.into_iter().map(|line: Line<EventEvidence>| (line.key, line.figures)).collect();
        Ok(Self { kinds, arguments, context, planning, network, made_by, file, known })
    }

    /// Events with the evidence on all their intents.
    ///
    /// # Errors
    /// An event that cannot be simulated, a file that cannot be written, or an interruption.
    pub(super) fn of(&self, recordings: &[Recording]) -> Result<Vec<Subject>, XtaskError> {
        let activity = format!("simulating the intents of {}", console::events(recordings.len()));
        let each = self.kinds.len() * INTENTS * AGENT_COUNT;
        let progress = self.context.progress(&activity, recordings.len(), each);
        let subjects = make_all(&self.arguments.jobs, recordings.len(), |k| {
            let mut ticks = 0;
            let evidence = self.one(&recordings[k], &mut || {
                ticks += 1;
                progress.step();
                if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            })?;
            let Some(evidence) = evidence else { return Ok(None) };
            progress.event(ticks, &recordings[k].id);
            Subject::new(&recordings[k], evidence).map(Some)
        })?;
        drop(progress);
        subjects.ok_or_else(|| match &self.file {
            Some(file) => CliError::Interrupted(file.path().to_owned()).into(),
            None => XtaskError::Interrupted,
        })
    }

    fn one(
        &self,
        recording: &Recording,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<EventEvidence>, CliError> {
        let event = recording.to_json().map_err(CliError::EventWrite)?;
        let key = hexadecimal(&sha256(format!("{} {event}", self.made_by).as_bytes()));
        if let Some(known) = self.known.get(&key) {
            return Ok(Some(known.clone()));
        }
        let seed = self.arguments.seed;
        let evidence = EventEvidence::of(recording, self.kinds, &self.planning, &self.network, seed, tick)?;
        if let (Some(file), Some(evidence)) = (&self.file, &evidence) {
            file.add(&Line { key, event: recording.id.clone(), figures: evidence.clone() })?;
        }
        Ok(evidence)
    }
}
