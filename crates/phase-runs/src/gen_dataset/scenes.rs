//! The scenes that are tried for the slots of a dataset. They follow from its preset and seed alone.

use super::plan::DatasetPlan;
use crate::engine;
use phase_dataset::{
    composition::{BlockPlace, Composition, EventSlot, SetSlot},
    preset::Preset,
};
use phase_model::{
    Layout, Relation, Scene,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_sampler::{Contrast, ContrastRequest, Request, SampleError, Stage, Starts, sample};
use phase_sim::SimulationSettings;
use rand::{RngExt, seq::SliceRandom};
use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

/// Attempts on one stage before another is drawn: there are several assignments of roles and many seeds, and
/// a stage that some variant rejects is a stage that the others of its block have alone.
const ATTEMPTS_PER_STAGE: usize = 3;
/// Maximum number of stages kept.
const MAX_STAGES: usize = 1000;
/// Layouts from one block to the next. Coprime to the sizes of the pools of bundled presets: blocks that
/// follow one another have different base layouts.
const LAYOUT_STRIDE: usize = 11;

/// Draws a scene as a preset has them, from a seed: of a random one of its slots, with that slot's variant,
/// goals and layouts.
///
/// # Errors
/// If none can be drawn.
pub fn any_scene(preset: &Preset, seed: u64) -> Result<Scene, SampleError> {
    let starts = Starts::Near;
    let composition = Composition::of(preset);
    let mut random = random::stream(seed, Purpose::Scene, 0);
    let slots = composition.slots(preset.events()).unwrap_or_default().max(1);
    let index = random.random_range(0..slots);
    if let Some(set) = composition.set(index) {
        let mut scenes = contrast(&set, &preset.pool(&set.layouts), starts, &mut random)?.scenes;
        return Ok(scenes.swap_remove(random.random_range(0..set.stances.len())));
    }
    let slot = composition.slot(index);
    let EventSlot { variant, goal_index, ref layouts, block, .. } = slot;
    let layouts = preset.pool(layouts);
    let scene = match block {
        Some(place) => Stage::sample(&composition.parts(place), &layouts, starts, &mut random)?
            .scene(slot.part(), &mut random)?,
        None => sample(&Request { variant, goal_index, layouts: &layouts, starts }, &mut random)?,
    };
    Ok(slot.with_knowledge(scene))
}

fn contrast(
    slot: &SetSlot,
    layouts: &[Layout],
    starts: Starts,
    random: &mut Pcg64Mcg,
) -> Result<Contrast, SampleError> {
    let SetSlot { stances, about, goal_index, .. } = slot;
    let request = ContrastRequest { stances, about: *about, goal_index: *goal_index, layouts, starts };
    Contrast::sample(&request, random)
}

/// A stage, or that there is none, once that is known.
type DrawnStage = OnceLock<Result<Stage, SampleError>>;

/// The scenes of a dataset's slots.
#[derive(Debug)]
pub(crate) struct Scenes<'a> {
    preset: &'a Preset,
    composition: &'a Composition,
    seed: u64,
    starts: Starts,
    settings: SimulationSettings,
    pools: BTreeMap<String, Vec<Layout>>,
    /// Stages by block and number, which all slots of a block share.
    stages: Mutex<BTreeMap<(usize, usize), Arc<DrawnStage>>>,
}

impl<'a> Scenes<'a> {
    /// The scenes of a plan.
    pub(crate) fn of(plan: &'a DatasetPlan) -> Self {
        let DatasetPlan { preset, composition, seed, settings, form, .. } = plan;
        let pools = preset.layouts.keys().map(|name| (name.clone(), preset.pool(name))).collect();
        let (seed, starts, settings) = (*seed, form.starts, *settings);
        Self { preset, composition, seed, starts, settings, pools, stages: Mutex::default() }
    }

    fn pool(&self, name: &str) -> &[Layout] {
        self.pools.get(name).map_or(&[][..], Vec::as_slice)
    }

    /// The scene of an attempt, by the attempt's seed and number: with bodies of its own, or cast on the
    /// stage of its block.
    pub(crate) fn scene(&self, slot: &EventSlot, seed: u64, number: usize) -> Result<Scene, SampleError> {
        let layouts = self.pool(&slot.layouts);
        let mut random = random::stream(seed, Purpose::Scene, 0);
        let variant = slot.variant;
        let goal_index = slot.goal_index;
        let scene = match slot.block {
            Some(place) => {
                let stage = self.stage(place, layouts, number / ATTEMPTS_PER_STAGE)?;
                stage.scene(slot.part(), &mut random)?
            }
            None => sample(&Request { variant, goal_index, layouts, starts: self.starts }, &mut random)?,
        };
        Ok(slot.with_knowledge(scene))
    }

    /// The scenes of an attempt at a set, in the order of its stances.
    pub(crate) fn contrast(&self, slot: &SetSlot, seed: u64) -> Result<Contrast, SampleError> {
        let mut random = random::stream(seed, Purpose::Scene, 0);
        contrast(slot, self.pool(&slot.layouts), self.starts, &mut random)
    }

    /// Puts the events of a set, which are in the order of its stances, in the order of their names, which
    /// reveals nothing.
    pub(crate) fn order<T>(&self, index: usize, members: &mut [T]) {
        let slot_seed = engine::event_seed(self.seed, index);
        members.shuffle(&mut random::stream(slot_seed, Purpose::Scene, 0));
    }

    /// A stage of a block, by its number. It is drawn once; whoever needs it meanwhile waits for it.
    fn stage(&self, place: BlockPlace, layouts: &[Layout], number: usize) -> Result<Stage, SampleError> {
        let drawn = {
            let mut stages = self.stages.lock().unwrap_or_else(PoisonError::into_inner);
            if stages.len() == MAX_STAGES && !stages.contains_key(&(place.block, number)) {
                // Blocks are filled nearly in order, so the first are the least likely to be needed again.
                stages.pop_first();
            }
            Arc::clone(stages.entry((place.block, number)).or_default())
        };
        drawn.get_or_init(|| self.draw_stage(place, layouts, number)).clone()
    }

    fn draw_stage(&self, place: BlockPlace, layouts: &[Layout], number: usize) -> Result<Stage, SampleError> {
        let parts = self.composition.parts(place);
        let block = random::derive_seed(self.seed, Purpose::Stage, place.block as u64);
        let mut random = random::stream(block, Purpose::Stage, number as u64);
        // Blocks begin with different layouts, so that all are used.
        let mut layouts = layouts.to_vec();
        let turn = (place.block + number) * LAYOUT_STRIDE % layouts.len().max(1);
        layouts.rotate_left(turn);
        Stage::sample(&parts, &layouts, self.starts, &mut random)
    }

    /// The run's settings for the attempt with this seed at a slot, with a sampled length if the preset
    /// requires it.
    pub(crate) fn settings(&self, relation: Relation, seed: u64, index: usize) -> SimulationSettings {
        let mut settings = self.settings;
        let slot = engine::event_seed(self.seed, index);
        if let Some((min, max)) = self.preset.selection.and_then(|it| it.sampled_length(relation, seed, slot))
        {
            (settings.min_steps, settings.max_steps) = (settings.min_steps.max(min), max);
        }
        settings
    }
}
