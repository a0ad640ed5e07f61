//! Content of a slot of a dataset: the scenes of its attempts, their simulation, and the files of what is
//! accepted.

use super::{
    attempt::{Attempt, Cast, CastMember, Member},
    plan::DatasetPlan,
    scenes::Scenes,
    schedule::Part,
};
use crate::{
    engine,
    error::RunError,
    event_writer::{EventJob, EventWriter},
    interrupt,
    listener::Listener,
    words,
};
use core::ops::{ControlFlow, RangeInclusive};
use phase_dataset::{
    acceptance::Refusal,
    composition::manner_of,
    manifest::{EventEntry, event_path, video_path},
    preset::{Ends, Selection},
    slot_record::{Records, SlotRecord},
};
use phase_event::{Event, Step, mean_state};
use phase_evidence::{
    Track,
    selection::{Ending, RejectionReason, certain_rejection, check_event},
};
use phase_files::{FileError, folder::Folder};
use phase_model::Scene;
use phase_sampler::{SampleError, Variant};
use std::path::PathBuf;

/// The slots of a dataset that is being generated in a folder.
pub(super) struct Slots<'a> {
    pub(super) plan: &'a DatasetPlan,
    pub(super) folder: &'a Folder,
    pub(super) event_writer: EventWriter,
    pub(super) scenes: Scenes<'a>,
    listener: &'a dyn Listener,
}

impl<'a> Slots<'a> {
    /// Prepares to fill the given number of slots.
    ///
    /// # Errors
    /// [`RunError::Serialise`].
    pub(super) fn new(
        plan: &'a DatasetPlan,
        folder: &'a Folder,
        count: usize,
        listener: &'a dyn Listener,
    ) -> Result<Self, RunError> {
        let activity = format!("making {}", words::events(count));
        let event_writer = EventWriter::new(listener, &activity, folder, plan.settings, count)?;
        Ok(Self { plan, folder, event_writer, scenes: Scenes::of(plan), listener })
    }

    /// The record of a slot: filled, if its files are all there, or as far as an earlier run came.
    pub(super) fn load(&self, index: usize) -> SlotRecord {
        let mut record = SlotRecord::load(&self.record_path(index), &self.plan.fingerprint);
        if record.is_filled() && record.files().any(|file| file.verify(self.folder.path()).is_err()) {
            (record.entries, record.set) = (Vec::new(), None);
        }
        record
    }

    /// The id of a slot.
    pub(super) fn id(&self, index: usize) -> String {
        self.plan.preset.id(index)
    }

    /// Path of the record of a slot.
    pub(super) fn record_path(&self, index: usize) -> PathBuf {
        record_path(self.plan, self.folder, index)
    }

    /// Most attempts at a slot.
    pub(super) fn most_attempts(&self) -> usize {
        self.plan.preset.selection.map_or(1, |selection| selection.attempts)
    }

    /// The variants of a slot's events.
    pub(super) fn variants(&self, index: usize) -> Vec<Variant> {
        match self.plan.composition.set(index) {
            Some(slot) => slot.stances.iter().map(|stance| stance.variant(slot.about)).collect(),
            None => vec![self.plan.composition.slot(index).variant],
        }
    }

    /// The slot's events are done.
    pub(super) fn report(&self, record: &SlotRecord, how: &str) {
        let attempts = record.refused.len() + 1;
        let tried = if attempts == 1 { String::new() } else { format!(" at attempt {attempts}") };
        for entry in &record.entries {
            let variant = entry.variant.map_or("", Variant::name);
            let id = &entry.id;
            let kind = entry.kind.name();
            let length = entry.steps;
            self.event_writer.finished(0, &format!("{id} {kind}, {variant}: {length} steps{tried} ({how})"));
        }
    }

    /// An attempt was rejected.
    pub(super) fn report_refusal(&self, id: &str, number: usize, refusal: Refusal) {
        self.listener.detail(&format!("{id} attempt {}: {}", number + 1, refusal.reason.name()));
    }

    /// So many attempts were begun ahead and do not count.
    pub(super) fn report_dropped(&self, attempts: usize) {
        self.listener.detail(&format!("attempts begun ahead that did not count: {attempts}"));
    }

    /// Draws the scenes of an attempt.
    pub(super) fn cast(&self, index: usize, number: usize) -> Result<Cast, SampleError> {
        let seed = engine::attempt_seed(self.plan.seed, index, number);
        if let Some(slot) = self.plan.composition.set(index) {
            return self.cast_set(index, &slot, seed);
        }
        let slot = self.plan.composition.slot(index);
        let scene = self.scenes.scene(&slot, seed, number)?;
        let settings = self.scenes.settings(scene.relation(), seed, index);
        let members = vec![CastMember { stance: None, variant: slot.variant, scene, settings }];
        Ok(Cast { seed, changed: None, members, compared: self.plan.preset.selection.is_some() })
    }

    /// Runs a simulation of an attempt, and adds it to its results; `false` if interrupted or no longer
    /// wanted.
    pub(super) fn simulate(&self, index: usize, attempt: &Attempt, part: Part) -> Result<bool, RunError> {
        let Some(cast) = attempt.cast() else { return Ok(false) };
        let Some((scene, settings)) = cast.simulation(part) else { return Ok(false) };
        let id = self.plan.preset.id(index);
        let simulate = |on_step: &mut dyn FnMut(&Step) -> ControlFlow<()>| {
            engine::simulate(&id, &scene, cast.seed, &settings, on_step)
        };
        match part {
            Part::Member(k) => {
                let member = &cast.members[k];
                let selection = self.plan.preset.selection.as_ref();
                let mut watch = Watch::new(
                    &scene,
                    selection.map(|it| required(it, member.variant, member.stance.is_some())),
                );
                let event = simulate(&mut |step| {
                    attempt.goes_on(interrupt::requested())?;
                    watch.goes_on(step)
                })?;
                let Some(member) = watch.judge(event) else { return Ok(false) };
                attempt.results().add_member(k, member);
            }
            Part::Idle { member, agent } => {
                let event = simulate(&mut |_| attempt.goes_on(interrupt::requested()))?;
                let Some(event) = event else { return Ok(false) };
                let track = Track::of_event(&event);
                attempt.results().add_idle(member, agent, track);
            }
        }
        Ok(true)
    }

    /// Writes the files of a slot, and enters them in its record.
    pub(super) fn keep(
        &self,
        index: usize,
        cast: &Cast,
        events: Vec<Event>,
        record: &mut SlotRecord,
    ) -> Result<(), RunError> {
        let id = self.plan.preset.id(index);
        if let (Some(slot), Some(changed)) = (self.plan.composition.set(index), cast.changed) {
            let stances = cast.members.iter().filter_map(|member| member.stance);
            let events = stances.zip(events).collect();
            let attempts = record.refused.len() + 1;
            let (entries, set) = self.keep_set(&id, index, &slot, (changed, attempts), events)?;
            (record.entries, record.set) = (entries, Some(set));
            return Ok(());
        }
        let slot = self.plan.composition.slot(index);
        for event in &events {
            let entry = self.keep_event(&id, index, event)?;
            record.entries.push(EventEntry { variant: Some(slot.variant), split: slot.split, ..entry });
        }
        Ok(())
    }

    /// Writes the files of an accepted event.
    pub(super) fn keep_event(&self, id: &str, index: usize, event: &Event) -> Result<EventEntry, RunError> {
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
        EventEntry::of(out, id, event, self.plan.videos).map_err(RunError::ReadBack)
    }
}

/// The records of a run's slots, all of which are filled.
#[derive(Clone, Copy, Debug)]
pub(super) struct FilledSlots<'a> {
    /// Plan of the dataset that is generated.
    pub(super) plan: &'a DatasetPlan,
    /// Folder of the dataset.
    pub(super) folder: &'a Folder,
}

impl Records for FilledSlots<'_> {
    fn records(&self) -> Box<dyn Iterator<Item = Result<SlotRecord, FileError>> + '_> {
        let Self { plan, folder } = *self;
        let load = |index| SlotRecord::load_filled(&record_path(plan, folder, index), &plan.fingerprint);
        Box::new(plan.slots().into_iter().map(load))
    }
}

fn record_path(plan: &DatasetPlan, folder: &Folder, index: usize) -> PathBuf {
    folder.cache().join(format!("{}.json", plan.preset.id(index)))
}

/// An event under test while it is simulated.
struct Watch<'a> {
    scene: &'a Scene,
    required: Option<(RangeInclusive<usize>, Ending)>,
    track: Track,
    lost: Option<RejectionReason>,
}

impl<'a> Watch<'a> {
    fn new(scene: &'a Scene, required: Option<(RangeInclusive<usize>, Ending)>) -> Self {
        let track = Track { physics: scene.physics(), states: vec![scene.initial_state()] };
        Self { scene, required, track, lost: None }
    }

    /// To be asked after every step: an event whose rejection is certain need not go on.
    fn goes_on(&mut self, step: &Step) -> ControlFlow<()> {
        self.track.states.push(mean_state(step));
        let Some((lengths, ending)) = &self.required else { return ControlFlow::Continue(()) };
        self.lost = certain_rejection(self.scene, &self.track, lengths.clone(), *ending);
        if self.lost.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The result, if the event was completed or lost.
    fn judge(self, event: Option<Event>) -> Option<Result<Member, RejectionReason>> {
        if let Some(reason) = self.lost {
            return Some(Err(reason));
        }
        let event = event?;
        let checked = match self.required {
            Some((lengths, ending)) => check_event(&event.scene, &self.track, lengths, ending),
            None => Ok(None),
        };
        Some(checked.map(|counterfactual| Member { event, track: self.track, counterfactual }))
    }
}

/// Requirements on an event of a variant: its length (steps), and its ending. One of a set may show its
/// label in any manner.
pub(crate) fn required(
    selection: &Selection,
    variant: Variant,
    of_set: bool,
) -> (RangeInclusive<usize>, Ending) {
    let ending = match selection.ends {
        Ends::Settled | Ends::AdversarialDrawn => Ending::Settled,
        Ends::Drawn => Ending::Drawn(manner_of(variant).filter(|_| !of_set)),
    };
    (selection.min_steps..=selection.max_steps, ending)
}

/// Variants, reasons and their numbers, in words.
pub(super) fn reasons(refused: &[Refusal]) -> String {
    let counted =
        RejectionReason::ALL.map(|reason| (reason, refused.iter().filter(|it| it.reason == reason).count()));
    let words = counted.iter().filter(|(_, count)| *count > 0);
    words.map(|(reason, count)| format!("{} {count}", reason.name())).collect::<Vec<_>>().join(", ")
}
