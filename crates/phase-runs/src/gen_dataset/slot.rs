//! Content of a slot of a dataset: the scenes of its attempts, their simulation, and the files of what is
//! accepted.

use super::{plan::DatasetPlan, scenes::Scenes};
use crate::{
    engine,
    error::RunError,
    event_writer::{EventFiles, EventJob, EventWriter},
    interrupt,
    listener::Listener,
    picture::Look,
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
    selection::{Counterfactual, Ending, RejectionReason, certain_rejection, check_discovery, check_event},
};
use phase_files::{FileError, folder::Folder};
use phase_model::{AgentId, Scene};
use phase_sampler::{SampleError, Stance, Variant};
use phase_sim::SimulationSettings;
use std::{
    collections::{BTreeMap, btree_map::Entry},
    path::PathBuf,
    time::Instant,
};

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
    pub(super) fn new(
        plan: &'a DatasetPlan,
        folder: &'a Folder,
        count: usize,
        listener: &'a dyn Listener,
    ) -> Result<Self, RunError> {
        let activity = format!("making {}", words::events(count));
        let event_writer = EventWriter::new(listener, &activity, folder, plan.settings, count)?
            .with_look(Look::of(&plan.form)?);
        Ok(Self { plan, folder, event_writer, scenes: Scenes::of(plan), listener })
    }

    /// Tries scenes for a slot until one shows its label, and writes its files; `None` if interrupted. After
    /// every refusal the slot's record is written, so no more is ever lost than the attempt under way.
    pub(super) fn fill(&self, index: usize) -> Result<Option<()>, RunError> {
        let begun = Instant::now();
        let path = self.record_path(index);
        let mut record = self.load(index);
        if record.is_filled() {
            self.report(&record, "kept");
            return Ok(Some(()));
        }
        let id = self.plan.preset.id(index);
        let attempts = self.plan.preset.selection.map_or(1, |selection| selection.attempts);
        while record.refused.len() < attempts {
            let number = record.refused.len();
            let cast = self.cast(index, number)?;
            match self.attempt(&id, &cast)? {
                None => return Ok(None),
                Some(Ok(events)) => {
                    self.keep(index, &cast, events, &mut record)?;
                    record.save(&path)?;
                    self.report(&record, &format!("{:.1} s", begun.elapsed().as_secs_f64()));
                    return Ok(Some(()));
                }
                Some(Err(refusal)) => {
                    let reason = refusal.reason.name();
                    self.listener.detail(&format!("{id} attempt {}: {reason}", number + 1));
                    self.event_writer.tried();
                    record.refused.push(refusal);
                    record.save(&path)?;
                }
            }
        }
        Err(RunError::Exhausted { id, reasons: reasons(&record.refused) })
    }

    /// The record of a slot: filled, if its files are all there, or as far as an earlier run came.
    fn load(&self, index: usize) -> SlotRecord {
        let mut record = SlotRecord::load(&self.record_path(index), &self.plan.fingerprint);
        if record.is_filled() && record.files().any(|file| file.verify(self.folder.path()).is_err()) {
            (record.entries, record.set) = (Vec::new(), None);
        }
        record
    }

    /// Path of the record of a slot.
    fn record_path(&self, index: usize) -> PathBuf {
        record_path(self.plan, self.folder, index)
    }

    /// The slot's events are done.
    fn report(&self, record: &SlotRecord, how: &str) {
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

    /// Draws the scenes of an attempt.
    fn cast(&self, index: usize, number: usize) -> Result<Cast, SampleError> {
        let seed = engine::attempt_seed(self.plan.seed, index, number);
        if let Some(slot) = self.plan.composition.set(index) {
            return self.cast_set(index, &slot, seed);
        }
        let slot = self.plan.composition.slot(index);
        let scene = self.scenes.scene(&slot, seed, number)?;
        let settings = self.scenes.settings(scene.relation(), seed, index);
        let members = vec![CastMember { stance: None, variant: slot.variant, scene, settings }];
        Ok(Cast { seed, changed: None, members })
    }

    /// Simulates the events of an attempt, and where necessary what happens while an agent is idle: the
    /// events, or the first reason in order for which one of them is refused; `None` if interrupted.
    fn attempt(&self, id: &str, cast: &Cast) -> Result<Option<Result<Vec<Event>, Refusal>>, RunError> {
        let mut shown = Vec::with_capacity(cast.members.len());
        for member in &cast.members {
            match self.simulate(id, cast.seed, member)? {
                None => return Ok(None),
                Some(Ok(event)) => shown.push(event),
                Some(Err(reason)) => return Ok(Some(Err(member.refusal(reason)))),
            }
        }
        let mut idle: BTreeMap<AgentId, Track> = BTreeMap::new();
        for (member, ShownEvent { event, track, counterfactual }) in cast.members.iter().zip(&shown) {
            let Some(counterfactual) = counterfactual else { continue };
            // Where the changed agent of a set does nothing, its stance makes no difference: one simulation
            // serves all comparisons with it.
            let without = match idle.entry(counterfactual.idle) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(place) => {
                    let settings = SimulationSettings { idle: Some(counterfactual.idle), ..member.settings };
                    let scene = counterfactual.scene(&member.scene);
                    let go_on = &mut |_: &Step| interrupt::goes_on();
                    let event = engine::simulate(id, &scene, cast.seed, &settings, go_on)?;
                    let Some(event) = event else { return Ok(None) };
                    place.insert(Track::of_event(&event))
                }
            };
            if let Err(reason) = counterfactual.judge(&event.scene, track, without) {
                return Ok(Some(Err(member.refusal(reason))));
            }
        }
        Ok(Some(Ok(shown.into_iter().map(|shown| shown.event).collect())))
    }

    /// Simulates one event of an attempt and tests it by itself; `None` if interrupted.
    fn simulate(
        &self,
        id: &str,
        seed: u64,
        member: &CastMember,
    ) -> Result<Option<Result<ShownEvent, RejectionReason>>, RunError> {
        let CastMember { scene, settings, .. } = member;
        let selection = self.plan.preset.selection.as_ref();
        let of_set = member.stance.is_some();
        let mut watch = Watch::new(scene, selection.map(|it| required(it, member.variant, of_set)));
        let event = engine::simulate(id, scene, seed, settings, &mut |step| {
            interrupt::goes_on()?;
            watch.goes_on(step)
        })?;
        Ok(watch.judge(event))
    }

    /// Writes the files of a slot, and enters them in its record.
    fn keep(
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
        let settings = self.scenes.settings(event.scene.relation(), event.seed, index);
        let job = EventJob {
            id: id.into(),
            seed: event.seed,
            relation: None,
            lengths: Some((settings.min_steps, settings.max_steps)),
            json: event_path(id),
            video: self.plan.videos.then(|| video_path(id)),
        };
        let EventFiles { json, video } = self.event_writer.write(&job, event, true)?;
        Ok(EventEntry::with_files(id, event, json, video))
    }
}

/// The scenes of an attempt. They depend on the dataset's seed, the slot and the attempt's number alone.
#[derive(Debug)]
pub(super) struct Cast {
    pub(super) seed: u64,
    /// The agent whose stance differs, in a set.
    pub(super) changed: Option<AgentId>,
    /// One for each event.
    pub(super) members: Vec<CastMember>,
}

/// A scene to be simulated.
#[derive(Debug)]
pub(super) struct CastMember {
    /// The stance of the changed agent, in a set.
    pub(super) stance: Option<Stance>,
    pub(super) variant: Variant,
    pub(super) scene: Scene,
    pub(super) settings: SimulationSettings,
}

impl CastMember {
    const fn refusal(&self, reason: RejectionReason) -> Refusal {
        Refusal { variant: self.variant, reason }
    }
}

/// An event that has passed the tests on itself, and the comparison that it needs.
#[derive(Debug)]
struct ShownEvent {
    event: Event,
    track: Track,
    counterfactual: Option<Counterfactual>,
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
    fn judge(self, event: Option<Event>) -> Option<Result<ShownEvent, RejectionReason>> {
        if let Some(reason) = self.lost {
            return Some(Err(reason));
        }
        let event = event?;
        let checked = match self.required {
            Some((lengths, ending)) => check_event(&event.scene, &self.track, lengths, ending)
                .and_then(|counterfactual| check_discovery(&event).map(|()| counterfactual)),
            None => Ok(None),
        };
        Some(checked.map(|counterfactual| ShownEvent { event, track: self.track, counterfactual }))
    }
}

/// Requirements on an event of a variant: its length (steps), and its ending. One of a set may show its
/// label in any manner: all events of a set have to show their labels, which few stages allow.
pub(crate) fn required(
    selection: &Selection,
    variant: Variant,
    of_set: bool,
) -> (RangeInclusive<usize>, Ending) {
    let ending = match selection.ends {
        Ends::Settled | Ends::AdversarialDrawn => Ending::Settled,
        Ends::Drawn => Ending::Drawn { manner: manner_of(variant).filter(|_| !of_set) },
    };
    (selection.min_steps..=selection.max_steps, ending)
}

/// Variants, reasons and their numbers, in words.
fn reasons(refused: &[Refusal]) -> String {
    let counted =
        RejectionReason::ALL.map(|reason| (reason, refused.iter().filter(|it| it.reason == reason).count()));
    let words = counted.iter().filter(|(_, count)| *count > 0);
    words.map(|(reason, count)| format!("{} {count}", reason.name())).collect::<Vec<_>>().join(", ")
}
