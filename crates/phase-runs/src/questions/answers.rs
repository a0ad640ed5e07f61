//! Answers of the methods of the benchmark, and guesses without motion.

use super::{GUESS, RULES, guess::guesses, line};
use crate::{error::RunError, laboratory::create};
use core::ops::ControlFlow;
use phase_event::{Forecaster, ObservedEvent, ProgressCallback, Recogniser};
use phase_evidence::Track;
use phase_files::atomic;
use phase_model::{
    Judgement,
    random::{Purpose, stream},
};
use phase_questions::{
    BUDGETS, Control, Facts, FrameBudget, Query, Question, Watched, reordered, sampled, stills,
};
use rand::{RngExt, seq::SliceRandom};
use serde_json::json;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// Folder of the answers.
pub(super) const FOLDER: &str = "answers";

/// Judgements of a method about what is shown, by budget and, after them, of shuffled and reversed frames.
pub(super) type Judged = Vec<Option<Judgement>>;

/// Events as somebody sees them, and the judgements of a method about them.
pub(super) struct Watcher<'a> {
    judged: BTreeMap<(&'a str, Option<usize>), (&'a Facts, Judged)>,
}

/// Every event that questions show, with the last step that is shown, and whether a judgement about it can
/// answer any of them.
pub(super) fn all_shown<'a>(
    facts: &BTreeMap<&str, &'a Facts>,
    all: &[Question],
) -> Vec<(&'a Facts, Option<usize>, bool)> {
    let mut shown: BTreeMap<(&str, Option<usize>), bool> = BTreeMap::new();
    for question in all {
        for event in &question.events {
            *shown.entry((event, question.until)).or_default() |= !question.query.is_physical();
        }
    }
    let known = |((event, until), is_judged)| Some((*facts.get(event)?, until, is_judged));
    shown.into_iter().filter_map(known).collect()
}

/// The motion that is shown, up to a step.
fn shown(facts: &Facts, until: Option<usize>) -> Track {
    until.map_or_else(|| facts.track.clone(), |step| facts.track.until(step))
}

/// The frames in random order, which depends on the seed alone.
fn shuffled(track: &Track, seed: u64) -> Track {
    let frames = track.states.len();
    let mut order: Vec<usize> = (0..frames).collect();
    order.shuffle(&mut stream(seed, Purpose::Evaluation, frames as u64));
    reordered(track, &order)
}

fn reversed(track: &Track) -> Track {
    let order: Vec<usize> = (0..track.states.len()).rev().collect();
    reordered(track, &order)
}

/// The forms in which a method is shown an event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Forms {
    /// All frames.
    Video,
    /// Every number of frames.
    Budgets,
    /// Every number of frames, and all in other orders.
    BudgetsAndOrders,
}

/// Asks a method about an event; `None` if it was cancelled.
pub(super) fn judge(
    method: &dyn Recogniser,
    facts: &Facts,
    until: Option<usize>,
    forms: Forms,
    seed: u64,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Judged>, RunError> {
    let track = shown(facts, until);
    let mut tracks: Vec<Option<Track>> = BUDGETS
        .into_iter()
        .map(|budget| {
            let wanted = forms != Forms::Video || budget == FrameBudget::All;
            wanted.then(|| sampled(&track, budget))
        })
        .collect();
    let in_orders = forms == Forms::BudgetsAndOrders;
    tracks.push(in_orders.then(|| shuffled(&track, seed)));
    tracks.push(in_orders.then(|| reversed(&track)));
    let mut judged: Judged = Vec::with_capacity(tracks.len());
    for track in tracks {
        let Some(track) = track else {
            judged.push(None);
            continue;
        };
        let observed = observed(facts, &track)?;
        let answer = method.judge(&observed, seed, tick);
        let answer = answer.map_err(|source| RunError::Method { id: facts.id.clone(), source })?;
        let Some((judgement, _)) = answer else { return Ok(None) };
        judged.push(Some(judgement));
    }
    Ok(Some(judged))
}

/// An event of which this much has been observed.
fn observed(facts: &Facts, track: &Track) -> Result<ObservedEvent, RunError> {
    let rows = track.states.iter().map(|state| state.bodies).collect();
    ObservedEvent::in_scene(&facts.scene, rows)
        .map_err(|error| RunError::Usage(format!("event {}: {error}", facts.id)))
}

impl<'a> Watcher<'a> {
    /// `judged` has one entry for each of `shown`.
    pub(super) fn new(shown: Vec<(&'a Facts, Option<usize>, bool)>, judged: Vec<Judged>) -> Self {
        let entry = |((facts, until, _), judged): ((&'a Facts, _, _), Judged)| {
            ((facts.id.as_str(), until), (facts, judged))
        };
        Self { judged: shown.into_iter().zip(judged).map(entry).collect() }
    }

    /// Events that no method has judged.
    pub(super) fn unjudged(facts: &BTreeMap<&str, &'a Facts>, all: &[Question]) -> Self {
        let shown = all_shown(facts, all);
        let judged = vec![Judged::new(); shown.len()];
        Self::new(shown, judged)
    }

    /// An event in a number of frames.
    pub(super) fn watch(&self, event: &str, until: Option<usize>, budget: FrameBudget) -> Option<Watched> {
        let (facts, judged) = self.judged.get(&(event, until))?;
        let place = BUDGETS.iter().position(|it| *it == budget)?;
        let shown = shown(facts, until);
        let judgement = judged.get(place).cloned().flatten();
        Some(Watched { track: sampled(&shown, budget), stills: stills(&shown, budget), judgement })
    }

    /// An event in frames of another order.
    fn watch_order(&self, event: &str, until: Option<usize>, control: Control, seed: u64) -> Option<Watched> {
        let (facts, judged) = self.judged.get(&(event, until))?;
        let track = shown(facts, until);
        let (track, place) = match control {
            Control::Shuffled => (shuffled(&track, seed), BUDGETS.len()),
            _ => (reversed(&track), BUDGETS.len() + 1),
        };
        let judgement = judged.get(place).cloned().flatten();
        Some(Watched { stills: track.clone(), track, judgement })
    }

    /// The option that is chosen under a control, if anything speaks for one.
    fn choice(&self, question: &Question, control: Control, seed: u64) -> Option<usize> {
        let values: Vec<String> = question.options.iter().map(|option| option.value.clone()).collect();
        let watched = question.events.iter().map(|event| match control {
            Control::Shuffled | Control::Reversed => self.watch_order(event, question.until, control, seed),
            _ => self.watch(event, question.until, FrameBudget::All),
        });
        let watched: Option<Vec<Watched>> = watched.collect();
        question.query.choice(&watched?, &values)
    }
}

/// A random option, where nothing speaks for any.
fn by_chance(question: &Question, seed: u64) -> usize {
    let id = super::event_seed(seed, &question.id);
    stream(id, Purpose::Evaluation, 0).random_range(0..question.options.len().max(1))
}

fn answer(question: &Question, control: Control, option: usize) -> Result<String, RunError> {
    let letter = Question::letter(option).to_string();
    line(&json!({ "id": question.id, "control": control.name(), "answer": letter }))
}

/// Writes the answers of a method to the types of questions of which it judges any: [`RULES`] those about
/// what happens and what is seen and believed, others those about goals and relations. Where nothing speaks
/// for an option, one is chosen at random. The result is the number of these.
pub(super) fn write(
    out: &Path,
    method: &str,
    all: &[Question],
    watcher: &Watcher<'_>,
    seed: u64,
) -> Result<usize, RunError> {
    let mut lines = String::new();
    let mut open = 0;
    let mut judged = BTreeSet::new();
    for control in [Control::Video, Control::Shuffled, Control::Reversed] {
        if control != Control::Video && method != RULES && watcher.is_for_video_alone() {
            continue;
        }
        let asked = all.iter().filter(|question| question.query.is_physical() == (method == RULES));
        let choices: Vec<_> =
            asked.map(|question| (question, watcher.choice(question, control, seed))).collect();
        if control == Control::Video {
            judged = choices.iter().filter(|it| it.1.is_some()).map(|it| it.0.query.type_name()).collect();
        }
        for (question, choice) in choices {
            if judged.contains(question.query.type_name()) {
                open += usize::from(choice.is_none());
                lines += &answer(question, control, choice.unwrap_or_else(|| by_chance(question, seed)))?;
            }
        }
    }
    write_lines(out, method, &lines)?;
    Ok(open)
}

/// The room in which a method sees the entity of a question about the future, as one of its options; the
/// outer `None` means that it was cancelled.
pub(super) fn forecast(
    method: &dyn Forecaster,
    facts: &Facts,
    question: &Question,
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<Option<usize>>, RunError> {
    let Query::Ahead { entity, after, .. } = question.query else { return Ok(Some(None)) };
    let observed = observed(facts, &shown(facts, question.until))?;
    let answer = method.forecast(&observed, after, seed, tick);
    let answer = answer.map_err(|source| RunError::Method { id: facts.id.clone(), source })?;
    let Some((prediction, _)) = answer else { return Ok(None) };
    let place = prediction.forecast.get(entity.index()).and_then(|path| path.last());
    let room = place.map(|&place| phase_model::layout::room_of(place).to_string());
    Ok(Some(question.options.iter().position(|option| Some(&option.value) == room.as_ref())))
}

/// Writes answers to questions about the future, and returns how many were left to chance.
pub(super) fn write_forecasts(
    out: &Path,
    method: &str,
    choices: &[(&Question, Option<usize>)],
    seed: u64,
) -> Result<usize, RunError> {
    let mut lines = String::new();
    for (question, choice) in choices {
        let option = choice.unwrap_or_else(|| by_chance(question, seed));
        lines += &answer(question, Control::Video, option)?;
    }
    write_lines(out, method, &lines)?;
    Ok(choices.iter().filter(|(_, choice)| choice.is_none()).count())
}

impl Watcher<'_> {
    fn is_for_video_alone(&self) -> bool {
        self.judged.values().all(|(_, judged)| judged.get(BUDGETS.len()).is_none_or(Option::is_none))
    }
}

/// Writes guesses from the words alone and from the first frame.
pub(super) fn write_guesses(
    out: &Path,
    all: &[Question],
    facts: &BTreeMap<&str, &Facts>,
) -> Result<usize, RunError> {
    let mut lines = String::new();
    for control in [Control::NoVideo, Control::FirstFrame] {
        for (question, option) in all.iter().zip(guesses(all, facts, control)) {
            lines += &answer(question, control, option)?;
        }
    }
    write_lines(out, GUESS, &lines)?;
    Ok(0)
}

/// Writes random answers.
pub(super) fn write_chance(out: &Path, all: &[Question], seed: u64) -> Result<usize, RunError> {
    let mut lines = String::new();
    for question in all {
        lines += &answer(question, Control::Video, by_chance(question, seed))?;
    }
    write_lines(out, "chance", &lines)?;
    Ok(all.len())
}

fn write_lines(out: &Path, name: &str, lines: &str) -> Result<(), RunError> {
    create(&out.join(FOLDER))?;
    Ok(atomic::write(&out.join(FOLDER).join(format!("{name}.jsonl")), lines.as_bytes())?)
}

/// A table of positions four times a second, for models that read in place of watching.
pub(super) fn table(track: &Track, names: &phase_model::words::Names) -> String {
    let entities: Vec<_> = track.physics.entities().collect();
    let mut text = String::from("time (s)");
    for &entity in &entities {
        let name = names.entity(entity);
        text += &format!("; {name} x, y");
        if matches!(entity, phase_model::Entity::Agent(_)) {
            text += ", heading (degrees, 0 right, 90 up)";
        }
    }
    for (step, state) in track.states.iter().enumerate() {
        text += &format!("\n{}", step as f64 * phase_model::arena::STEP_VIDEO_SECONDS);
        for &entity in &entities {
            let body = state.body(entity);
            text += &format!("; {:.1}, {:.1}", body.position.x, body.position.y);
            if matches!(entity, phase_model::Entity::Agent(_)) {
                let degrees = (body.angle.to_degrees() + 90.0).rem_euclid(360.0);
                text += &format!(", {degrees:.0}");
            }
        }
    }
    text
}
