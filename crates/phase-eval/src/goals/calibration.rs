//! Calibration of a method's probabilities.

use serde::{Deserialize, Serialize};

/// Bins of a reliability table, equally wide from 0 to 1.
pub const BINS: usize = 10;

/// The answers with about the same probability.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Bin {
    /// Minimum probability.
    pub from: f64,
    /// Maximum probability, which belongs to the next bin unless it is 1.
    pub to: f64,
    /// Number of answers.
    pub n: usize,
    /// Their mean probability; 0 if there are none.
    pub confidence: f64,
    /// Share of correct ones; 0 if there are none.
    pub accuracy: f64,
}

/// A reliability table of most likely answers.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Calibration {
    /// The bins, from 0 to 1.
    pub bins: Vec<Bin>,
    /// Expected calibration error: the mean over answers of the difference between confidence and accuracy of
    /// their bin, 0 to 1; 0 without answers.
    pub error: f64,
}

impl Calibration {
    /// Sorts answers into bins, each with its probability (0 to 1) and whether it was correct.
    #[must_use]
    pub fn of(answers: &[(f64, bool)]) -> Self {
        let mut bins: Vec<Bin> = (0..BINS)
            .map(|k| Bin {
                from: k as f64 / BINS as f64,
                to: (k + 1) as f64 / BINS as f64,
                n: 0,
                confidence: 0.0,
                accuracy: 0.0,
            })
            .collect();
        for &(p, right) in answers {
            // A negative probability or NaN counts as 0.
            let at = ((p * BINS as f64) as usize).min(BINS - 1);
            let bin = &mut bins[at];
            bin.n += 1;
            bin.confidence += p;
            bin.accuracy += f64::from(u8::from(right));
        }
        let mut error = 0.0;
        for bin in bins.iter_mut().filter(|bin| bin.n > 0) {
            error += (bin.accuracy - bin.confidence).abs() / answers.len() as f64;
            bin.confidence /= bin.n as f64;
            bin.accuracy /= bin.n as f64;
        }
        Self { bins, error }
    }
}
