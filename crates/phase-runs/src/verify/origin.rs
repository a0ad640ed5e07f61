//! Properties that a dataset's preset and seed give to each of its events: variant, split, seed, scene, and
//! that the event shows its label.

use super::{Checks, derived::command};
use crate::{
    engine::{GENERATOR, attempt_seed},
    error::RunError,
    gen_dataset::{Generation, description, plan::DatasetPlan, run_of, scenes::Scenes, slot::required},
};
use phase_dataset::{
    acceptance::Acceptance,
    event_set::member_id,
    manifest::{CARD_FILE, EventEntry, MANIFEST_FILE, Manifest},
};
use phase_event::Event;
use phase_evidence::{Track, selection::check_event};
use phase_files::{FileError, Problem};
use phase_model::Scene;
use phase_sampler::{Stance, Variant};
use phase_sim::SimulationSettings;
use std::{collections::BTreeMap, path::Path};

/// A field of an event's file, and the rule that it violates.
type Violation = (&'static str, String);

/// The events of a plan, as far as they do not depend on minds.
pub(super) struct Origin {
    plan: DatasetPlan,
    slots: Vec<Slot>,
}

/// Entry of the manifest's list of events for one event of the plan.
struct Slot {
    index: usize,
    /// The place among the events of a set, in the order of their names.
    member: usize,
}

impl Origin {
    /// The plan that the command in the card describes.
    pub(super) fn of(folder: &Path, manifest: &Manifest, checks: &Checks) -> Result<Self, Vec<FileError>> {
        let differs =
            |name: &str, what: String| FileError { file: folder.join(name), problem: Problem::Differs(what) };
        if manifest.generator != GENERATOR {
            let what =
                format!("what can be replayed: {} made it, and this is {GENERATOR}", manifest.generator);
            return Err(vec![differs(MANIFEST_FILE, what)]);
        }
        let plan = match plan(folder, checks) {
            Ok(Ok(plan)) => plan,
            Ok(Err(error)) => {
                let what = format!("what can be replayed: {error}");
                return Err(vec![differs(CARD_FILE, what)]);
            }
            Err(rule) => return Err(vec![differs(CARD_FILE, rule)]),
        };
        let slots = plan.slot_count;
        let found = run_of(&description(manifest, slots), None);
        let expected = plan.run();
        if let Some(difference) = expected.difference(found.value()) {
            return Err(vec![differs(CARD_FILE, format!("the manifest, which has {difference}"))]);
        }
        let origin = Self { slots: slots_of(&plan), plan };
        let problems: Vec<FileError> =
            origin.whole(manifest).into_iter().map(|rule| differs(MANIFEST_FILE, rule)).collect();
        if problems.is_empty() { Ok(origin) } else { Err(problems) }
    }

    /// The scenes of the plan.
    pub(super) fn scenes(&self) -> Scenes<'_> {
        Scenes::of(&self.plan)
    }

    /// Differences of the manifest from the plan, beside those of single events.
    fn whole(&self, manifest: &Manifest) -> Vec<String> {
        let mut rules = Vec::new();
        if self.slots.len() != manifest.events.len() {
            rules.push(format!("its preset, which has {} events", self.slots.len()));
        }
        for (slot, entry) in self.slots.iter().zip(&manifest.events) {
            let id = self.id(slot);
            if entry.id != id {
                rules.push(format!("its preset, which has {id} in place of {}", entry.id));
            }
        }
        if !rules.is_empty() {
            return rules;
        }
        if self.plan.composition.set(0).is_none() {
            rules.extend(self.attempts(manifest));
        } else {
            rules.extend(self.sets(manifest));
        }
        rules
    }

    /// The sets whose number of attempts or whose changed agent is not what the seed of their events tells.
    fn sets(&self, manifest: &Manifest) -> Vec<String> {
        let scenes = self.scenes();
        let firsts = self.slots.iter().zip(&manifest.events).filter(|(slot, _)| slot.member == 0);
        let wrong = firsts.filter_map(|(slot, entry)| {
            let id = self.plan.preset.id(slot.index);
            let plan = self.plan.composition.set(slot.index)?;
            let found = manifest.sets.iter().find(|set| set.id == id)?;
            // Those without a number, or without a scene, are reported as events.
            let number = self.attempt(slot.index, entry.seed)?;
            let changed = scenes.contrast(&plan, entry.seed).ok()?.changed;
            let right = found.attempts == number + 1 && found.changed == changed;
            (!right).then(|| format!("what the seed tells of the set {id}"))
        });
        let mut rules: Vec<String> = wrong.collect();
        if manifest.sets.len() != self.plan.slot_count {
            rules.push(format!("its preset, which has {} sets", self.plan.slot_count));
        }
        rules
    }

    fn id(&self, slot: &Slot) -> String {
        let id = self.plan.preset.id(slot.index);
        if self.plan.composition.set(slot.index).is_some() { member_id(&id, slot.member) } else { id }
    }

    /// Whether as many attempts are stated for each variant as the seeds of its events tell. Reasons are
    /// taken on trust.
    fn attempts(&self, manifest: &Manifest) -> Option<String> {
        let mut tally: BTreeMap<Variant, (usize, usize)> = BTreeMap::new();
        for (slot, entry) in self.slots.iter().zip(&manifest.events) {
            // Those without a number are reported as events.
            let number = self.attempt(slot.index, entry.seed)?;
            let row = tally.entry(self.plan.composition.slot(slot.index).variant).or_default();
            (row.0, row.1) = (row.0 + 1, row.1 + number + 1);
        }
        let row = |it: &Acceptance| (it.variant, (it.events, it.attempts));
        let stated: BTreeMap<Variant, (usize, usize)> = manifest.selection.iter().map(row).collect();
        let refused = |it: &Acceptance| it.refused.values().sum::<usize>() + it.events == it.attempts;
        let right = self.plan.preset.selection.is_none()
            || (stated == tally && manifest.selection.iter().all(refused));
        (!right).then(|| "the attempts that the seeds of its events tell in `selection`".into())
    }

    /// The number of the attempt that has a seed.
    fn attempt(&self, index: usize, seed: u64) -> Option<usize> {
        let limit = self.plan.preset.selection.map_or(1, |selection| selection.attempts);
        (0..limit).find(|&number| attempt_seed(self.plan.seed, index, number) == seed)
    }

    /// Checks an event, by its index among those of the dataset.
    pub(super) fn check(
        &self,
        scenes: &Scenes<'_>,
        index: usize,
        entry: &EventEntry,
        event: &Event,
        settings: &SimulationSettings,
    ) -> Result<(), Violation> {
        let slot = &self.slots[index];
        let Some(number) = self.attempt(slot.index, event.seed) else {
            return Err(("seed", format!("{} is that of no attempt at this event", event.seed)));
        };
        let unsampled = |error| ("seed", format!("leads to no scene: {error}"));
        let (scene, variant, split, stance) = match self.plan.composition.set(slot.index) {
            None => {
                let plan = self.plan.composition.slot(slot.index);
                let scene = scenes.scene(&plan, event.seed, number).map_err(unsampled)?;
                (scene, plan.variant, plan.split, None)
            }
            Some(set) => {
                let contrast = scenes.contrast(&set, event.seed).map_err(unsampled)?;
                let mut members: Vec<(Stance, Scene)> =
                    set.stances.iter().copied().zip(contrast.scenes).collect();
                scenes.order(slot.index, &mut members);
                let (stance, scene) = members.swap_remove(slot.member);
                (scene, stance.variant(set.about), set.split, Some(stance))
            }
        };
        if entry.variant != Some(variant) {
            return Err(("event", format!("is not of the variant {} in the manifest", variant.name())));
        }
        if entry.split != split {
            let name = split.map_or("none", phase_dataset::splits::Split::name);
            return Err(("event", format!("is in another split than its preset says: {name}")));
        }
        if entry.set.as_ref().map(|place| place.stance) != stance {
            return Err(("event", "has another stance than its preset says".into()));
        }
        if scene != event.scene {
            return Err(("layout", "and the rest of the scene are not what the seed leads to".into()));
        }
        if *settings != scenes.settings(scene.relation(), event.seed, slot.index) {
            return Err(("settings", "has other lengths than the seed leads to".into()));
        }
        let Some(selection) = &self.plan.preset.selection else { return Ok(()) };
        let (lengths, ending) = required(selection, variant, stance.is_some());
        match check_event(&event.scene, &Track::of_event(event), lengths, ending) {
            Ok(_) => Ok(()),
            Err(reason) => Err(("substeps", format!("do not show the label ({})", reason.name()))),
        }
    }
}

/// The plan of the command in the card: an error if there is no such command, an inner one if there is no
/// such preset here.
fn plan(folder: &Path, checks: &Checks) -> Result<Result<DatasetPlan, RunError>, String> {
    let text = command(folder).map_err(|error| error.to_string())?;
    let text = text.ok_or("a card, which has the command that made the dataset")?;
    if !text.starts_with("phase gen-dataset ") {
        return Err("a card, whose command is phase gen-dataset".into());
    }
    let generation = Generation::of_command(&text).ok_or("a card, whose command can be given")?;
    let preset = &generation.preset;
    if let Some(file) = &checks.preset {
        return Ok(DatasetPlan::with_preset_of(&generation, file));
    }
    if !phase_data::PRESETS.iter().any(|(name, _)| name == preset) {
        // The card may name any file, and is not believed.
        return Err(format!("what can be replayed: give the file of its preset, {preset:?}, with --preset"));
    }
    Ok(DatasetPlan::of(&generation))
}

/// The place of each event in a plan, in order.
fn slots_of(plan: &DatasetPlan) -> Vec<Slot> {
    let members = |index| plan.composition.set(index).map_or(1, |set| set.stances.len());
    (0..plan.slot_count)
        .flat_map(|index| (0..members(index)).map(move |member| Slot { index, member }))
        .collect()
}
