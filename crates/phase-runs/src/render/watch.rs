//! Inference of an observer about an event while it watches it, for a video.

use crate::{error::RunError, source::SeenEvent};
use core::ops::ControlFlow;
use phase_event::MethodError;
use phase_model::{
    AgentId, Attitude, Entity, Goal, RelationProbabilities, RoleProbabilities, arena::STEP_VIDEO_SECONDS,
    words,
};
use phase_render::{Caption, Palette};
use phase_simple::{Inference, Simple};
use serde::Serialize;
use std::time::Instant;

/// Goals shown of each agent.
const GOALS: usize = 2;
/// Statement of an observer after some seconds.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Watched {
    /// Seconds of video watched.
    pub(super) seconds: f64,
    /// P(goal) of each agent, likeliest first.
    pub(super) goals: [Vec<GoalShare>; 2],
    /// P(relation).
    pub(super) relation: RelationProbabilities,
    /// The share of people who would report each relation now.
    pub(super) reported: Option<RelationProbabilities>,
    /// P(helps) and P(hinders) of each agent.
    pub(super) roles: RoleProbabilities,
    /// Time that the step took (s).
    pub(super) took: f64,
}

/// A goal with its probability.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct GoalShare {
    goal: Goal,
    p: f64,
}

/// Watches an event to its end: what SIMPLE says at its first row and after each step. `interrupted` is asked
/// between steps; if it says so, the result is `None`.
pub(super) fn watch(
    event: &SeenEvent<'_>,
    seed: u64,
    interrupted: &dyn Fn() -> bool,
) -> Result<Option<Vec<Watched>>, RunError> {
    let failed = |error: MethodError| RunError::Method { id: event.id.clone().into_owned(), source: error };
    let observed = &event.observed;
    let simple = Simple::bundled()?;
    let observer = simple.observer(&observed.prefix(0), seed);
    let mut observer = observer.map_err(|error| failed(MethodError::new(error)))?;
    let mut watched = Vec::with_capacity(observed.rows().len());
    for (step, row) in observed.rows().iter().enumerate() {
        if interrupted() {
            return Ok(None);
        }
        let begun = Instant::now();
        let inference = if step == 0 {
            observer
                .inference(&mut || ControlFlow::Continue(()))
                .map_err(|error| failed(MethodError::new(error)))?
        } else {
            Some(observer.push(*row).map_err(|error| failed(MethodError::new(error)))?)
        };
        let took = begun.elapsed().as_secs_f64();
        if let Some(inference) = inference {
            let seconds = step as f64 * STEP_VIDEO_SECONDS;
            watched.push(Watched::of(&inference, &simple, seconds, took));
        }
    }
    Ok(Some(watched))
}

impl Watched {
    fn of(inference: &Inference, simple: &Simple, seconds: f64, took: f64) -> Self {
        let posterior = &inference.posterior;
        let goals = AgentId::ALL.map(|agent| {
            let goals = posterior.goals(agent).into_iter();
            goals.take(GOALS).map(|(goal, p)| GoalShare { goal, p }).collect()
        });
        let reported = simple.judgement(inference).reported;
        Self { seconds, goals, relation: posterior.relation(), reported, roles: posterior.roles(), took }
    }

    /// The line above the picture.
    pub(super) fn title(&self) -> String {
        format!("SIMPLE after {:.1} s", self.seconds)
    }

    /// The lines below the picture: relation, roles and goals, each with a bar as long as it is probable.
    pub(super) fn captions(&self, palette: &Palette) -> Vec<Caption> {
        let RelationProbabilities { friendly, adversarial, neutral } = self.relation;
        let reported = |of: fn(&RelationProbabilities) -> f64| {
            self.reported.as_ref().map_or_else(|| "–".to_owned(), |it| format!("{:.2}", of(it)))
        };
        let line = |name: &str, p: f64, said: String| Caption {
            cells: vec![format!("{p:.2}"), said],
            text: name.to_owned(),
            bar: p as f32,
        };
        let heading = |cells: &[&str], text: String| Caption {
            cells: cells.iter().map(|&cell| cell.to_owned()).collect(),
            text,
            bar: 0.0,
        };
        let mut lines = vec![
            heading(&["P", "people"], "relation (people: as reported)".to_owned()),
            line("friendly", friendly, reported(|it| it.friendly)),
            line("adversarial", adversarial, reported(|it| it.adversarial)),
            line("neutral", neutral, reported(|it| it.neutral)),
            self.role(palette),
        ];
        for agent in AgentId::ALL {
            lines.push(heading(&["P"], format!("the {} wants", palette.names.entity(Entity::Agent(agent)))));
            let goals = self.goals[agent].iter().map(|share| Caption {
                cells: vec![format!("{:.2}", share.p)],
                text: palette.names.wants_briefly(share.goal, agent),
                bar: share.p as f32,
            });
            lines.extend(goals.chain(core::iter::repeat_with(Caption::default)).take(GOALS));
        }
        lines
    }

    /// The likeliest of the four roles.
    fn role(&self, palette: &Palette) -> Caption {
        let of =
            |agent: AgentId, attitude| (self.roles.of(agent, attitude), agent, words::attitude(attitude));
        let roles = AgentId::ALL
            .into_iter()
            .flat_map(|agent| [Attitude::Help, Attitude::Hinder].map(|it| of(agent, it)));
        let Some((p, agent, verb)) = roles.max_by(|a, b| a.0.total_cmp(&b.0)) else {
            return Caption::default();
        };
        let [who, whom] = [agent, agent.other()].map(|agent| palette.names.agents[agent]);
        Caption { cells: vec![format!("{p:.2}")], text: format!("{who} {verb} {whom}"), bar: p as f32 }
    }

    /// The relation's probabilities as shares of a course.
    pub(super) fn shares(&self) -> [f32; 3] {
        [self.relation.friendly, self.relation.adversarial, self.relation.neutral].map(|p| p as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::Watched;
    use crate::picture::SHEET_SIDE;
    use phase_model::{AgentId, RelationProbabilities, RoleProbabilities};
    use phase_render::{Palette, SizedFont, Style};
    use phase_simple::physical_goals;

    /// No line is cut off, neither in a video nor in the smaller pictures of a contact sheet.
    #[test]
    fn what_is_said_of_every_goal_fits_below_the_picture() {
        let relation = RelationProbabilities { friendly: 0.2, adversarial: 0.3, neutral: 0.5 };
        let of = |agent| {
            physical_goals(agent, 2)
                .into_iter()
                .flat_map(move |goal| [(agent, goal), (agent, goal.negated())])
        };
        for (agent, goal) in AgentId::ALL.into_iter().flat_map(of) {
            let mut goals = [Vec::new(), Vec::new()];
            goals[agent].push(super::GoalShare { goal, p: 0.25 });
            let roles = RoleProbabilities::default();
            let watched =
                Watched { seconds: 9.0, goals, relation, reported: Some(relation), roles, took: 0.0 };
            for style in [Style::default(), Style::with_side(SHEET_SIDE)] {
                let font = SizedFont::new(style.text_size()).expect("the font");
                for line in watched.captions(&Palette::PAPER) {
                    let left = style.cell_width() * line.cells.len() as u32 + style.text_size().div_ceil(2);
                    let room = style.text_width() - left;
                    assert!(
                        font.width(&line.text) <= room as f32,
                        "{} does not fit {room} pixels",
                        line.text
                    );
                }
            }
        }
    }
}
