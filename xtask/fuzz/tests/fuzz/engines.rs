//! Bounds of what both engines do wrong. `cargo xtask check-engines` measures the same in more scenes;
//! `docs/explanation/physics.md` explains it.

use phase_fuzz::{
    engines::{GAIN, Kind, energy_gains, meetings, overlaps, rebuilt},
    scenes::Start,
};
use proptest::prelude::*;

/// Scenes of one draw.
const SCENES: u64 = 12;

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// From starts at rest without overlaps, engines make hardly any energy where nothing is held.
    #[test]
    fn energy_comes_from_somewhere(seed in 0..u64::MAX / 2) {
        for kind in [Kind::World, Kind::Kernel, Kind::KernelWithCache] {
            let gains = energy_gains(kind, Start::Apart, seed..seed + SCENES);
            prop_assert_eq!(gains.separating, 0, "{}: {:?}", kind.name(), gains);
            prop_assert!(gains.free <= 3 && gains.most_free <= 2.0, "{}: {:?}", kind.name(), gains);
        }
    }

    /// The kernel, from a state alone, separates what overlaps at rest without making energy.
    #[test]
    fn the_kernel_separates_gently(seed in 0..u64::MAX / 2) {
        let gains = energy_gains(Kind::Kernel, Start::Overlapping, seed..seed + SCENES);
        prop_assert_eq!((gains.separating, gains.free), (0, 0), "{:?}", gains);
    }

    /// Bodies that start at rest overlap by no more than what they move in a substep, or a released object
    /// may; and not for long.
    #[test]
    fn overlaps_come_from_speed(seed in 0..u64::MAX / 2) {
        for (kind, beyond, longest) in
            [(Kind::World, 0.6, 20), (Kind::Kernel, 0.6, 25), (Kind::KernelWithCache, 0.9, 60)]
        {
            let found = overlaps(kind, Start::Apart, seed..seed + SCENES);
            prop_assert!(found.beyond <= beyond && found.longest <= longest, "{}: {:?}", kind.name(), found);
        }
    }

    /// A copy of a world has all that the world remembers.
    #[test]
    fn copies_continue_bit_for_bit(seed in 0..u64::MAX / 2) {
        let found = rebuilt(seed..seed + SCENES);
        prop_assert_eq!(found.copies_differ, 0);
        prop_assert!(found.apart.is_none_or(|[half, ..]| half <= 1.0e-4), "{:?}", found);
    }
}

/// Scenes of tests whose bounds are those of shares and quantiles: always the same ones.
const MANY: core::ops::Range<u64> = 0..250;

#[test]
fn energy_is_rarely_made_by_grips() {
    for (kind, share, most) in
        [(Kind::World, 1.0e-3, 1500.0), (Kind::Kernel, 2.0e-4, 50.0), (Kind::KernelWithCache, 2.0e-4, 50.0)]
    {
        let gains = energy_gains(kind, Start::Fast, MANY);
        assert!(gains.substeps > 20_000);
        let found = gains.holding as f32 / gains.substeps as f32;
        assert!(found <= share && gains.most_holding <= most, "{}: {gains:?}", kind.name());
    }
}

/// Engines make no energy in these scenes of bodies that start fast, as long as nothing is held. In millions
/// of substeps of others there are a few gains.
#[test]
fn energy_is_hardly_ever_made_by_speed() {
    for kind in [Kind::World, Kind::Kernel, Kind::KernelWithCache] {
        let gains = energy_gains(kind, Start::Fast, MANY);
        assert_eq!((gains.separating, gains.free), (0, 0), "{}: {gains:?}", kind.name());
    }
}

/// The measure finds what is known to be there: bodies that start across a wall and the boundary.
#[test]
fn energy_of_starts_across_walls_is_found() {
    let gains = energy_gains(Kind::World, Start::Overlapping, MANY);
    assert!(gains.separating > 0 && gains.most_separating > GAIN, "{gains:?}");
    assert!(gains.separating <= 50, "{gains:?}");
}

#[test]
fn worlds_rebuilt_from_their_state_differ_in_last_bits() {
    let found = rebuilt(MANY);
    assert!(found.steps > 9_000);
    let share = found.differ as f32 / found.steps as f32;
    assert!((0.01..=0.25).contains(&share), "{found:?}");
    let [half, nine, ninety, _] = found.apart.expect("some differ");
    assert!(half <= 1.0e-5 && nine <= 2.0e-4 && ninety <= 2.0e-3, "{found:?}");
    assert!(found.most_released <= 0.2, "{found:?}");
}

#[test]
fn meetings_of_two_agents_keep_their_accuracy() {
    let found = meetings(0..800);
    assert!(found.count >= 150);
    let nine = |errors: Option<[f32; 4]>| errors.expect("steps")[1];
    assert!(nine(found.one_step) <= 0.03, "{found:?}");
    assert!(nine(found.contact) <= 0.05, "{found:?}");
    assert!(nine(found.all) <= 0.25, "{found:?}");
    assert!(nine(found.disturbed) <= 1.0e-3, "{found:?}");
}
