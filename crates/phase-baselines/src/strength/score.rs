//! Accuracy of strength estimates.

use super::Sample;
use phase_model::Strength;
use phase_simple::StrengthRegressor;

/// Errors of the estimates, with those of constant predictions for comparison.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Score {
    /// Root mean squared error (N).
    pub rmse: f64,
    /// Root mean squared error of the best constant prediction (N): the standard deviation of the forces.
    pub rmse_of_constant: f64,
    /// Share of estimates that are closest to the correct level (0 to 1).
    pub accuracy: f64,
    /// Share of correct predictions of the most common level (0 to 1).
    pub accuracy_of_guess: f64,
}

/// Scores a regressor on non-empty groups of samples; groups have equal weight, as have the samples of a
/// group. `guess` is the constant prediction. Zeros without groups.
#[must_use]
pub fn score<'a>(
    regressor: &StrengthRegressor,
    groups: impl IntoIterator<Item = &'a [Sample]>,
    guess: Strength,
) -> Score {
    let mut squares = 0.0;
    let mut right = 0.0;
    let mut guessed = 0.0;
    let mut sum = 0.0;
    let mut sum_of_squares = 0.0;
    let mut count = 0.0;
    for group in groups {
        let share = 1.0 / group.len().max(1) as f64;
        for sample in group {
            let force = f64::from(sample.strength.max_force());
            let estimate = regressor.estimate_from(&sample.features);
            squares += share * (estimate - force) * (estimate - force);
            right += share * f64::from(u8::from(nearest(estimate) == sample.strength));
            guessed += share * f64::from(u8::from(guess == sample.strength));
            sum += share * force;
            sum_of_squares += share * force * force;
        }
        count += 1.0;
    }
    let count = if count > 0.0 { count } else { 1.0 };
    let mean = sum / count;
    Score {
        rmse: (squares / count).sqrt(),
        rmse_of_constant: (sum_of_squares / count - mean * mean).max(0.0).sqrt(),
        accuracy: right / count,
        accuracy_of_guess: guessed / count,
    }
}

/// The level closest to a force (N); the weaker one in a tie.
#[must_use]
pub fn nearest(force: f64) -> Strength {
    let off = |strength: Strength| (f64::from(strength.max_force()) - force).abs();
    let better = |best: Strength, next: Strength| if off(next) < off(best) { next } else { best };
    Strength::ALL.into_iter().fold(Strength::Weak, better)
}

/// The most common level; the weaker one in a tie.
#[must_use]
pub fn most_common<'a>(samples: impl Iterator<Item = &'a Sample>) -> Strength {
    let mut counts = [0_usize; Strength::ALL.len()];
    for sample in samples {
        counts[usize::from(sample.strength.level())] += 1;
    }
    let best = Strength::ALL.into_iter().zip(counts).rev().max_by_key(|&(_, count)| count);
    best.map_or(Strength::Weak, |(strength, _)| strength)
}
