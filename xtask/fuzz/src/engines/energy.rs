//! Energy that appears while nothing pushes.

use super::{Kind, Scenes, Substep};
use crate::scenes::{Doing, Start, energy};
use phase_model::State;

/// Energy that a scene may seem to gain in a substep by rounding (J).
pub const GAIN: f32 = 0.02;
/// Steps of a scene.
const STEPS: usize = 30;

/// Gains of energy in scenes in which agents do no work.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct EnergyGains {
    /// Substeps in which something moved.
    pub substeps: usize,
    /// Those with a gain above [`GAIN`] while an object is held, or at its grabbing or release.
    pub holding: usize,
    /// The largest of these (J).
    pub most_holding: f32,
    /// Those above it in the first step, which separates what overlaps, without a held object.
    pub separating: usize,
    /// The largest of these (J).
    pub most_separating: f32,
    /// Those above it elsewhere.
    pub free: usize,
    /// The largest gain elsewhere, above [`GAIN`] or not (J).
    pub most_free: f32,
}

/// Counts gains of energy in scenes `seeds`.
#[must_use]
pub fn energy_gains(kind: Kind, begins: Start, seeds: core::ops::Range<u64>) -> EnergyGains {
    let mut gains = EnergyGains::default();
    Scenes { kind, begins, doing: Doing::Nothing, steps: STEPS, seeds }.run(|substep| {
        let Substep { physics, step, before, after, .. } = substep;
        let [was, is] = [before, after].map(|state| energy(physics, state));
        let holds = |state: &State| state.grips.iter().any(Option::is_some);
        if was.max(is) > GAIN {
            gains.count(is - was, holds(before) || holds(after), step == 0);
        }
    });
    gains
}

impl EnergyGains {
    fn count(&mut self, gain: f32, holding: bool, first: bool) {
        self.substeps += 1;
        let (count, most) = match (holding, first) {
            (true, _) => (&mut self.holding, &mut self.most_holding),
            (false, true) => (&mut self.separating, &mut self.most_separating),
            (false, false) => (&mut self.free, &mut self.most_free),
        };
        *count += usize::from(gain > GAIN);
        *most = most.max(gain);
    }
}
