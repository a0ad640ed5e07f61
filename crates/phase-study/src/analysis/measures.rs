//! The measures.

use super::{
    Accuracy, Agreement, Categories, Category, Difference, Likeness, Share,
    judgements::{Judged, Judgements},
};
use crate::{
    config::StudyConfig,
    forms::{Form, Forms, GOALS, HUMAN_LIKENESS, INTERACTIONS, MOST_OBJECTS, RELATION},
    question::Kind,
};
use phase_eval::{CONFIDENCE, Estimate, RESAMPLES};
use phase_model::random::{Purpose, stream};
use phase_statistics::{
    bootstrap, bootstrap_difference, krippendorff_alpha, mean, standard_deviation, wilson_interval,
};
use std::collections::{BTreeMap, BTreeSet};

impl Share {
    fn of(count: usize, of: usize) -> Self {
        let interval = wilson_interval(count, of);
        let share = if of == 0 { 0.0 } else { count as f64 / of as f64 };
        Self { count, of, share, low: interval.low, high: interval.high }
    }
}

/// Agreement about every question but human-likeness, whose answers are ordered.
pub(super) fn agreement(judgements: &Judgements<'_>, config: &StudyConfig, forms: &Forms) -> Vec<Agreement> {
    let mut all = Vec::new();
    for question in forms.questions(config.form, MOST_OBJECTS) {
        if question.name == HUMAN_LIKENESS {
            continue;
        }
        let choices: Vec<&str> = question.kind.choices().iter().map(|choice| choice.value.as_str()).collect();
        let one = |choice: Option<&str>, units: Vec<Vec<usize>>| {
            let videos = units.iter().filter(|unit| unit.iter().sum::<usize>() > 1).count();
            let alpha = alpha(&units, config.seed);
            Agreement { question: question.name.clone(), choice: choice.map(str::to_owned), alpha, videos }
        };
        let counts: Vec<Vec<usize>> =
            judgements.0.iter().map(|judged| judged.counts(&question.name, &choices)).collect();
        if matches!(question.kind, Kind::Many { .. }) {
            for (k, choice) in choices.iter().enumerate() {
                let given = judgements.0.iter().zip(&counts);
                let units = given.map(|(judged, counts)| vec![counts[k], judged.answers.len() - counts[k]]);
                all.push(one(Some(choice), units.collect()));
            }
        } else {
            all.push(one(None, counts));
        }
    }
    all
}

fn alpha(units: &[Vec<usize>], seed: u64) -> Option<Estimate> {
    let value = krippendorff_alpha(units.iter().map(Vec::as_slice))?;
    let mut random = stream(seed, Purpose::Bootstrap, 0);
    let of = |sample: &[usize]| krippendorff_alpha(sample.iter().map(|&k| units[k].as_slice()));
    let interval = bootstrap(units.len(), RESAMPLES, CONFIDENCE, &mut random, of)?;
    Some(Estimate { value, low: interval.low, high: interval.high })
}

/// Accuracies of goals and relations in the videos of each source, where the form asks for them and labels
/// are known.
pub(super) fn accuracy(
    judgements: &Judgements<'_>,
    sources: &[Option<&str>],
    form: Form,
    seed: u64,
) -> Vec<Accuracy> {
    let mut all = Vec::new();
    for source in sources {
        let mut add = |question, scores: Vec<Score>| {
            if !scores.is_empty() {
                let shares: Vec<f64> = scores.iter().map(|score| score.share).collect();
                let (right, of) =
                    scores.iter().fold((0, 0), |(right, of), score| (right + score.right, of + score.of));
                all.push(Accuracy {
                    question,
                    source: source.map(str::to_owned),
                    videos: scores.len(),
                    mean: Estimate::of(&shares, seed),
                    majority: Share::of(right, of),
                });
            }
        };
        if form == Form::Goals {
            add("goals", judgements.from(*source).filter_map(goals).collect());
        }
        if form != Form::Interactions {
            add("relation", judgements.from(*source).filter_map(relation).collect());
        }
    }
    all
}

/// The share of a video's judgements that are right.
struct Score {
    /// Share of judgements that are.
    share: f64,
    /// Labels that the majority named.
    right: usize,
    /// Labels.
    of: usize,
}

fn goals(judged: &Judged<'_>) -> Option<Score> {
    let labels = judged.stimulus.labels.goals.as_ref()?;
    let [first, second] = [score(judged, GOALS[0], &labels[0])?, score(judged, GOALS[1], &labels[1])?];
    Some(Score { share: (first.share + second.share) / 2.0, right: first.right + second.right, of: 2 })
}

fn relation(judged: &Judged<'_>) -> Option<Score> {
    let label = judged.stimulus.labels.relation.clone()?;
    score(judged, RELATION, &BTreeSet::from([label]))
}

/// Right is whatever is among the labels: they are different names of the same.
fn score(judged: &Judged<'_>, question: &str, labels: &BTreeSet<String>) -> Option<Score> {
    let mut counts = BTreeMap::<&str, usize>::new();
    let mut right = 0;
    for text in judged.given(question).filter_map(|given| given.text()) {
        if labels.contains(text) {
            right += 1;
        } else {
            *counts.entry(text).or_default() += 1;
        }
    }
    let total = right + counts.values().sum::<usize>();
    let beaten = counts.values().all(|&count| count < right);
    (total > 0).then(|| Score { share: right as f64 / total as f64, right: usize::from(beaten), of: 1 })
}

/// The mean ratings of the videos of a source.
fn likeness_of(judgements: &Judgements<'_>, source: &str) -> Vec<f64> {
    let of = |judged: &Judged<'_>| {
        let ratings: Vec<f64> =
            judged.given(HUMAN_LIKENESS).filter_map(|given| given.text()?.parse::<f64>().ok()).collect();
        mean(&ratings)
    };
    judgements.from(Some(source)).filter_map(of).collect()
}

pub(super) fn likeness(judgements: &Judgements<'_>, sources: &[&str], seed: u64) -> Vec<Likeness> {
    let of = |source: &&str| {
        let means = likeness_of(judgements, source);
        let mean = Estimate::of(&means, seed);
        let sd = standard_deviation(&means);
        Likeness { source: (*source).into(), videos: means.len(), mean, sd }
    };
    sources.iter().map(of).collect()
}

pub(super) fn differences(judgements: &Judgements<'_>, sources: &[&str], seed: u64) -> Vec<Difference> {
    let mut all = Vec::new();
    for (k, source) in sources.iter().enumerate() {
        for other in &sources[k + 1..] {
            let means = [likeness_of(judgements, source), likeness_of(judgements, other)];
            if let Some(difference) = difference(&means, seed) {
                all.push(Difference { source: (*source).into(), other: (*other).into(), difference });
            }
        }
    }
    all
}

/// The difference of two means, with an interval by resampling both samples independently.
fn difference([one, other]: &[Vec<f64>; 2], seed: u64) -> Option<Estimate> {
    let value = mean(one)? - mean(other)?;
    let mut random = stream(seed, Purpose::Bootstrap, 1);
    let interval = bootstrap_difference(one, other, RESAMPLES, CONFIDENCE, &mut random)?;
    Some(Estimate { value, low: interval.low, high: interval.high })
}

pub(super) fn interactions(
    judgements: &Judgements<'_>,
    sources: &[Option<&str>],
    forms: &Forms,
) -> Vec<Categories> {
    let questions = forms.questions(Form::Interactions, MOST_OBJECTS);
    let asked = questions.iter().find(|question| question.name == INTERACTIONS);
    let choices: Vec<&str> =
        asked.iter().flat_map(|it| it.kind.choices()).map(|it| it.value.as_str()).collect();
    let of = |source: &Option<&str>| {
        let videos: Vec<(usize, Vec<usize>)> = judgements
            .from(*source)
            .map(|judged| (judged.answers.len(), judged.counts(INTERACTIONS, &choices)))
            .collect();
        let category = |(k, choice): (usize, &&str)| {
            let given = videos.iter().filter(|(_, counts)| counts[k] > 0).count();
            let by_half = videos.iter().filter(|(raters, counts)| 2 * counts[k] >= *raters).count();
            Category { choice: (*choice).into(), given, by_half: Share::of(by_half, videos.len()) }
        };
        let categories: Vec<Category> = choices.iter().enumerate().map(category).collect();
        Categories {
            source: source.map(str::to_owned),
            given: categories.iter().filter(|category| category.given > 0).count(),
            by_half: categories.iter().filter(|category| category.by_half.count > 0).count(),
            categories,
        }
    };
    sources.iter().map(of).collect()
}
