//! Filling one slot of a dataset: scenes are tried one after the other until one shows its label.

use super::plan::Plan;
use crate::{
    console,
    context::Context,
    engine,
    error::CliError,
    event_writer::{EventJob, EventWriter},
    interrupt,
};
use core::ops::ControlFlow;
use phase_dataset::{
    folder::Folder,
    manifest::{EventEntry, event_path, video_path},
    preset::{EventSlot, Selection},
    slot_record::SlotRecord,
};
use phase_event::Event;
use phase_evidence::{
    Track,
    selection::{RejectionReason, check_event},
};
use phase_model::{Layout, Scene, random};
use phase_sampler::Request;
use phase_sim::SimulationSettings;
use std::{collections::BTreeMap, path::PathBuf, time::Instant};

/// The slots of a dataset that is being generated in a folder.
#[derive(Debug)]
pub struct Slots<'a> {
    plan: &'a Plan,
    folder: &'a Folder,
    event_writer: EventWriter,
    pools: BTreeMap<String, Vec<Layout>>,
    context: Context,
}

/// The result of an attempt.
enum Attempt {
    Interrupted,
    Refused(RejectionReason),
    Accepted(Box<Event>),
}

impl<'a> Slots<'a> {
    /// Prepares to fill the given number of slots.
    ///
    /// # Errors
    /// [`CliError::Serialise`].
    pub fn new(plan: &'a Plan, folder: &'a Folder, count: usize, context: Context) -> Result<Self, CliError> {
        let pools = plan.preset.layouts.keys().map(|name| (name.clone(), plan.preset.pool(name))).collect();
        let activity = format!("making {}", console::events(count));
        let event_writer = EventWriter::new(&context, &activity, folder, plan.settings, count)?;
        Ok(Self { plan, folder, event_writer, pools, context })
    }

    /// The record of a slot.
    #[must_use]
    pub fn record(&self, index: usize) -> SlotRecord {
        SlotRecord::load(&self.record_path(index), &self.plan.fingerprint)
    }

    /// Fills a slot, resuming where an earlier run stopped; `None` if interrupted. After every attempt the
    /// slot's record is written, so that no more than one attempt is ever lost.
    ///
    /// # Errors
    /// [`CliError::Exhausted`] and any failure of sampling, simulating and writing.
    pub fn fill(&self, index: usize) -> Result<Option<()>, CliError> {
        let (id, slot, begun) =
            (self.plan.preset.id(index), self.plan.composition.slot(index), Instant::now());
        let (kind, variant) = (slot.variant.kind().name(), slot.variant.name());
        let mut record = self.record(index);
        if let Some(entry) = &record.entry
            && entry.files().all(|file| file.verify(self.folder.path()).is_ok())
        {
            let length = entry.steps;
            self.event_writer.finished(0, &format!("{id} {kind}: {length} steps (kept)"));
            return Ok(Some(()));
        }
        record.entry = None;
        let limit = self.plan.preset.selection.map_or(1, |selection| selection.attempts);
        while record.refused.len() < limit {
            let seed = engine::attempt_seed(self.plan.seed, index, record.refused.len());
            match self.attempt(&id, &slot, seed)? {
                Attempt::Interrupted => return Ok(None),
                Attempt::Refused(reason) => {
                    let attempt = record.refused.len() + 1;
                    self.context.detail(format!("{id} attempt {attempt}: {}", reason.name()));
                    record.refused.push(reason);
                }
                Attempt::Accepted(event) => record.entry = Some(self.keep(&id, &slot, &event)?),
            }
            record.save(&self.record_path(index))?;
            if let Some(entry) = &record.entry {
                let (attempts, length) = (record.refused.len() + 1, entry.steps);
                let seconds = begun.elapsed().as_secs_f64();
                let tried = if attempts == 1 { String::new() } else { format!(" at attempt {attempts}") };
                let line = format!("{id} {kind}, {variant}: {length} steps{tried} ({seconds:.1} s)");
                self.event_writer.finished(0, &line);
                return Ok(Some(()));
            }
        }
        Err(CliError::Exhausted { id, variant: slot.variant, reasons: reasons(&record.refused) })
    }

    fn attempt(&self, id: &str, slot: &EventSlot, seed: u64) -> Result<Attempt, CliError> {
        let layouts = self.pools.get(&slot.layouts).map_or(&[][..], Vec::as_slice);
        let request = Request { variant: slot.variant, goal_index: slot.goal_index, layouts };
        let mut random = random::stream(seed, random::Purpose::Scene, 0);
        let scene = phase_sampler::sample(&request, &mut random)?;
        let Some(event) = self.simulate(id, &scene, seed, &self.settings(&scene, seed))? else {
            return Ok(Attempt::Interrupted);
        };
        let Some(selection) = &self.plan.preset.selection else { return Ok(accepted(event)) };
        self.judge(id, event, selection)
    }

    /// Cheap tests first; the counterfactual has to be simulated and comes last.
    fn judge(&self, id: &str, event: Event, selection: &Selection) -> Result<Attempt, CliError> {
        let (scene, track) = (&event.scene, Track::of_event(&event));
        let counterfactual = match check_event(scene, &track, selection.min_steps..=selection.max_steps) {
            Err(reason) => return Ok(Attempt::Refused(reason)),
            Ok(None) => return Ok(accepted(event)),
            Ok(Some(counterfactual)) => counterfactual,
        };
        let settings =
            SimulationSettings { idle: Some(counterfactual.idle), ..self.settings(scene, event.seed) };
        let without = self.simulate(id, &counterfactual.scene(scene), event.seed, &settings)?;
        let Some(without) = without else { return Ok(Attempt::Interrupted) };
        Ok(match counterfactual.judge(scene, &track, &Track::of_event(&without)) {
            Err(reason) => Attempt::Refused(reason),
            Ok(()) => accepted(event),
        })
    }

    /// The run's settings, with a sampled end for adversarial events if the preset requires it.
    fn settings(&self, scene: &Scene, seed: u64) -> SimulationSettings {
        let mut settings = self.plan.settings;
        if let Some(end) = self.plan.preset.selection.and_then(|it| it.sampled_end(scene.relation(), seed)) {
            settings.max_steps = end;
        }
        settings
    }

    fn simulate(
        &self,
        id: &str,
        scene: &Scene,
        seed: u64,
        settings: &SimulationSettings,
    ) -> Result<Option<Event>, CliError> {
        let mut on_step = |_: &_| {
            if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        engine::simulate(id, scene, seed, settings, &mut on_step)
    }

    /// Writes the files of an accepted event.
    fn keep(&self, id: &str, slot: &EventSlot, event: &Event) -> Result<EventEntry, CliError> {
        let out = self.folder.path();
        let job = EventJob {
            id: id.into(),
            seed: event.seed,
            relation: None,
            max_steps: Some(self.settings(&event.scene, event.seed).max_steps),
            json: out.join(event_path(id)),
            video: self.plan.videos.then(|| out.join(video_path(id))),
        };
        self.event_writer.write(&job, event, true)?;
        let mut entry = EventEntry::of(out, id, event, self.plan.videos).map_err(CliError::ReadBack)?;
        (entry.variant, entry.split) = (Some(slot.variant), slot.split);
        Ok(entry)
    }

    fn record_path(&self, index: usize) -> PathBuf {
        self.folder.cache().join(format!("{}.json", self.plan.preset.id(index)))
    }
}

fn accepted(event: Event) -> Attempt {
    Attempt::Accepted(Box::new(event))
}

/// Reasons with their numbers, in words.
fn reasons(refused: &[RejectionReason]) -> String {
    let counted =
        RejectionReason::ALL.map(|reason| (reason, refused.iter().filter(|it| **it == reason).count()));
    let words = counted.iter().filter(|(_, count)| *count > 0);
    words.map(|(reason, count)| format!("{} {count}", reason.name())).collect::<Vec<_>>().join(", ")
}
