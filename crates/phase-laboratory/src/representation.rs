//! Representational dissimilarity: how different every two stimuli are, and how alike two such judgements
//! are.

use phase_statistics::{kendall, pearson, semipartial, spearman};
use rand::Rng;
use serde::Serialize;
use thiserror::Error;

/// Why features make no matrix.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum RepresentationError {
    /// Fewer than three stimuli: there is nothing to correlate.
    #[error("a matrix needs 3 stimuli at least, {0} have features")]
    TooFew(usize),
    /// Feature vectors of different lengths.
    #[error("{id} has {found} features, {first} has {expected}; clips of one length have equally many")]
    Lengths {
        /// The first stimulus.
        first: String,
        /// Its number of features.
        expected: usize,
        /// The other one.
        id: String,
        /// Its number of features.
        found: usize,
    },
    /// A feature whose square is no number.
    #[error("{id} has the feature {feature}, but features must be from -1e150 to 1e150")]
    TooLarge {
        /// The stimulus.
        id: String,
        /// The feature.
        feature: f64,
    },
    /// The distance of two stimuli is not defined.
    #[error(
        "the {distance} distance of {one} and {other} is not defined, for the features of one of them are all equal"
    )]
    Undefined {
        /// The distance.
        distance: &'static str,
        /// One stimulus.
        one: String,
        /// The other one.
        other: String,
    },
}

/// Largest size of a feature, so that sums of squares of differences are numbers.
const LARGEST_FEATURE: f64 = 1e150;

/// A measure of the dissimilarity of two feature vectors.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Distance {
    /// Euclidean distance.
    #[default]
    Euclidean,
    /// 1 − Pearson's correlation.
    Correlation,
    /// 1 − cosine of the angle.
    Cosine,
}

impl Distance {
    /// Every distance.
    pub const ALL: [Self; 3] = [Self::Euclidean, Self::Correlation, Self::Cosine];

    /// The name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Euclidean => "euclidean",
            Self::Correlation => "correlation",
            Self::Cosine => "cosine",
        }
    }

    fn of(self, a: &[f64], b: &[f64]) -> Option<f64> {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        match self {
            Self::Euclidean => Some(libm::sqrt(a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>())),
            Self::Correlation => pearson(a, b).map(|r| 1.0 - r),
            Self::Cosine => {
                let scale = libm::sqrt(dot(a, a)) * libm::sqrt(dot(b, b));
                (scale > 0.0).then(|| 1.0 - (dot(a, b) / scale).clamp(-1.0, 1.0))
            }
        }
    }
}

/// The dissimilarities of every two stimuli.
#[derive(Clone, PartialEq, Debug)]
pub struct Dissimilarity {
    /// Ids of the stimuli.
    pub ids: Vec<String>,
    /// Dissimilarities of stimuli 0 and 1, 0 and 2, … 1 and 2, … as `scipy.spatial.distance.squareform` and
    /// `pdist` have them.
    pub condensed: Vec<f64>,
}

impl Dissimilarity {
    /// The matrix of some features, in the order of the stimuli.
    ///
    /// # Errors
    /// [`RepresentationError`].
    pub fn of(features: &[(String, Vec<f64>)], distance: Distance) -> Result<Self, RepresentationError> {
        if features.len() < 3 {
            return Err(RepresentationError::TooFew(features.len()));
        }
        let first = &features[0].0;
        let expected = features[0].1.len();
        if let Some((id, other)) = features.iter().find(|(_, other)| other.len() != expected) {
            return Err(RepresentationError::Lengths {
                first: first.clone(),
                expected,
                id: id.clone(),
                found: other.len(),
            });
        }
        for (id, row) in features {
            if let Some(&feature) = row.iter().find(|feature| feature.abs() > LARGEST_FEATURE) {
                return Err(RepresentationError::TooLarge { id: id.clone(), feature });
            }
        }
        let mut condensed = Vec::with_capacity(features.len() * (features.len() - 1) / 2);
        for (k, (one, a)) in features.iter().enumerate() {
            for (other, b) in &features[k + 1..] {
                condensed.push(distance.of(a, b).ok_or_else(|| RepresentationError::Undefined {
                    distance: distance.name(),
                    one: one.clone(),
                    other: other.clone(),
                })?);
            }
        }
        Ok(Self { ids: features.iter().map(|(id, _)| id.clone()).collect(), condensed })
    }

    /// The dissimilarity of two stimuli by index, 0 of one with itself.
    #[must_use]
    pub fn at(&self, a: usize, b: usize) -> f64 {
        let low = a.min(b);
        let high = a.max(b);
        if low == high {
            0.0
        } else {
            self.condensed[low * (2 * self.ids.len() - low - 1) / 2 + high - low - 1]
        }
    }

    /// The dissimilarities of every two of a sample of stimuli. One that was drawn twice is no pair.
    #[must_use]
    pub fn of_sample(&self, sample: &[usize]) -> Vec<f64> {
        let pairs = (0..sample.len()).flat_map(|k| sample[k + 1..].iter().map(move |&b| (sample[k], b)));
        pairs.filter(|(a, b)| a != b).map(|(a, b)| self.at(a, b)).collect()
    }

    /// The condensed matrix as a file of numpy's format 1.0: one dimension, `float64`, little endian.
    #[must_use]
    pub fn to_npy(&self) -> Vec<u8> {
        let mut header =
            format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", self.condensed.len());
        // Magic, version and length take ten bytes; the whole is padded to a multiple of 64.
        while (10 + header.len() + 1) % 64 != 0 {
            header.push(' ');
        }
        header.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(self.condensed.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }
}

/// A statistic with its 95 % percentile bootstrap interval over stimuli.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Similarity {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// A rank correlation.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Rank {
    /// Spearman's.
    #[default]
    Spearman,
    /// Kendall's τ-b.
    Kendall,
}

impl Rank {
    fn of(self, a: &[f64], b: &[f64]) -> Option<f64> {
        match self {
            Self::Spearman => spearman(a, b),
            Self::Kendall => kendall(a, b),
        }
    }
}

/// The rank correlation of two matrices of the same stimuli. `None` where one of them is constant.
#[must_use]
pub fn similarity<R: Rng>(
    one: &Dissimilarity,
    other: &Dissimilarity,
    rank: Rank,
    resamples: usize,
    random: &mut R,
) -> Option<Similarity> {
    estimate(one.ids.len(), resamples, random, |sample| {
        rank.of(&one.of_sample(sample), &other.of_sample(sample))
    })
}

/// The semipartial correlation of ranks: how much of `target` a model explains that the other models do not.
/// The model's ranks are reduced by what a linear regression on the others' ranks predicts, and correlated
/// with those of the target. `None` where the others determine the model.
#[must_use]
pub fn unique<R: Rng>(
    target: &Dissimilarity,
    model: &Dissimilarity,
    others: &[&Dissimilarity],
    resamples: usize,
    random: &mut R,
) -> Option<Similarity> {
    estimate(target.ids.len(), resamples, random, |sample| {
        let others: Vec<Vec<f64>> = others.iter().map(|other| other.of_sample(sample)).collect();
        semipartial(&target.of_sample(sample), &model.of_sample(sample), &others)
    })
}

fn estimate<R: Rng>(
    count: usize,
    resamples: usize,
    random: &mut R,
    statistic: impl Fn(&[usize]) -> Option<f64>,
) -> Option<Similarity> {
    let all: Vec<usize> = (0..count).collect();
    let value = statistic(&all)?;
    let interval = phase_statistics::bootstrap(count, resamples, 0.95, random, statistic)?;
    Some(Similarity { value, low: interval.low, high: interval.high })
}
