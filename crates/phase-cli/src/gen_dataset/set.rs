//! Filling a slot with a set: events with the same scene and seed that differ in the stance of one agent.

use super::slot::{Attempt, Slots, check};
use crate::{engine, error::CliError, picture};
use phase_dataset::{
    acceptance::Refusal,
    checksum::FileEntry,
    composition::SetSlot,
    event_set::{PairEntry, SetEntry, SetPlace, member_id, set_video_path},
    manifest::EventEntry,
};
use phase_event::Event;
use phase_evidence::{Track, selection::Ending};
use phase_model::AgentId;
use phase_sampler::Stance;

/// The events of a set, in the order of their names.
pub(super) struct MadeSet {
    changed: AgentId,
    members: Vec<(Stance, Event)>,
}

impl Slots<'_> {
    /// One scene in all its stances; every event has to show its label.
    pub(super) fn attempt_set(
        &self,
        index: usize,
        slot: &SetSlot,
        number: usize,
    ) -> Result<Attempt<MadeSet>, CliError> {
        let id = self.plan.preset.id(index);
        let seed = engine::attempt_seed(self.plan.seed, index, number);
        let (stances, about) = (&slot.stances[..], slot.about);
        let contrast = self.scenes.contrast(slot, seed)?;
        let mut members = Vec::with_capacity(stances.len());
        let mut to_compare = Vec::new();
        for (&stance, scene) in stances.iter().zip(&contrast.scenes) {
            let variant = stance.variant(about);
            let settings = self.scenes.settings(scene.relation(), seed, index);
            let Some(event) = self.simulate(&id, scene, seed, &settings)? else {
                return Ok(Attempt::Interrupted);
            };
            if let Some(selection) = &self.plan.preset.selection {
                match check(&event, selection, Ending::Drawn(None)) {
                    Err(reason) => return Ok(Attempt::Refused(Refusal { variant, reason })),
                    Ok(counterfactual) => to_compare.extend(counterfactual.map(|it| (members.len(), it))),
                }
            }
            members.push((stance, event));
        }
        // Where the changed agent does nothing, its stance makes no difference: one simulation serves all comparisons with it.
        let mut idle: Vec<(AgentId, Track)> = Vec::new();
        for (k, counterfactual) in to_compare {
            let (stance, event): &(Stance, Event) = &members[k];
            if !idle.iter().any(|(agent, _)| *agent == counterfactual.idle) {
                let settings = self.scenes.settings(event.scene.relation(), seed, index);
                let Some(track) = self.without(&id, event, &counterfactual, &settings)? else {
                    return Ok(Attempt::Interrupted);
                };
                idle.push((counterfactual.idle, track));
            }
            for (_, without) in idle.iter().filter(|(agent, _)| *agent == counterfactual.idle) {
                if let Err(reason) = counterfactual.judge(&event.scene, &Track::of_event(event), without) {
                    return Ok(Attempt::Refused(Refusal { variant: stance.variant(about), reason }));
                }
            }
        }
        self.scenes.order(index, &mut members);
        Ok(Attempt::Accepted(MadeSet { changed: contrast.changed, members }))
    }

    /// Writes the files of a set: those of its events, and the video that shows them side by side.
    pub(super) fn keep_set(
        &self,
        id: &str,
        index: usize,
        slot: &SetSlot,
        refused: usize,
        made: &MadeSet,
    ) -> Result<(Vec<EventEntry>, Option<SetEntry>), CliError> {
        let mut entries = Vec::with_capacity(made.members.len());
        for (k, (stance, event)) in made.members.iter().enumerate() {
            let entry = self.keep(&member_id(id, k), index, event)?;
            let set = Some(SetPlace { set: id.into(), stance: *stance });
            let (variant, split) = (Some(stance.variant(slot.about)), slot.split);
            entries.push(EventEntry { variant, split, set, ..entry });
        }
        let events: Vec<&Event> = made.members.iter().map(|(_, event)| event).collect();
        let named: Vec<(&str, &Event)> =
            entries.iter().map(|entry| entry.id.as_str()).zip(events.iter().copied()).collect();
        let pairs = PairEntry::all(&named);
        let out = self.folder.path();
        let video = if self.plan.videos {
            picture::write_side_by_side(&out.join(set_video_path(id)), id, &events)?;
            Some(FileEntry::of(out, set_video_path(id)).map_err(CliError::ReadBack)?)
        } else {
            None
        };
        let set = SetEntry { id: id.into(), changed: made.changed, attempts: refused + 1, pairs, video };
        Ok((entries, Some(set)))
    }
}
