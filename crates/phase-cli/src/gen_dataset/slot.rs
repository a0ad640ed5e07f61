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
    composition::{EventSlot, manner_of},
    folder::Folder,
    manifest::{EventEntry, event_path, video_path},
    preset::{Ends, Selection},
    slot_record::SlotRecord,
};
use phase_event::Event;
use phase_evidence::{
    Track,
    selection::{Ending, RejectionReason, check_event},
};
use phase_model::{
    Layout, Scene,
    random::{self, Purpose},
};
use phase_sampler::{Part, Request, SampleError, Stage};
use phase_sim::SimulationSettings;
use std::{collections::BTreeMap, path::PathBuf, time::Instant};

/// Attempts on one stage before another is drawn: there are several assignments of roles and many seeds, and a stage that
/// some variant rejects is a stage that the others of its block have alone.
const ATTEMPTS_PER_STAGE: usize = 3;
/// Draws of strengths and roles for one scene; a stage on which the part was cast once is likely to allow it again.
const CASTS: usize = 200;
/// Layouts from one block to the next. Coprime to the sizes of the pools of bundled presets: blocks that follow one another have different base layouts.
const LAYOUT_STRIDE: usize = 11;

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
            match self.attempt(&id, index, &slot, record.refused.len())? {
                Attempt::Interrupted => return Ok(None),
                Attempt::Refused(reason) => {
                    let attempt = record.refused.len() + 1;
                    self.context.detail(format!("{id} attempt {attempt}: {}", reason.name()));
                    record.refused.push(reason);
                }
                Attempt::Accepted(event) => record.entry = Some(self.keep(&id, index, &slot, &event)?),
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

    fn attempt(&self, id: &str, index: usize, slot: &EventSlot, number: usize) -> Result<Attempt, CliError> {
        let seed = engine::attempt_seed(self.plan.seed, index, number);
        let scene = self.scene(slot, seed, number)?;
        let settings = self.settings(&scene, seed, index);
        let Some(event) = self.simulate(id, &scene, seed, &settings)? else {
            return Ok(Attempt::Interrupted);
        };
        let Some(selection) = &self.plan.preset.selection else { return Ok(accepted(event)) };
        self.judge(id, event, slot, selection, &settings)
    }

    /// The scene of an attempt: with bodies of its own, or cast on the stage of its block.
    fn scene(&self, slot: &EventSlot, seed: u64, number: usize) -> Result<Scene, SampleError> {
        let layouts = self.pools.get(&slot.layouts).map_or(&[][..], Vec::as_slice);
        let mut random = random::stream(seed, Purpose::Scene, 0);
        let (variant, goal_index) = (slot.variant, slot.goal_index);
        let Some(place) = slot.block else {
            return phase_sampler::sample(&Request { variant, goal_index, layouts }, &mut random);
        };
        let parts = self.plan.composition.parts(place);
        let block = random::derive_seed(self.plan.seed, Purpose::Stage, place.block as u64);
        let mut stages = random::stream(block, Purpose::Stage, (number / ATTEMPTS_PER_STAGE) as u64);
        // Blocks begin with different layouts, so that all are used.
        let mut layouts = layouts.to_vec();
        let turn = (place.block + number / ATTEMPTS_PER_STAGE) * LAYOUT_STRIDE % layouts.len().max(1);
        layouts.rotate_left(turn);
        let stage = Stage::sample(&parts, &layouts, &mut stages)?;
        let part = Part { variant, goal_index };
        let drawn = (0..CASTS).find_map(|_| stage.cast(part, &mut random));
        drawn.ok_or(SampleError(variant))
    }

    /// Cheap tests first; the counterfactual has to be simulated and comes last.
    fn judge(
        &self,
        id: &str,
        event: Event,
        slot: &EventSlot,
        selection: &Selection,
        settings: &SimulationSettings,
    ) -> Result<Attempt, CliError> {
        let (scene, track) = (&event.scene, Track::of_event(&event));
        let ending = match selection.ends {
            Ends::Settled | Ends::AdversarialDrawn => Ending::Settled,
            Ends::Drawn => Ending::Drawn(manner_of(slot.variant)),
        };
        let lengths = selection.min_steps..=selection.max_steps;
        let counterfactual = match check_event(scene, &track, lengths, ending) {
            Err(reason) => return Ok(Attempt::Refused(reason)),
            Ok(None) => return Ok(accepted(event)),
            Ok(Some(counterfactual)) => counterfactual,
        };
        let settings = SimulationSettings { idle: Some(counterfactual.idle), ..*settings };
        let without = self.simulate(id, &counterfactual.scene(scene), event.seed, &settings)?;
        let Some(without) = without else { return Ok(Attempt::Interrupted) };
        Ok(match counterfactual.judge(scene, &track, &Track::of_event(&without)) {
            Err(reason) => Attempt::Refused(reason),
            Ok(()) => accepted(event),
        })
    }

    /// The run's settings, with a sampled length if the preset requires it.
    fn settings(&self, scene: &Scene, seed: u64, index: usize) -> SimulationSettings {
        let mut settings = self.plan.settings;
        let slot = engine::event_seed(self.plan.seed, index);
        let selection = self.plan.preset.selection;
        if let Some((min, max)) = selection.and_then(|it| it.sampled_length(scene.relation(), seed, slot)) {
            (settings.min_steps, settings.max_steps) = (settings.min_steps.max(min), max);
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
    fn keep(&self, id: &str, index: usize, slot: &EventSlot, event: &Event) -> Result<EventEntry, CliError> {
        let out = self.folder.path();
        let settings = self.settings(&event.scene, event.seed, index);
        let job = EventJob {
            id: id.into(),
            seed: event.seed,
            relation: None,
            lengths: Some((settings.min_steps, settings.max_steps)),
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
