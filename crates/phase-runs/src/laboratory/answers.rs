//! The answers of an observer, and the beliefs that it ascribes to agents, as columns of a table.

use phase_eval::goals::canonical;
use phase_model::{
    AgentId, Attitude, Entity, Goal, Judgement, MAX_OBJECTS, RelationProbabilities, Sign, State, words::Names,
};
use phase_simple::{PreparedEvent, physical_goals};

/// A goal with an agent that may have it.
fn goals() -> impl Iterator<Item = (AgentId, Goal)> {
    AgentId::ALL.into_iter().flat_map(|agent| {
        let signed = |goal: Goal| [goal, goal.negated()];
        let own = physical_goals(agent, MAX_OBJECTS).into_iter().filter(|goal| goal.sign() == Sign::Positive);
        // A helper has the other's goal, a hinderer its negation.
        let others = physical_goals(agent.other(), 0).into_iter();
        let others = others.filter(|goal| matches!(goal, Goal::AgentOnLandmark { .. }));
        own.chain(others).flat_map(signed).map(move |goal| (agent, goal))
    })
}

/// Columns of the answers.
pub(super) fn answer_columns() -> Vec<(String, String, String)> {
    let names = Names::PAPER;
    let p = "probability";
    let mut columns: Vec<(String, String, String)> = Vec::new();
    let mut add = |name: String, about: String| columns.push((name, p.into(), about));
    for relation in ["friendly", "adversarial", "neutral"] {
        add(format!("relation_{relation}"), format!("that the agents' relation is {relation}"));
    }
    for relation in ["friendly", "adversarial", "neutral"] {
        add(
            format!("reported_{relation}"),
            format!("share of people who would report that it is {relation}"),
        );
    }
    for agent in AgentId::ALL {
        let [who, whom] = [agent, agent.other()].map(|agent| names.agents[agent]);
        for verb in ["helps", "hinders"] {
            add(format!("{who}_{verb}"), format!("that {who} {verb} {whom}"));
        }
    }
    for (agent, goal) in goals() {
        let who = names.agents[agent];
        let wants = names.wants(goal, agent);
        add(format!("{who}_wants_{}", slug(&wants)), format!("that {who} wants {wants}"));
    }
    for (agent, entity) in others() {
        let (who, what) = (names.agents[agent], names.entity(entity));
        let name = |verb: &str| format!("{who}_{verb}_{}", slug(&what));
        columns.push((name("sees"), String::new(), format!("whether {who} sees {what}: 1 or 0")));
        let about = format!("mean distance of the places where {who} believes {what} to be from its place");
        columns.push((name("misplaces"), "u".into(), about));
    }
    columns
}

/// Every agent with everything else that a scene may have.
fn others() -> impl Iterator<Item = (AgentId, Entity)> {
    let of = |agent| Entity::ALL.into_iter().map(move |entity| (agent, entity));
    AgentId::ALL.into_iter().flat_map(of).filter(|(agent, entity)| *entity != Entity::Agent(*agent))
}

/// The values of the columns of beliefs at the last step of an event; none without a prepared event, or of an
/// entity that it does not have.
pub(super) fn beliefs(prepared: Option<&PreparedEvent>) -> Vec<Option<f64>> {
    let of = |(agent, entity): (AgentId, Entity)| {
        let known = prepared.filter(|prepared| prepared.observed().entities().any(|it| it == entity));
        let found = known.map(|prepared| {
            let step = prepared.observed().steps();
            // Rows of recordings are means over a step.
            let (belief, state) = (prepared.belief(agent, step), &prepared.motion().states[step]);
            let place = state.bodies[entity].position;
            let apart = |particle: &State| f64::from(particle.bodies[entity].position.distance(place));
            let particles = belief.particles();
            let misplaced = particles.iter().map(apart).sum::<f64>() / particles.len().max(1) as f64;
            [f64::from(u8::from(belief.observe(state).observed.contains(entity))), misplaced]
        });
        found.map_or([None; 2], |found| found.map(Some))
    };
    others().flat_map(of).collect()
}

fn slug(text: &str) -> String {
    text.replace("the ", "").replace(' ', "_")
}

/// The values of the columns of answers.
pub(super) fn answers(judgement: &Judgement, objects: usize) -> Vec<Option<f64>> {
    let relation = |p: &RelationProbabilities| [p.friendly, p.adversarial, p.neutral].map(Some);
    let mut values: Vec<Option<f64>> = relation(&judgement.relation).to_vec();
    values.extend(judgement.reported.as_ref().map_or([None; 3], relation));
    for agent in AgentId::ALL {
        for attitude in [Attitude::Help, Attitude::Hinder] {
            values.push(judgement.roles.as_ref().map(|roles| roles.of(agent, attitude)));
        }
    }
    for (agent, goal) in goals() {
        let absent = matches!(goal, Goal::ObjectOnLandmark { object, .. } if object.index() >= objects);
        let wanted = canonical(goal);
        let found = judgement.goals[agent].iter().filter(|(known, _)| canonical(*known) == wanted);
        // A sum of nothing is −0.
        values.push((!absent).then(|| found.map(|(_, p)| p).sum::<f64>() + 0.0));
    }
    values
}
