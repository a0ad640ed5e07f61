//! SIMPLE while an event is watched.

use crate::{packed, scenes, sentence};
use phase_eval::goals::Answer;
use phase_event::ObservedEvent;
use phase_model::{AgentId, words::Names};
use phase_simple::{Budget, Inference, Observer, Simple};
use serde_json::{Value, json};

/// Goals that are told in words.
const GOALS: usize = 4;
/// Seed of its minds' search.
const SEED: u64 = 0;

/// A page's observer: infers goals, relation and roles from an event row by row, and puts them into words.
#[derive(Debug)]
pub struct PageObserver {
    simple: Simple,
    observer: Observer,
}

impl PageObserver {
    /// Begins with the first row, a packed state. Of the scene only walls and sizes are looked at.
    /// `decisions` is what it spends on a row: a decision takes a few milliseconds.
    ///
    /// # Errors
    /// A sentence for an invalid scene or row.
    pub fn new(scene: &str, row: &[f32], decisions: usize) -> Result<Self, String> {
        let scene = scenes::read(scene)?;
        let first = packed::states(row).next().ok_or("the first row is missing")?;
        let observed = ObservedEvent::in_scene(&scene, vec![first.bodies]).map_err(sentence)?;
        Self::watching(&observed, decisions)
    }

    /// Begins with the first row of an event of a file, whose labels may be absent and are not looked at.
    ///
    /// # Errors
    /// A sentence for an invalid file, or one without such an event.
    pub fn of_event(file: &str, index: usize, decisions: usize) -> Result<Self, String> {
        let events = phase_event::parse_observed(file.as_bytes()).map_err(sentence)?;
        let (_, observed) = events.get(index).ok_or("there is no such event")?;
        Self::watching(&observed.prefix(0), decisions)
    }

    fn watching(observed: &ObservedEvent, decisions: usize) -> Result<Self, String> {
        let simple = Simple::bundled().map_err(sentence)?;
        let mut observer = simple.observer(observed, SEED).map_err(sentence)?;
        observer.set_budget(Budget { decisions: Some(decisions) });
        Ok(Self { simple, observer })
    }

    /// Watches the next row, a packed state, and answers as `eval` does (`goals`, `relation`, `roles`,
    /// `reported`), with the likeliest goals in `words`.
    ///
    /// # Errors
    /// A sentence for an invalid row, and if a search fails.
    pub fn push(&mut self, row: &[f32]) -> Result<String, String> {
        let row = packed::states(row).next().ok_or("the row is missing")?;
        let inference = self.observer.push(row.bodies).map_err(sentence)?;
        self.answer(&inference)
    }

    fn answer(&self, inference: &Inference) -> Result<String, String> {
        let answer = Answer::of(&self.simple.judgement(inference)).map_err(sentence)?;
        let words = AgentId::ALL.map(|agent| -> Vec<Value> {
            let goals = answer.goals[agent].iter().take(GOALS);
            goals.map(|it| json!({ "goal": Names::PAPER.wants(it.goal, agent), "p": it.p })).collect()
        });
        let mut value = serde_json::to_value(&answer).map_err(sentence)?;
        value["words"] = json!(words);
        Ok(value.to_string())
    }
}
