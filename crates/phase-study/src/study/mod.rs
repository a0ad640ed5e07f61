//! A study that is under way: what each rater sees next, and what they answer.

mod error;
mod names;
mod stage;
mod token;
mod waiting;

pub use error::StudyError;
pub use stage::{Stage, TrialPage};
pub use token::Token;

use crate::{
    assignment::{Shown, assign},
    config::StudyConfig,
    forms::Forms,
    places::Places,
    question::Responses,
    record::{Departure, GivenAnswer, LONGEST_RESPONSE, MOST_PLAYS, Millis, Rater},
    store::{Page, Store, Writing},
};
use names::Names;
use phase_model::json::{Field, FieldError};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use waiting::Waiting;

/// Longest value of a member of the address that is kept (letters).
const LONGEST_PARAMETER: usize = 200;
/// The answer to a rater who comes.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Joined {
    /// The rater's token, which identifies them.
    pub token: Token,
    /// The first thing that the rater sees.
    pub stage: Stage,
}

/// The part of a study that is given, whatever raters do.
#[derive(Clone, Copy)]
struct Given<'a> {
    config: &'a StudyConfig,
    forms: &'a Forms,
    names: &'a Names,
}

/// A study with its answers: the state machine that raters go through.
///
/// A visitor is known by a random token, and nothing else: the id of a panel in the address is data. They
/// are a rater once they have agreed or refused; before that nothing is stored.
///
/// A rater comes ([`Study::join`]), agrees, answers questions about themselves, reads the instructions and
/// answers their trials, in this order. Each method takes one of these steps for the rater with a token and
/// returns the [`Stage`] that follows; a step out of order is refused and changes nothing. Once a method
/// returns, what it took is on the disk. Times are [`Millis`], given by the caller.
#[derive(Debug)]
pub struct Study {
    config: StudyConfig,
    forms: Forms,
    store: Store,
    places: Places,
    waiting: Waiting,
    names: Names,
    /// By their names in addresses the ids and files of all videos.
    videos: BTreeMap<String, (String, String)>,
}

impl Study {
    /// A study and the answers that it has so far.
    ///
    /// # Errors
    /// [`StudyError::Store`], also if the answers do not fit the configuration.
    pub fn new(config: StudyConfig, forms: Forms, mut store: Store) -> Result<Self, StudyError> {
        let raters = store.raters()?;
        store.fits(&config, &forms, &raters)?;
        let names = Names::new(store.secret()?);
        let videos = config.videos().map(|(id, file)| (names.of(id), (id.to_owned(), file.to_owned())));
        Ok(Self {
            videos: videos.collect(),
            places: Places::new(&config, &raters),
            waiting: Waiting::default(),
            names,
            config,
            forms,
            store,
        })
    }

    /// The configuration.
    #[must_use]
    pub const fn config(&self) -> &StudyConfig {
        &self.config
    }

    /// All raters in the order in which they came.
    ///
    /// # Errors
    /// [`StudyError::Store`].
    pub fn raters(&mut self) -> Result<Vec<Rater>, StudyError> {
        Ok(self.store.raters()?)
    }

    /// The file of a video, relative to that of the configuration, by its name in addresses. Names tell
    /// nothing of the video, and nobody can guess them.
    #[must_use]
    pub fn video(&self, name: &str) -> Option<&str> {
        self.videos.get(name).map(|(_, file)| file.as_str())
    }

    /// All videos: their names in addresses, and their files.
    pub fn addresses(&self) -> impl Iterator<Item = (&str, &str)> {
        self.videos.iter().map(|(name, (_, file))| (name.as_str(), file.as_str()))
    }

    /// Lets somebody in. `parameters` are the members of the address with which they came; those that the
    /// study does not keep are ignored. They are known by `token` from then on; nothing is stored before
    /// they agree.
    ///
    /// # Errors
    /// [`StudyError::Field`] if a member of the address is missing, too long or not a line of text.
    pub fn join(
        &mut self,
        parameters: &BTreeMap<String, String>,
        now: Millis,
        token: Token,
    ) -> Result<Joined, StudyError> {
        let kept = self.kept(parameters)?;
        if self.is_full(now) {
            return Ok(Joined { token, stage: Stage::Full });
        }
        self.waiting.add(token.digest(), now, kept);
        Ok(Joined { token, stage: stage::consent(&self.config) })
    }

    /// Whether nobody can be let in.
    fn is_full(&self, now: Millis) -> bool {
        let (load, holding) = self.places.load(earliest(&self.config, now));
        let most = self.config.raters_per_video_at_most;
        holding >= self.config.raters || load.iter().all(|&raters| raters >= most)
    }

    fn kept(&self, parameters: &BTreeMap<String, String>) -> Result<BTreeMap<String, String>, StudyError> {
        let wrong = |name: &str, rule: String| StudyError::Field(FieldError { field: name.into(), rule });
        let mut kept = BTreeMap::new();
        for name in &self.config.parameters {
            let Some(value) = parameters.get(name).filter(|value| !value.trim().is_empty()) else {
                continue;
            };
            if value.chars().count() > LONGEST_PARAMETER || value.chars().any(char::is_control) {
                return Err(wrong(name, format!("must be one line of at most {LONGEST_PARAMETER} letters")));
            }
            kept.insert(name.clone(), value.clone());
        }
        match self.config.parameters.first() {
            Some(first) if self.config.identity_required && !kept.contains_key(first) => {
                Err(wrong(first, "must be in the address with which one comes".into()))
            }
            _ => Ok(kept),
        }
    }

    /// The stage at which a rater is, which is all that their page shows.
    ///
    /// # Errors
    /// [`StudyError::Token`], [`StudyError::Store`].
    pub fn stage(&mut self, token: &Token) -> Result<Stage, StudyError> {
        if self.waiting.get(&token.digest()).is_some() {
            return Ok(stage::consent(&self.config));
        }
        self.step(token, "state", |_, _, _| Ok(()))
    }

    /// Takes a rater's agreement, after which they get their trials; or their refusal, of which only the
    /// fact is kept.
    ///
    /// # Errors
    /// [`StudyError::NotNow`] if the rater is past that; [`StudyError::Token`], [`StudyError::Store`].
    pub fn consent(&mut self, token: &Token, agrees: bool, now: Millis) -> Result<Stage, StudyError> {
        let digest = token.digest();
        let waiting = self.waiting.get(&digest);
        let full = self.is_full(now);
        let (load, _) = self.places.load(earliest(&self.config, now));
        let Self { config, forms, names, store, .. } = self;
        let done = store.write(|store| {
            let number = match (store.rater_of(&digest)?, waiting) {
                (Some(number), _) => number,
                // Where no place is left, nothing is stored: it may come again.
                (None, Some(_)) if agrees && full => return Ok(None),
                (None, Some((joined, parameters))) => {
                    let number = store.add_rater(*joined, parameters)?;
                    store.add_token(number, &digest)?;
                    number
                }
                (None, None) => return Err(StudyError::Token),
            };
            let rater = store.rater(number)?;
            if rater.departure.is_some() || rater.consented.is_some() {
                if rater.departure.is_none() != agrees {
                    return Err(StudyError::NotNow("consent"));
                }
            } else if agrees {
                let Some(trials) = assign(config, &load, number).filter(|_| !full) else { return Ok(None) };
                let trials: Vec<(&str, bool)> = trials
                    .iter()
                    .map(|shown| match *shown {
                        Shown::Stimulus(k) => (config.stimuli[k].id.as_str(), false),
                        Shown::CatchTrial(k) => (config.catch_trials[k].id.as_str(), true),
                    })
                    .collect();
                store.add_page(number, Page::Consent, now, None)?;
                store.add_trials(number, &trials)?;
            } else {
                store.depart(number, now, Departure::Declined)?;
            }
            Ok(Some(store.rater(number)?))
        })?;
        let Some(rater) = done else { return Ok(Stage::Full) };
        self.waiting.remove(&digest);
        self.places.update(&self.config, &rater);
        Ok(stage::of(Given { config: &self.config, forms, names }, &rater))
    }

    /// Takes a rater's answers about themselves, an object with a member for each question.
    ///
    /// # Errors
    /// [`StudyError::Field`], [`StudyError::NotNow`], [`StudyError::OtherAnswer`] if they have answered
    /// otherwise before; [`StudyError::Token`], [`StudyError::Store`].
    pub fn demographics(&mut self, token: &Token, answer: &Value, now: Millis) -> Result<Stage, StudyError> {
        self.step(token, "demographics", |Given { config, .. }, store, rater| {
            if rater.consented.is_none() || config.demographics.is_empty() {
                return Err(StudyError::NotNow("demographics"));
            }
            let answer = Responses::read(&Field::root(answer), &config.demographics)?;
            match &rater.demographics {
                Some((_, said)) if *said == answer => Ok(()),
                Some(_) => Err(StudyError::OtherAnswer),
                None => Ok(store.add_page(rater.number, Page::Demographics, now, Some(&answer))?),
            }
        })
    }

    /// Notes that a rater has read the instructions.
    ///
    /// # Errors
    /// [`StudyError::NotNow`], [`StudyError::Token`], [`StudyError::Store`].
    pub fn instructed(&mut self, token: &Token, now: Millis) -> Result<Stage, StudyError> {
        self.step(token, "instructions", |Given { config, .. }, store, rater| {
            let asked = !config.demographics.is_empty() && rater.demographics.is_none();
            match (rater.instructed, rater.consented) {
                (Some(_), _) => Ok(()),
                (None, Some(_)) if !asked => {
                    Ok(store.add_page(rater.number, Page::Instructions, now, None)?)
                }
                _ => Err(StudyError::NotNow("instructions")),
            }
        })
    }

    /// Takes the answer to a trial: an object with `trial` (its number, from 1), `answer` (a member for each
    /// question), `response_time` (ms) and `plays` (of the video to its end, at least 1 unless
    /// [`StudyConfig::answer_before_end`]). Once this returns it is on the disk. The same answer to the
    /// same trial may come again.
    ///
    /// # Errors
    /// [`StudyError::Field`], [`StudyError::NotNow`] for a trial that is not the next,
    /// [`StudyError::OtherAnswer`] for one that has another answer; [`StudyError::Token`],
    /// [`StudyError::Store`].
    pub fn answer(&mut self, token: &Token, submission: &Value, now: Millis) -> Result<Stage, StudyError> {
        self.step(token, "trial", |Given { config, forms, .. }, store, rater| {
            let root = Field::root(submission);
            root.only(&["trial", "answer", "response_time", "plays"])?;
            let number = root.required("trial")?.whole(1, i64::from(u32::MAX))?;
            let place = usize::try_from(number - 1).unwrap_or(usize::MAX);
            let Some(trial) = rater.trials.get(place).filter(|_| rater.instructed.is_some()) else {
                return Err(StudyError::NotNow("trial"));
            };
            let questions = trial.questions(config, forms);
            let given = GivenAnswer {
                at: now,
                answer: Responses::read(&root.required("answer")?, &questions)?,
                response_time: root.required("response_time")?.whole(0, LONGEST_RESPONSE)?,
                plays: root.required("plays")?.whole(i64::from(!config.answer_before_end), MOST_PLAYS)?,
            };
            match &trial.given {
                Some(before) if before.answer == given.answer => Ok(()),
                Some(_) => Err(StudyError::OtherAnswer),
                None if rater.next_trial() != Some(place) => Err(StudyError::NotNow("trial")),
                None => Ok(store.add_answer(rater.number, place, &given)?),
            }
        })
    }

    /// Lets a rater withdraw: their answers, also those about themselves, and the members of the address
    /// with which they came are deleted.
    ///
    /// # Errors
    /// [`StudyError::Token`], [`StudyError::Store`].
    pub fn withdraw(&mut self, token: &Token, now: Millis) -> Result<Stage, StudyError> {
        self.step(token, "withdraw", |_, store, rater| match rater.departure {
            Some(_) => Ok(()),
            None => Ok(store.depart(rater.number, now, Departure::Withdrew)?),
        })
    }

    /// Does something for a rater at a page, and returns what they see then.
    fn step(
        &mut self,
        token: &Token,
        page: &'static str,
        action: impl FnOnce(Given<'_>, &Writing<'_>, &Rater) -> Result<(), StudyError>,
    ) -> Result<Stage, StudyError> {
        let digest = token.digest();
        let waits = self.waiting.get(&digest).is_some();
        let given = Given { config: &self.config, forms: &self.forms, names: &self.names };
        let rater = self.store.write(|store| {
            let number = match store.rater_of(&digest)? {
                Some(number) => number,
                None if waits => return Err(StudyError::NotNow(page)),
                None => return Err(StudyError::Token),
            };
            action(given, store, &store.rater(number)?)?;
            Ok(store.rater(number)?)
        })?;
        self.places.update(&self.config, &rater);
        Ok(stage::of(given, &rater))
    }
}

/// The moment before which a rater must have given a sign to keep its places.
fn earliest(config: &StudyConfig, now: Millis) -> Millis {
    now.saturating_sub(i64::from(config.minutes) * 60_000)
}
