//! The blocks of the bundled presets have stages.

use phase_dataset::{composition::Composition, preset::Preset};
use phase_model::random::{Purpose, stream};
use phase_sampler::{Stage, Starts};

/// Otherwise a run would end in the middle.
#[test]
fn every_block_has_a_stage_in_its_layouts() {
    for text in [phase_data::PHASE_500, phase_data::PHASE_TRAINING] {
        let preset = Preset::parse("preset", text).expect("a preset");
        let composition = Composition::of(&preset);
        let mut missing = Vec::new();
        for first in (0..preset.events()).step_by(5) {
            let slot = composition.slot(first);
            let place = slot.block.expect("is in a block");
            let (parts, mut layouts) = (composition.parts(place), preset.pool(&slot.layouts));
            let turn = place.block * 11 % layouts.len();
            layouts.rotate_left(turn);
            let mut random = stream(5, Purpose::Stage, first as u64);
            if Stage::sample(&parts, &layouts, Starts::Near, &mut random).is_err() {
                missing.push(parts);
            }
        }
        assert!(missing.is_empty(), "{} of {}: {missing:?}", missing.len(), preset.events() / 5);
    }
}
