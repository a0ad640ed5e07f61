//! Filling one slot of a dataset: scenes are tried one after the other until one shows its label.

use super::{plan::Plan, scenes::Scenes};
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
    FileError,
    acceptance::Refusal,
    composition::{EventSlot, manner_of},
    folder::Folder,
    manifest::{EventEntry, event_path, video_path},
    preset::{Ends, Selection},
    slot_record::{Records, SlotRecord},
};
use phase_event::Event;
use phase_evidence::{
    Track,
    selection::{Counterfactual, Ending, RejectionReason, check_event},
};
use phase_model::Scene;
use phase_sampler::Variant;
use phase_sim::SimulationSettings;
use std::{path::PathBuf, time::Instant};

/// The slots of a dataset that is being generated in a folder.
#[derive(Debug)]
pub struct Slots<'a> {
    pub(super) plan: &'a Plan,
    pub(super) folder: &'a Folder,
    pub(super) event_writer: EventWriter,
    pub(super) scenes: Scenes<'a>,
    context: Context,
}

/// The result of an attempt.
pub(super) enum Attempt<T> {
    Interrupted,
    Refused(Refusal),
    Accepted(T),
}

impl<'a> Slots<'a> {
    /// Prepares to fill the given number of slots.
    ///
    /// # Errors
    /// [`CliError::Serialise`].
    pub fn new(plan: &'a Plan, folder: &'a Folder, count: usize, context: Context) -> Result<Self, CliError> {
        let activity = format!("making {}", console::events(count));
        let event_writer = EventWriter::new(&context, &activity, folder, plan.settings, count)?;
        Ok(Self { plan, folder, event_writer, scenes: Scenes::of(plan), context })
    }

    /// Fills a slot, resuming where an earlier run stopped; `None` if interrupted. After every attempt the
    /// slot's record is written, so that no more than one attempt is ever lost.
    ///
    /// # Errors
    /// [`CliError::Exhausted`] and any failure of sampling, simulating and writing.
    pub fn fill(&self, index: usize) -> Result<Option<()>, CliError> {
        let (id, begun) = (self.plan.preset.id(index), Instant::now());
        let path = record_path(self.plan, self.folder, index);
        let mut record = SlotRecord::load(&path, &self.plan.fingerprint);
        if record.is_filled() && record.files().all(|file| file.verify(self.folder.path()).is_ok()) {
            self.report(&record, "kept");
            return Ok(Some(()));
        }
        (record.entries, record.set) = (Vec::new(), None);
        let limit = self.plan.preset.selection.map_or(1, |selection| selection.attempts);
        while record.refused.len() < limit {
            let number = record.refused.len();
            let refusal = match self.plan.composition.set(index) {
                Some(slot) => match self.attempt_set(index, &slot, number)? {
                    Attempt::Interrupted => return Ok(None),
                    Attempt::Refused(refusal) => Some(refusal),
                    Attempt::Accepted(made) => {
                        (record.entries, record.set) = self.keep_set(&id, index, &slot, number, &made)?;
                        None
                    }
                },
                None => {
                    let slot = self.plan.composition.slot(index);
                    match self.attempt(&id, index, &slot, number)? {
                        Attempt::Interrupted => return Ok(None),
                        Attempt::Refused(refusal) => Some(refusal),
                        Attempt::Accepted(event) => {
                            let entry = self.keep(&id, index, &event)?;
                            let (variant, split) = (Some(slot.variant), slot.split);
                            record.entries = vec![EventEntry { variant, split, ..entry }];
                            None
                        }
                    }
                }
            };
            if let Some(refusal) = refusal {
                self.context.detail(format!("{id} attempt {}: {}", number + 1, refusal.reason.name()));
                record.refused.push(refusal);
            }
            record.save(&path)?;
            if record.is_filled() {
                self.report(&record, &format!("{:.1} s", begun.elapsed().as_secs_f64()));
                return Ok(Some(()));
            }
        }
        Err(CliError::Exhausted { id, reasons: reasons(&record.refused) })
    }

    /// The slot's events are done.
    fn report(&self, record: &SlotRecord, how: &str) {
        let attempts = record.refused.len() + 1;
        let tried = if attempts == 1 { String::new() } else { format!(" at attempt {attempts}") };
        for entry in &record.entries {
            let variant = entry.variant.map_or("", phase_sampler::Variant::name);
            let (id, kind, length) = (&entry.id, entry.kind.name(), entry.steps);
            self.event_writer.finished(0, &format!("{id} {kind}, {variant}: {length} steps{tried} ({how})"));
        }
    }

    fn attempt(
        &self,
        id: &str,
        index: usize,
        slot: &EventSlot,
        number: usize,
    ) -> Result<Attempt<Event>, CliError> {
        let seed = engine::attempt_seed(self.plan.seed, index, number);
        let scene = self.scenes.scene(slot, seed, number)?;
        let settings = self.scenes.settings(scene.relation(), seed, index);
        let Some(event) = self.simulate(id, &scene, seed, &settings)? else {
            return Ok(Attempt::Interrupted);
        };
        let Some(selection) = &self.plan.preset.selection else { return Ok(Attempt::Accepted(event)) };
        let refused = |reason| Attempt::Refused(Refusal { variant: slot.variant, reason });
        let ending = ending(selection, slot.variant);
        // Cheap tests first; the counterfactual has to be simulated and comes last.
        let counterfactual = match check(&event, selection, ending) {
            Err(reason) => return Ok(refused(reason)),
            Ok(None) => return Ok(Attempt::Accepted(event)),
            Ok(Some(counterfactual)) => counterfactual,
        };
        let Some(without) = self.without(id, &event, &counterfactual, &settings)? else {
            return Ok(Attempt::Interrupted);
        };
        Ok(match counterfactual.judge(&event.scene, &Track::of_event(&event), &without) {
            Err(reason) => refused(reason),
            Ok(()) => Attempt::Accepted(event),
        })
    }

    /// What happens if the agent that is to make a difference does nothing; `None` if interrupted.
    pub(super) fn without(
        &self,
        id: &str,
        event: &Event,
        counterfactual: &Counterfactual,
        settings: &SimulationSettings,
    ) -> Result<Option<Track>, CliError> {
        let settings = SimulationSettings { idle: Some(counterfactual.idle), ..*settings };
        let without = self.simulate(id, &counterfactual.scene(&event.scene), event.seed, &settings)?;
        Ok(without.map(|event| Track::of_event(&event)))
    }

    pub(super) fn simulate(
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
    pub(super) fn keep(&self, id: &str, index: usize, event: &Event) -> Result<EventEntry, CliError> {
        let out = self.folder.path();
        let settings = self.scenes.settings(event.scene.relation(), event.seed, index);
        let job = EventJob {
            id: id.into(),
            seed: event.seed,
            relation: None,
            lengths: Some((settings.min_steps, settings.max_steps)),
            json: out.join(event_path(id)),
            video: self.plan.videos.then(|| out.join(video_path(id))),
        };
        self.event_writer.write(&job, event, true)?;
        EventEntry::of(out, id, event, self.plan.videos).map_err(CliError::ReadBack)
    }
}

/// The records of a run's slots, all of which are filled.
#[derive(Clone, Copy, Debug)]
pub struct FilledSlots<'a> {
    /// What is generated.
    pub plan: &'a Plan,
    /// Where.
    pub folder: &'a Folder,
}

impl Records for FilledSlots<'_> {
    fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_> {
        let Self { plan, folder } = *self;
        let load = |index| SlotRecord::load_filled(&record_path(plan, folder, index), &plan.fingerprint);
        Box::new(plan.slots().into_iter().map(load))
    }
}

fn record_path(plan: &Plan, folder: &Folder, index: usize) -> PathBuf {
    folder.cache().join(format!("{}.json", plan.preset.id(index)))
}

/// How an event of a variant ends.
pub(crate) const fn ending(selection: &Selection, variant: Variant) -> Ending {
    match selection.ends {
        Ends::Settled | Ends::AdversarialDrawn => Ending::Settled,
        Ends::Drawn => Ending::Drawn(manner_of(variant)),
    }
}

/// Everything that can be tested on the event alone.
pub(crate) fn check(
    event: &Event,
    selection: &Selection,
    ending: Ending,
) -> Result<Option<Counterfactual>, RejectionReason> {
    let lengths = selection.min_steps..=selection.max_steps;
    check_event(&event.scene, &Track::of_event(event), lengths, ending)
}

/// Variants, reasons and their numbers, in words.
fn reasons(refused: &[Refusal]) -> String {
    let counted =
        RejectionReason::ALL.map(|reason| (reason, refused.iter().filter(|it| it.reason == reason).count()));
    let words = counted.iter().filter(|(_, count)| *count > 0);
    words.map(|(reason, count)| format!("{} {count}", reason.name())).collect::<Vec<_>>().join(", ")
}
