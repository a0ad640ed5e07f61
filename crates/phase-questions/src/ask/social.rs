//! Questions about relation, kind, roles, goals and strengths.

use super::{Asker, shown::shows_role, shows_relation, texts};
use crate::{
    Facts,
    query::{Query, agent_value},
};
use phase_evidence::GoalOutcome;
use phase_model::{AgentId, Attitude, Entity, EventKind, Goal, LandmarkId, Sign, arena::LANDMARKS};
use serde_json::{Value, json};

/// Kinds of which a viewer can see that one fits and the others do not: who helps wants what the other wants,
/// as those who work together do, and rivals keep each other from their goals, as a hinderer does. Which of
/// two alike is offered is the kind itself, or by chance.
fn distinct_kinds(kind: EventKind, id: &str) -> Vec<String> {
    let chance = id.bytes().fold(7_u8, |sum, byte| sum.wrapping_mul(31).wrapping_add(byte));
    let one_of = |alike: [EventKind; 2], bit: u8| {
        if alike.contains(&kind) { kind } else { alike[usize::from(chance >> bit & 1)] }
    };
    let friendly = one_of([EventKind::Helping, EventKind::Collaborating], 3);
    let adversarial = one_of([EventKind::Hindering, EventKind::Competing], 5);
    [friendly, adversarial, EventKind::Chasing, EventKind::Independent]
        .map(|it| it.name().to_owned())
        .to_vec()
}

impl Asker<'_> {
    /// Relation, kind, roles, goals and strengths: the labels of the scene.
    pub(super) fn social(&mut self) {
        let scene = &self.facts.scene;
        let objects = scene.objects.len();
        let stratum = format!("{objects} objects");
        let labels = json!({ "goals": scene.goals(), "alphas": scene.attitudes(), "kind": scene.kind,
            "rule": "goals and attitudes of the scene; the event passed the test that it shows its label",
        });
        if shows_relation(scene, &self.facts.track) {
            self.relation(&stratum, &labels);
        }
        for agent in AgentId::ALL {
            let goal = scene.agents[agent].goal;
            if scene.agents[agent].attitude == Attitude::Neutral && goal.sign() == Sign::Positive {
                self.goal(agent, goal, &labels);
            }
        }
        let strengths = scene.agents.map(|agent| agent.strength);
        let sizes = scene.agents.map(|agent| agent.size);
        let stratum = format!("{:?}", sizes[0].radius().total_cmp(&sizes[1].radius()));
        let forces = strengths.map(|strength| strength.max_force());
        // The strength has to show: a viewer compares speeds.
        let stronger = if forces[0] > forces[1] { "0" } else { "1" };
        let is_seen = Query::Stronger.seen(&self.facts.track).as_deref() == Some(stronger);
        if forces[0] != forces[1] && is_seen {
            let proof =
                json!({ "max_forces_newton": forces, "rule": "the scene; the stronger one moves faster" });
            self.ask(Query::Stronger, texts(["0", "1"]), stronger.to_owned(), stratum, proof);
        }
    }

    /// Relation, kind and roles of an event in which they are seen.
    fn relation(&mut self, stratum: &str, labels: &Value) {
        let scene = &self.facts.scene;
        let relation = scene.relation().name().to_owned();
        self.ask(
            Query::Relation,
            texts(["friendly", "adversarial", "neutral"]),
            relation,
            stratum.to_owned(),
            labels.clone(),
        );
        if let (Some(ratings), Some(draft)) = (self.facts.ratings, self.drafts.last_mut()) {
            let all = ratings.iter().sum::<usize>() as f64;
            draft.p_human = Some(ratings.iter().map(|&count| count as f64 / all).collect());
        }
        let kinds = distinct_kinds(scene.kind, &self.facts.id);
        let stratum = format!("{stratum}, {}", kinds.join(", "));
        self.ask(Query::Kind, kinds, scene.kind.name().to_owned(), stratum, labels.clone());
        self.role(labels);
    }

    /// The agent that acts upon the other. Whether that is help or hindrance is not asked with it: who takes
    /// over what the other has begun may do either, and it depends on what the other wants.
    fn role(&mut self, labels: &Value) {
        let Facts { scene, track, .. } = self.facts;
        let social = AgentId::ALL.into_iter().find(|&it| scene.agents[it].attitude != Attitude::Neutral);
        let value = match social {
            Some(agent) if shows_role(scene, track, agent) => agent_value(agent),
            // Agents with one goal or with goals that conflict help or hinder each other in a way.
            None if scene.kind == EventKind::Independent => "neither".to_owned(),
            _ => return,
        };
        let values = texts(["0", "1", "neither"]);
        self.ask(Query::Role, values, value, self.nearer_to_first_object(), labels.clone());
    }

    /// The landmark of a goal, among those at which its subject is not already.
    fn goal(&mut self, agent: AgentId, goal: Goal, labels: &Value) {
        let (Some(landmark), Some(first)) = (goal.landmark(), self.first()) else { return };
        let subject = goal.subject();
        let place = first.position(subject);
        let distance = |landmark: &LandmarkId| LANDMARKS[*landmark].distance(place);
        let nearest = LandmarkId::ALL.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(nearest) = nearest.filter(|&nearest| nearest != landmark) else { return };
        let others = LandmarkId::ALL.into_iter().filter(|&it| it != nearest);
        let values = others.map(|it| it.to_string()).collect();
        let reached = GoalOutcome::of(&self.facts.track, goal);
        let mut proof = labels.clone();
        proof["outcome"] = json!(reached);
        let what = if matches!(subject, Entity::Agent(_)) { "agent" } else { "object" };
        self.ask(
            Query::Goal { agent, subject },
            values,
            landmark.to_string(),
            format!("{what} first at landmark {nearest}"),
            proof,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::distinct_kinds;
    use phase_model::EventKind;
    use std::collections::BTreeSet;

    /// No two kinds that fit alike are offered together, and each of two alike is offered with every other
    /// kind.
    #[test]
    fn kinds_that_look_alike_are_not_offered_together() {
        for kind in EventKind::ALL {
            let offers = (0..64).map(|k| distinct_kinds(kind, &format!("event-{k:04}")));
            let mut offered = BTreeSet::new();
            for kinds in offers {
                assert!(kinds.len() == 4 && kinds.contains(&kind.name().to_owned()), "{kinds:?}");
                let both = |alike: [&str; 2]| alike.iter().all(|it| kinds.contains(&(*it).to_owned()));
                assert!(
                    !both(["helping", "collaborating"]) && !both(["hindering", "competing"]),
                    "{kinds:?}"
                );
                offered.extend(kinds);
            }
            let absent = match kind {
                EventKind::Chasing | EventKind::Independent => 0,
                _ => 1,
            };
            assert_eq!(offered.len(), EventKind::ALL.len() - absent, "{kind:?}: {offered:?}");
        }
    }
}
