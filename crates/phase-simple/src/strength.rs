//! Q(f | S): what a stretch of motion says about an agent's strength.

use phase_model::{Body, MAX_ENTITIES, Size, Strength};

/// Something that guesses at strengths.
pub trait StrengthCue: Sync {
    /// ln Q(f | S) of each level for an agent (0 or 1) of a size, from the rows of a stretch of motion. The
    /// probabilities add up to 1.
    fn log_proposal(
        &self,
        rows: &[[Body; MAX_ENTITIES]],
        agent: usize,
        size: Size,
    ) -> [f64; Strength::ALL.len()];
}

/// The cue of whoever has none: all strengths are equally likely.
#[derive(Clone, Copy, Debug, Default)]
pub struct AnyStrength;

impl StrengthCue for AnyStrength {
    fn log_proposal(
        &self,
        _rows: &[[Body; MAX_ENTITIES]],
        _agent: usize,
        _size: Size,
    ) -> [f64; Strength::ALL.len()] {
        [-libm::log(Strength::ALL.len() as f64); Strength::ALL.len()]
    }
}
