//! Agreement with people who rated the relations of events.
//!
//! People do not agree with one another entirely, and how many of them call an event friendly is information.
//! So a method's three probabilities are compared with the shares of raters, and both with the *noise
//! ceiling*: how well one half of the raters predicts the other.

use super::{Answer, Protocol, RecognisedEvent};
use crate::{CONFIDENCE, Estimate, RESAMPLES, ratings::RatingCounts};
use phase_model::{
    RelationProbabilities,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_statistics::{bootstrap, entropy, mean, pearson, spearman, spearman_brown};
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

/// Share of the uniform distribution that is mixed into a method's probabilities for the cross-entropy, so
/// that a single event cannot make it infinite.
pub const UNIFORM_SHARE: f64 = 0.01;
/// Divisions of the raters into halves, over which ceilings are averaged.
const HALVINGS: usize = 200;
/// Bootstrap resamples of the similarity, each of which compares all pairs of events.
const PAIR_RESAMPLES: usize = 1000;
/// Index of the random stream of the halves; intervals have index 0.
const HALVING_STREAM: u64 = 1;

/// Shares of the three relations, in the order of [`RELATIONS`](super::RELATIONS).
type Shares = [f64; 3];

/// The agreement of a method's probabilities of relations with people's ratings.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Agreement {
    /// Number of events that were rated.
    pub n: usize,
    /// Number of ratings in all.
    pub ratings: usize,
    /// Pearson's correlation of probabilities and shares of raters over events and relations; `None` if
    /// either is constant.
    pub correlation: Option<Estimate>,
    /// Mean over events of −Σ h ln p (nat), where h are the shares of raters and p the probabilities, mixed
    /// with [`UNIFORM_SHARE`].
    pub cross_entropy: Estimate,
    /// Representational similarity: Spearman's correlation of the distances between every two events, by
    /// probabilities and by shares (Euclidean). `None` if it is not defined.
    pub similarity: Option<Estimate>,
    /// Share of events whose most likely relation is the one most raters named; of equally frequent ones any.
    pub mode: Estimate,
    /// The noise ceiling; `None` if no event has two ratings.
    pub ceiling: Option<Ceiling>,
    /// Whether the ratings are those that the probabilities were fitted to.
    #[serde(default, skip_serializing_if = "is_unfitted")]
    pub protocol: Protocol,
}

/// The agreement of people with one another: the mean over random divisions of each event's raters into
/// halves.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Ceiling {
    /// Correlation of the halves' shares, corrected to all raters (Spearman–Brown); `None` if they are
    /// constant.
    pub correlation: Option<f64>,
    /// Mean entropy of the shares (nat): the least cross-entropy that any probabilities reach.
    pub entropy: f64,
    /// Similarity of the halves, corrected alike.
    pub similarity: Option<f64>,
    /// Share of events for which both halves name the same relation most often.
    pub mode: f64,
}

/// One event: what the method says and how people rated it.
struct Rated {
    said: Shares,
    counts: RatingCounts,
}

impl Agreement {
    /// Compares the reports that the answers to rated events predict, or, where an answer predicts none, its
    /// probabilities of relations; `None` without any. The seed is that of intervals and halves.
    #[must_use]
    pub fn of(events: &[RecognisedEvent], seed: u64) -> Option<Self> {
        Self::with(events, seed, |answer| answer.reported.unwrap_or(answer.relation))
    }

    /// Compares the probabilities of relations alone. `None` without any, and if no answer predicts reports,
    /// so that [`Agreement::of`] has compared them already.
    #[must_use]
    pub fn of_relations(events: &[RecognisedEvent], seed: u64) -> Option<Self> {
        let predicted = events.iter().any(|event| event.answer.reported.is_some());
        predicted.then(|| Self::with(events, seed, |answer| answer.relation)).flatten()
    }

    fn with(
        events: &[RecognisedEvent],
        seed: u64,
        said: impl Fn(&Answer) -> RelationProbabilities,
    ) -> Option<Self> {
        let rated = |event: &RecognisedEvent| {
            let counts = event.label.ratings?;
            (counts.raters() > 0).then(|| Rated { said: shares_of(&said(&event.answer)), counts })
        };
        let rated: Vec<Rated> = events.iter().filter_map(rated).collect();
        let said: Vec<Shares> = rated.iter().map(|event| event.said).collect();
        let people: Vec<Shares> = rated.iter().map(|event| shares(event.counts)).collect();
        let random = || stream(seed, Purpose::Bootstrap, 0);
        let all: Vec<usize> = (0..rated.len()).collect();
        let correlated = |sample: &[usize]| correlation(&said, &people, sample);
        let from = distances(&said);
        let to = distances(&people);
        let similar = |sample: &[usize]| similarity(&from, &to, sample);
        let estimate = |resamples, statistic: &dyn Fn(&[usize]) -> Option<f64>| {
            let value = statistic(&all)?;
            let interval = bootstrap(rated.len(), resamples, CONFIDENCE, &mut random(), statistic)?;
            Some(Estimate { value, low: interval.low, high: interval.high })
        };
        let over_events = |value: &dyn Fn(usize) -> f64| {
            Estimate::of(&(0..rated.len()).map(value).collect::<Vec<f64>>(), seed)
        };
        Some(Self {
            n: rated.len(),
            ratings: rated.iter().map(|event| event.counts.raters()).sum(),
            correlation: estimate(RESAMPLES, &correlated),
            cross_entropy: over_events(&|k| cross_entropy(&people[k], &said[k]))?,
            similarity: estimate(PAIR_RESAMPLES, &similar),
            mode: over_events(&|k| f64::from(u8::from(names_mode(&said[k], &people[k]))))?,
            ceiling: Ceiling::of(&rated, seed),
            protocol: Protocol::default(),
        })
    }
}

/// The representational similarity of halves of the raters, corrected to all of them: the most that any
/// answers to these events can be expected to reach. `None` if no event has two ratings or it is not defined.
#[must_use]
pub fn similarity_ceiling(counts: &[RatingCounts], seed: u64) -> Option<f64> {
    let rated: Vec<Rated> = counts.iter().map(|&counts| Rated { said: shares(counts), counts }).collect();
    Ceiling::of(&rated, seed)?.similarity
}

impl Ceiling {
    fn of(rated: &[Rated], seed: u64) -> Option<Self> {
        let several: Vec<&Rated> = rated.iter().filter(|event| event.counts.raters() > 1).collect();
        if several.is_empty() {
            return None;
        }
        let mut random = stream(seed, Purpose::Bootstrap, HALVING_STREAM);
        let all: Vec<usize> = (0..several.len()).collect();
        let mut correlations = Vec::new();
        let mut similarities = Vec::new();
        let mut modes = Vec::new();
        for _ in 0..HALVINGS {
            let halves: Vec<[Shares; 2]> =
                several.iter().map(|event| halves(event.counts, &mut random)).collect();
            let [one, other] = [0, 1].map(|k| halves.iter().map(|half| half[k]).collect::<Vec<Shares>>());
            correlations.extend(correlation(&one, &other, &all));
            similarities.extend(similarity(&distances(&one), &distances(&other), &all));
            let same = halves.iter().filter(|[one, other]| names_mode(one, other)).count();
            modes.push(same as f64 / several.len() as f64);
        }
        let entropies: Vec<f64> = rated.iter().map(|event| entropy(&shares(event.counts))).collect();
        Some(Self {
            correlation: mean(&correlations).map(spearman_brown),
            entropy: mean(&entropies)?,
            similarity: mean(&similarities).map(spearman_brown),
            mode: mean(&modes)?,
        })
    }
}

fn is_unfitted(protocol: &Protocol) -> bool {
    *protocol == Protocol::Unfitted
}

const fn shares_of(relation: &RelationProbabilities) -> Shares {
    [relation.friendly, relation.adversarial, relation.neutral]
}

fn shares(counts: RatingCounts) -> Shares {
    let all = counts.raters().max(1) as f64;
    counts.counts().map(|count| count as f64 / all)
}

/// The shares of two random halves of the raters, the first of which has one more if their number is odd.
fn halves(counts: RatingCounts, random: &mut Pcg64Mcg) -> [Shares; 2] {
    let named = |(relation, count): (usize, usize)| core::iter::repeat_n(relation, count);
    let mut answers: Vec<usize> = counts.counts().into_iter().enumerate().flat_map(named).collect();
    answers.shuffle(random);
    let (one, other) = answers.split_at(answers.len().div_ceil(2));
    [one, other].map(|half| {
        let count = |relation| half.iter().filter(|&&answer| answer == relation).count();
        [0, 1, 2].map(|relation| count(relation) as f64 / half.len().max(1) as f64)
    })
}

fn correlation(one: &[Shares], other: &[Shares], sample: &[usize]) -> Option<f64> {
    let flat = |of: &[Shares]| -> Vec<f64> { sample.iter().flat_map(|&k| of[k]).collect() };
    pearson(&flat(one), &flat(other))
}

/// −Σ h ln p (nat).
fn cross_entropy(people: &Shares, said: &Shares) -> f64 {
    let uniform = 1.0 / people.len() as f64;
    let log = |p: f64| libm::log((1.0 - UNIFORM_SHARE) * p + UNIFORM_SHARE * uniform);
    -people.iter().zip(said).map(|(h, p)| h * log(*p)).sum::<f64>()
}

/// The Euclidean distances between every two events.
fn distances(of: &[Shares]) -> Vec<Vec<f64>> {
    let distance = |one: &Shares, other: &Shares| {
        libm::sqrt(one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>())
    };
    of.iter().map(|one| of.iter().map(|other| distance(one, other)).collect()).collect()
}

/// Spearman's correlation of the distances of all pairs of a sample. An event that was drawn twice is no
/// pair.
fn similarity(one: &[Vec<f64>], other: &[Vec<f64>], sample: &[usize]) -> Option<f64> {
    let pairs = || {
        let after = |k: usize| sample[k + 1..].iter().map(move |&b| (sample[k], b));
        (0..sample.len()).flat_map(after).filter(|(a, b)| a != b)
    };
    let of = |distances: &[Vec<f64>]| -> Vec<f64> { pairs().map(|(a, b)| distances[a][b]).collect() };
    spearman(&of(one), &of(other))
}

/// Whether the greatest share of the one is among the greatest of the other.
fn names_mode(said: &Shares, people: &Shares) -> bool {
    let first = (0..said.len()).fold(0, |best, k| if said[k] > said[best] { k } else { best });
    people.iter().all(|share| *share <= people[first])
}
