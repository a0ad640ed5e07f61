//! Filling a slot with a set: events with the same scene and seed that differ in the stance of one agent.

use super::slot::{Cast, CastMember, Slots};
use crate::{
    error::RunError,
    picture::{self, Look},
};
use phase_dataset::{
    composition::SetSlot,
    event_set::{PairEntry, SetEntry, SetPlace, member_id, set_video_path},
    manifest::EventEntry,
};
use phase_event::Event;
use phase_files::measured;
use phase_model::{AgentId, Scene};
use phase_sampler::{SampleError, Stance};

impl Slots<'_> {
    /// One scene in all its stances.
    pub(super) fn cast_set(&self, index: usize, slot: &SetSlot, seed: u64) -> Result<Cast, SampleError> {
        let stances = &slot.stances[..];
        let about = slot.about;
        let contrast = self.scenes.contrast(slot, seed)?;
        let member = |(&stance, scene): (&Stance, Scene)| {
            let settings = self.scenes.settings(scene.relation(), seed, index);
            CastMember { stance: Some(stance), variant: stance.variant(about), scene, settings }
        };
        let members = stances.iter().zip(contrast.scenes).map(member).collect();
        Ok(Cast { seed, changed: Some(contrast.changed), members })
    }

    /// Writes the files of a set: those of its events, and the video that shows them side by side. `changed`
    /// is the agent whose stance differs, and `attempts` how many it took.
    pub(super) fn keep_set(
        &self,
        id: &str,
        index: usize,
        slot: &SetSlot,
        (changed, attempts): (AgentId, usize),
        mut events: Vec<(Stance, Event)>,
    ) -> Result<(Vec<EventEntry>, SetEntry), RunError> {
        self.scenes.order(index, &mut events);
        let mut entries = Vec::with_capacity(events.len());
        for (k, (stance, event)) in events.iter().enumerate() {
            let entry = self.keep_event(&member_id(id, k), index, event)?;
            let set = Some(SetPlace { set: id.into(), stance: *stance });
            let variant = Some(stance.variant(slot.about));
            let split = slot.split;
            entries.push(EventEntry { variant, split, set, ..entry });
        }
        let events: Vec<&Event> = events.iter().map(|(_, event)| event).collect();
        let named: Vec<(&str, &Event)> =
            entries.iter().map(|entry| entry.id.as_str()).zip(events.iter().copied()).collect();
        let pairs = PairEntry::all(&named);
        let out = self.folder.path();
        let video = if self.plan.videos {
            Some(measured::write(
                out,
                set_video_path(id),
                &picture::beside(id, &events, &Look::of(&self.plan.form)?)?,
            )?)
        } else {
            None
        };
        Ok((entries, SetEntry { id: id.into(), changed, attempts, pairs, video }))
    }
}
