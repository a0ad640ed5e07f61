//! Where the rocks are, in published problems.

use rand::{Rng, RngExt};

/// A map of RockSample: x to the east, y to the north, from 0.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    /// Squares on a side.
    pub(crate) side: i8,
    /// Where the rover starts.
    pub(crate) start: [i8; 2],
    pub(crate) rocks: Vec<[i8; 2]>,
}

/// A map as a constant.
pub(crate) struct Published {
    side: i8,
    start: [i8; 2],
    rocks: &'static [[i8; 2]],
}

impl From<&Published> for Layout {
    fn from(published: &Published) -> Self {
        Self { side: published.side, start: published.start, rocks: published.rocks.to_vec() }
    }
}

/// `RockSample_7_8.pomdpx` of APPL (SARSOP), as in the sources of POMCP and DESPOT (`Init_7_8`).
pub(crate) const SARSOP_7_8: Published = Published {
    side: 7,
    start: [0, 3],
    rocks: &[[2, 0], [0, 1], [3, 1], [6, 3], [2, 4], [3, 4], [5, 5], [1, 6]],
};

/// `RockSample_11_11.pomdpx` of APPL (SARSOP), as in the sources of POMCP and DESPOT (`Init_11_11`).
pub(crate) const SARSOP_11_11: Published = Published {
    side: 11,
    start: [0, 5],
    rocks: &[[0, 3], [0, 7], [1, 8], [2, 4], [3, 3], [3, 8], [4, 3], [5, 8], [6, 1], [9, 3], [9, 9]],
};

/// The map of DESPOT.jl (JuliaPOMDP), `init_15_15`: its rows count from the north, here from the south. The
/// sources of POMCP and DESPOT have no map of this size and sample one, as [`random`] does.
pub(crate) const DESPOT_JL_15_15: Published = Published {
    side: 15,
    start: [0, 9],
    rocks: &[
        [0, 7],
        [0, 11],
        [1, 12],
        [2, 8],
        [3, 7],
        [3, 12],
        [4, 7],
        [5, 12],
        [6, 5],
        [9, 7],
        [9, 13],
        [11, 6],
        [13, 4],
        [14, 5],
        [12, 12],
    ],
};

/// As many rocks as squares on a side, on different squares, all equally likely; the rover starts in the
/// middle of the west side (`InitGeneral` of POMCP and DESPOT, `rsgen` of AdaOPS).
pub(crate) fn random(side: i8, random: &mut impl Rng) -> Layout {
    let mut rocks = Vec::new();
    while rocks.len() < side as usize {
        let rock = [random.random_range(0..side), random.random_range(0..side)];
        if !rocks.contains(&rock) {
            rocks.push(rock);
        }
    }
    Layout { side, start: [0, side / 2], rocks }
}
