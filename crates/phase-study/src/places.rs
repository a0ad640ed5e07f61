//! Places of a study that are taken: how many raters each video has, kept up to date with every step of a
//! rater, so that nobody waits for the study to be counted.

use crate::{
    config::StudyConfig,
    record::{Millis, Rater, Standing},
};
use std::collections::{BTreeMap, HashMap};

/// The places of a study that are taken.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// Stimuli by their ids.
    indices: HashMap<String, usize>,
    /// By stimulus, raters that count.
    complete: Vec<u32>,
    /// Number of raters that count.
    count: u32,
    /// Those that may yet: stimuli by the time of the last sign and the number of the rater.
    unfinished: BTreeMap<(Millis, u64), Vec<usize>>,
    /// By number, the rater's entry above, or the stimuli of one who counts.
    held: HashMap<u64, Held>,
}

#[derive(Clone, Debug)]
enum Held {
    Unfinished(Millis),
    Complete(Vec<usize>),
}

impl Places {
    /// The places that these raters take.
    pub(crate) fn new(config: &StudyConfig, raters: &[Rater]) -> Self {
        let indices = config.stimuli.iter().enumerate().map(|(k, stimulus)| (stimulus.id.clone(), k));
        let mut places =
            Self { indices: indices.collect(), complete: vec![0; config.stimuli.len()], ..Self::default() };
        raters.iter().for_each(|rater| places.update(config, rater));
        places
    }

    /// Takes note of a rater, who is new or has taken a step.
    pub(crate) fn update(&mut self, config: &StudyConfig, rater: &Rater) {
        match self.held.remove(&rater.number) {
            Some(Held::Unfinished(at)) => {
                self.unfinished.remove(&(at, rater.number));
            }
            Some(Held::Complete(videos)) => {
                self.count -= 1;
                videos.into_iter().for_each(|k| self.complete[k] -= 1);
            }
            None => {}
        }
        if rater.trials.is_empty() {
            return;
        }
        let shown = rater.trials.iter().filter_map(|trial| self.indices.get(&trial.shown).copied());
        let videos: Vec<usize> = shown.collect();
        let held = match rater.standing(config) {
            Standing::Complete => {
                self.count += 1;
                videos.iter().for_each(|&k| self.complete[k] += 1);
                Held::Complete(videos)
            }
            Standing::Unfinished => {
                self.unfinished.insert((rater.last_seen(), rater.number), videos);
                Held::Unfinished(rater.last_seen())
            }
            Standing::Failed | Standing::Declined | Standing::Withdrawn => return,
        };
        self.held.insert(rater.number, held);
    }

    /// Number of raters of each stimulus, by its index: those that count, and those that gave a sign since
    /// `since` and may yet. Also how many such raters there are.
    pub(crate) fn load(&self, since: Millis) -> (Vec<u32>, u32) {
        let (mut load, mut count) = (self.complete.clone(), self.count);
        for videos in self.unfinished.range((since, 0)..).map(|(_, videos)| videos) {
            count += 1;
            videos.iter().for_each(|&k| load[k] += 1);
        }
        (load, count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        forms::{Form, Forms},
        question::Responses,
        record::{Departure, GivenAnswer, Trial},
    };
    use phase_model::json::Field;
    use proptest::prelude::*;
    use serde_json::json;

    fn config() -> StudyConfig {
        let stimulus = |k: usize| json!({"id": k.to_string(), "video": format!("{k}.mp4")});
        let config = json!({
            "format": "phase-study/1", "name": "a", "title": "A", "form": "relation", "consent": ["?"],
            "instructions": ["!"], "stimuli": [stimulus(0), stimulus(1), stimulus(2)],
            "catch_trials": [{"id": "c", "video": "c.mp4", "expected": {"relation": "neutral"}}],
            "raters_per_video": 2, "videos_per_rater": 2,
        });
        let forms = Forms::included().expect("forms");
        StudyConfig::read(config.to_string().as_bytes(), &forms).expect("valid")
    }

    /// A rater who was last seen at a time: has answered so many of its trials, the catch trial as it should
    /// or not, and may have left.
    fn rater(number: u64, at: Millis, answered: usize, passes: bool, left: bool) -> Rater {
        let relation = if passes { "neutral" } else { "friendly" };
        let questions = Forms::included().expect("forms").questions(Form::Relation, 2);
        let answer = json!({ "relation": relation });
        let answer = Responses::read(&Field::root(&answer), &questions).expect("an answer");
        let shown = [(number % 3).to_string(), "c".to_owned(), ((number + 1) % 3).to_string()];
        let trial = |(k, shown): (usize, String)| Trial {
            catch: shown == "c",
            shown,
            given: (k < answered).then(|| GivenAnswer {
                at,
                answer: answer.clone(),
                response_time: 1,
                plays: 1,
            }),
        };
        Rater {
            number,
            joined: at,
            parameters: BTreeMap::new(),
            departure: left.then_some(Departure::Withdrew),
            consented: Some(at),
            demographics: None,
            instructed: None,
            trials: if left { Vec::new() } else { shown.into_iter().enumerate().map(trial).collect() },
        }
    }

    /// Counted anew, over all raters.
    fn counted(config: &StudyConfig, raters: &[Rater], since: Millis) -> (Vec<u32>, u32) {
        let holds = |rater: &&Rater| match rater.standing(config) {
            Standing::Complete => true,
            Standing::Unfinished => !rater.trials.is_empty() && rater.last_seen() >= since,
            _ => false,
        };
        let holding: Vec<&Rater> = raters.iter().filter(holds).collect();
        let of = |id: &str| {
            let has = |rater: &&&Rater| rater.trials.iter().any(|trial| trial.shown == id);
            holding.iter().filter(has).count() as u32
        };
        (config.stimuli.iter().map(|stimulus| of(&stimulus.id)).collect(), holding.len() as u32)
    }

    proptest! {
        #[test]
        fn it_is_always_what_counting_would_give(
            steps in prop::collection::vec(
                (0_u64..6, 0_i64..50, 0_usize..4, any::<bool>(), any::<bool>()), 0..60
            ),
            since in 0_i64..60,
        ) {
            let config = config();
            let mut raters = BTreeMap::new();
            let mut places = Places::new(&config, &[]);
            for (number, at, answered, passes, left) in steps {
                let rater = rater(number, at, answered, passes, left);
                places.update(&config, &rater);
                raters.insert(number, rater);
                let all: Vec<Rater> = raters.values().cloned().collect();
                prop_assert_eq!(places.load(since), counted(&config, &all, since));
                prop_assert_eq!(Places::new(&config, &all).load(since), places.load(since));
            }
        }
    }
}
