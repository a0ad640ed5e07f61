//! SIMPLE while an event is watched.

use crate::{packed, scenes, sentence};
use phase_eval::goals::Answer;
use phase_event::ObservedEvent;
use phase_model::AgentId;
use phase_render::Palette;
use phase_simple::{Budget, Guidance, Guide, Inference, InferenceSettings, IntentNetwork, ReportModel};
use serde_json::{Value, json};

/// Goals that are told in words.
const GOALS: usize = 4;

/// Infers goals, relation and roles from an event row by row.
#[derive(Debug)]
pub struct Observer {
    observer: phase_simple::Observer<'static>,
    reports: ReportModel,
}

impl Observer {
    /// Begins with the first row, a packed state. Of the scene only walls and sizes are looked at. `decisions` is what it spends on a
    /// row: a decision takes a few milliseconds.
    ///
    /// # Errors
    /// A sentence for an invalid scene or row.
    pub fn new(
        network: &'static IntentNetwork,
        scene: &str,
        row: &[f32],
        decisions: usize,
    ) -> Result<Self, String> {
        let scene = scenes::read(scene)?;
        let first = packed::states(row).next().ok_or("the first row is missing")?;
        let sizes = scene.objects.iter().map(|object| object.size).collect();
        let agents = scene.agents.map(|agent| agent.size);
        let observed =
            ObservedEvent::new(scene.layout, agents, sizes, vec![first.bodies]).map_err(sentence)?;
        let guide = Guide { network, guidance: Guidance::default() };
        let settings = InferenceSettings::default();
        let mut observer =
            phase_simple::Observer::new(&observed, Some(&guide), 0, &settings).map_err(sentence)?;
        observer.set_budget(Budget { decisions: Some(decisions) });
        Ok(Self { observer, reports: ReportModel::bundled().map_err(sentence)? })
    }

    /// Watches the next row, a packed state, and answers as `eval` does (`goals`, `relation`, `roles`, `reported`), with the likeliest
    /// goals in `words`.
    ///
    /// # Errors
    /// A sentence for an invalid row, and if a search fails.
    pub fn push(&mut self, row: &[f32]) -> Result<String, String> {
        let row = packed::states(row).next().ok_or("the row is missing")?;
        let inference = self.observer.push(row.bodies).map_err(sentence)?;
        self.answer(&inference)
    }

    fn answer(&self, inference: &Inference) -> Result<String, String> {
        let answer = Answer::of(&inference.judgement(&self.reports)).map_err(sentence)?;
        let words = AgentId::ALL.map(|agent| -> Vec<Value> {
            let goals = answer.goals[agent].iter().take(GOALS);
            goals.map(|it| json!({ "goal": Palette::PAPER.goal_text(it.goal, agent), "p": it.p })).collect()
        });
        let mut value = serde_json::to_value(&answer).map_err(sentence)?;
        value["words"] = json!(words);
        Ok(value.to_string())
    }
}
