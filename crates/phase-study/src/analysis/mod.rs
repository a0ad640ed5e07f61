//! Analysis of answers: who took part, how far raters agree, whether they are right, how human-like they find
//! the events, what interactions they see, and all of this by condition, set and video.
//!
//! Only raters count who have answered everything and passed the catch trials ([`Standing::Complete`]).
//! Intervals are 95 % and over videos: of means and α by the percentile bootstrap, of shares of videos
//! Wilson's. Those of one set or one video are over its judgements.

mod groups;
mod judgements;
mod measures;
mod report;

pub use report::document;

use crate::{
    config::StudyConfig,
    forms::{Form, Forms},
    record::{Rater, Standing},
};
use groups::{by_condition, by_set, by_video, confusion, goal_confusion};
use judgements::Judgements;
use phase_eval::Estimate;
use serde::Serialize;

/// The value of the field `format` of an analysis.
pub const REPORT_FORMAT: &str = "phase-study-report/1";

/// Numbers of raters, by how far they got.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Raters {
    /// Those who came.
    pub joined: usize,
    /// Those who did not agree.
    pub declined: usize,
    /// Those who withdrew.
    pub withdrawn: usize,
    /// Those who have not answered everything.
    pub unfinished: usize,
    /// Those who failed more catch trials than allowed.
    pub failed: usize,
    /// Those who count.
    pub complete: usize,
}

/// Numbers of judgements of videos, by raters who count.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Coverage {
    /// Videos of the study.
    pub videos: usize,
    /// Those with at least one judgement.
    pub judged: usize,
    /// Judgements in all.
    pub judgements: usize,
    /// Judgements of the video with fewest.
    pub least: usize,
    /// Of that with most.
    pub most: usize,
}

/// Agreement about a question: Krippendorff's α for nominal data ([`phase_statistics::krippendorff_alpha`]).
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Agreement {
    /// The question.
    pub question: String,
    /// Of a question that wants several choices, the choice; whether it was given is what raters agree on.
    pub choice: Option<String>,
    /// α and its interval over videos; `None` where all raters said the same.
    pub alpha: Option<Estimate>,
    /// Videos with at least two judgements.
    pub videos: usize,
}

/// A share of items, and Wilson's interval.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Share {
    /// Number of items that have the property.
    pub count: usize,
    /// Of how many.
    pub of: usize,
    /// The share; 0 of none.
    pub share: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Agreement of judgements with labels.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Accuracy {
    /// `goals` (of both agents) or `relation`.
    pub question: &'static str,
    /// The source of the videos; all of them if `None`.
    pub source: Option<String>,
    /// Videos with a label and a judgement.
    pub videos: usize,
    /// The mean over videos of the share of judgements that are right, of goals over both agents.
    pub mean: Option<Estimate>,
    /// Labels (of goals one for each agent) that more raters named than anything else. A tie is no majority.
    /// Wilson's interval takes the two agents of a video for independent.
    pub majority: Share,
}

/// Human-likeness of the events of a source, as rated.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Likeness {
    /// The source.
    pub source: String,
    /// Videos with a judgement.
    pub videos: usize,
    /// The mean over videos of their mean ratings, 1 to 5.
    pub mean: Option<Estimate>,
    /// The standard deviation of the videos' mean ratings; `None` below two videos.
    pub sd: Option<f64>,
}

/// By how much the mean of one source exceeds that of another.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Difference {
    /// The one source.
    pub source: String,
    /// The other.
    pub other: String,
    /// The difference and its interval, videos of both sources drawn independently.
    pub difference: Estimate,
}

/// A type of interaction, and in which videos people see it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Category {
    /// The type.
    pub choice: String,
    /// Videos of which at least one rater gave it.
    pub given: usize,
    /// Videos of which at least half of the raters gave it.
    pub by_half: Share,
}

/// The types of interaction in the videos of a source.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Categories {
    /// The source; all videos if `None`.
    pub source: Option<String>,
    /// Number of types that some rater gave to some video.
    pub given: usize,
    /// Number of types that at least half of the raters gave to some video.
    pub by_half: usize,
    /// All types, in the order of the form.
    pub categories: Vec<Category>,
}

/// The answers about the videos of one condition, of one set, or about one video.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Answers {
    /// The condition or set, or the video's id.
    pub name: String,
    /// Videos with a judgement.
    pub videos: usize,
    /// Judgements of them.
    pub judgements: usize,
    /// Judgements that give each relation or type of interaction, in the order of the form.
    pub given: Vec<(String, usize)>,
    /// The mean share of judgements with the right relation.
    pub relation_right: Option<Estimate>,
    /// The mean share of goals, over both agents, that are named rightly.
    pub goals_right: Option<Estimate>,
    /// The mean rating of human-likeness, 1 to 5.
    pub human_likeness: Option<Estimate>,
}

/// Counts of the answers that videos of each label get.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Confusion {
    /// The question: `relation`; `goals`, those of both agents; or `interactions`, whose labels are the
    /// conditions.
    pub question: &'static str,
    /// The labels, one for each row.
    pub labels: Vec<String>,
    /// The answers, one for each column.
    pub answers: Vec<String>,
    /// Judgements of videos with the label that give the answer, by label and answer.
    pub counts: Vec<Vec<usize>>,
    /// Judgements of videos with the label.
    pub judgements: Vec<usize>,
}

/// The analysis of the answers to a study. Parts that the form does not ask for are empty.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Analysis {
    /// [`REPORT_FORMAT`].
    pub format: &'static str,
    /// The study.
    pub name: String,
    /// Its form.
    pub form: &'static str,
    /// Numbers of raters, by how far they got.
    pub raters: Raters,
    /// Numbers of judgements of videos.
    pub coverage: Coverage,
    /// Agreement of raters, by question.
    pub agreement: Vec<Agreement>,
    /// Whether they are right, where labels are known.
    pub accuracy: Vec<Accuracy>,
    /// Counts of the answers that videos of each label get; `None` without labels.
    pub confusion: Option<Confusion>,
    /// Counts of the answers that agents of each goal get; `None` without labels, or if the form does not
    /// ask for goals. Several right answers are one label, `a or b`.
    pub goal_confusion: Option<Confusion>,
    /// The answers by condition; where a video has none, its kind of event stands for it.
    pub conditions: Vec<Answers>,
    /// The answers by set.
    pub sets: Vec<Answers>,
    /// The answers by video.
    pub videos: Vec<Answers>,
    /// Human-likeness of the events, by source.
    pub human_likeness: Vec<Likeness>,
    /// The differences between every two sources.
    pub human_likeness_differences: Vec<Difference>,
    /// Interactions that are seen: in all videos, then by source if there are several.
    pub interactions: Vec<Categories>,
}

impl Analysis {
    /// Analyses the answers of raters. The configuration's seed decides the resamples of intervals.
    #[must_use]
    pub fn of(config: &StudyConfig, forms: &Forms, raters: &[Rater]) -> Self {
        let judgements = Judgements::of(config, raters);
        let mut sources: Vec<Option<&str>> = vec![None];
        let names = config.sources();
        if names.len() > 1 {
            sources.extend(names.iter().map(|name| Some(*name)));
        }
        let asks_goals = config.form == Form::Goals;
        let asks_interactions = config.form == Form::Interactions;
        let likeness =
            if asks_goals { measures::likeness(&judgements, &names, config.seed) } else { Vec::new() };
        Self {
            format: REPORT_FORMAT,
            name: config.name.clone(),
            form: config.form.name(),
            raters: count(config, raters),
            coverage: judgements.coverage(config.stimuli.len()),
            agreement: measures::agreement(&judgements, config, forms),
            accuracy: measures::accuracy(&judgements, &sources, config.form, config.seed),
            confusion: confusion(&judgements, config.form, forms),
            goal_confusion: goal_confusion(&judgements, config.form, forms),
            conditions: by_condition(&judgements, config.form, forms, config.seed),
            sets: by_set(&judgements, config.form, forms, config.seed),
            videos: by_video(&judgements, config.form, forms, config.seed),
            human_likeness_differences: if asks_goals {
                measures::differences(&judgements, &names, config.seed)
            } else {
                Vec::new()
            },
            human_likeness: likeness,
            interactions: if asks_interactions {
                measures::interactions(&judgements, &sources, forms)
            } else {
                Vec::new()
            },
        }
    }
}

/// Counts the judgements of videos, by raters who count.
#[must_use]
pub fn coverage(config: &StudyConfig, raters: &[Rater]) -> Coverage {
    Judgements::of(config, raters).coverage(config.stimuli.len())
}

/// Counts the raters, by how far they got.
#[must_use]
pub fn count(config: &StudyConfig, raters: &[Rater]) -> Raters {
    let mut counts = Raters { joined: raters.len(), ..Raters::default() };
    for rater in raters {
        *match rater.standing(config) {
            Standing::Unfinished => &mut counts.unfinished,
            Standing::Failed => &mut counts.failed,
            Standing::Complete => &mut counts.complete,
            Standing::Declined => &mut counts.declined,
            Standing::Withdrawn => &mut counts.withdrawn,
        } += 1;
    }
    counts
}
