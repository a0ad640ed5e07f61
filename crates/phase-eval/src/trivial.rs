//! Trivial baselines: the scores that are reached without perception.

use phase_event::{
    BeliefOrder, BeliefReader, Beliefs, Forecaster, MethodResult, ObservedEvent, Prediction,
    ProgressCallback, Recogniser, SEEN, certain, others,
};
use phase_model::{
    AGENT_COUNT, AgentId, Entity, Forecast, Goal, Judgement, LandmarkId, ObjectId, RelationProbabilities,
    Sign, State, Vec2,
    arena::{self, STEP_SECONDS},
    layout::room_of,
    random::{Purpose, stream},
};
use phase_perception::observed_sets;
use rand::RngExt;
use serde_json::Value;

/// All own goals of an agent are equally likely, and so are all relations.
#[derive(Clone, Copy, Debug)]
pub struct Chance;

impl Recogniser for Chance {
    /// Equally likely goals come in an order drawn from the seed, so that none is first more often.
    fn judge(&self, observed: &ObservedEvent, seed: u64, _: ProgressCallback<'_>) -> MethodResult<Judgement> {
        let mut random = stream(seed, Purpose::Evaluation, 0);
        let goals = AgentId::ALL.map(|agent| {
            let mut goals = own_goals(agent, observed.object_sizes().len());
            for k in (1..goals.len()).rev() {
                goals.swap(k, random.random_range(0..=k));
            }
            let p = 1.0 / goals.len() as f64;
            goals.into_iter().map(|goal| (goal, p)).collect()
        });
        Ok(Some((
            Judgement { goals, relation: RelationProbabilities::default(), roles: None, reported: None },
            Value::Null,
        )))
    }
}

/// The possible own goals of an agent: itself or an object on a landmark, to approach the other, to get away
/// from it. As in labels, touching names the one that approaches first.
#[must_use]
pub fn own_goals(agent: AgentId, objects: usize) -> Vec<Goal> {
    let me = agent;
    let other = agent.other();
    let landmarks = LandmarkId::ALL.into_iter();
    let sign = Sign::Positive;
    let places = landmarks.clone().map(|landmark| Goal::AgentOnLandmark { agent: me, landmark, sign });
    let things = ObjectId::ALL.into_iter().take(objects).flat_map(|object| {
        landmarks.clone().map(move |landmark| Goal::ObjectOnLandmark { object, landmark, sign })
    });
    let approach = Goal::Touch { agent: me, other, sign };
    let get_away = Goal::Touch { agent: other, other: me, sign: Sign::Negative };
    places.chain(things).chain([approach, get_away]).collect()
}

/// Everything stays where it is.
#[derive(Clone, Copy, Debug)]
pub struct Stationary;

impl Forecaster for Stationary {
    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        _: u64,
        _: ProgressCallback<'_>,
    ) -> MethodResult<Prediction> {
        Ok(Some((straight_on(observed, steps, 0.0).into(), Value::Null)))
    }
}

/// Everything keeps the velocity of the last row, and stops at the walls around the arena. Inner walls, sizes
/// and collisions play no part.
#[derive(Clone, Copy, Debug)]
pub struct ConstantVelocity;

impl Forecaster for ConstantVelocity {
    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        _: u64,
        _: ProgressCallback<'_>,
    ) -> MethodResult<Prediction> {
        Ok(Some((straight_on(observed, steps, 1.0).into(), Value::Null)))
    }
}

/// Every entity continued from the last row with a share of its velocity.
fn straight_on(observed: &ObservedEvent, steps: usize, share: f32) -> Forecast {
    let last = observed.rows().last().copied().unwrap_or_default();
    let step_seconds = STEP_SECONDS as f32;
    let path = |entity: Entity| -> Vec<Vec2> {
        let body = last[entity];
        let after = |step: usize| body.position + body.velocity * (share * step_seconds * step as f32);
        (1..=steps).map(|step| after(step).clamp(arena::MIN, arena::MAX)).collect()
    };
    observed.entities().map(path).collect()
}

/// A rule for beliefs: an agent sees what is before its eyes, and believes everything else to be in the room
/// where it was at some other time. The same rules say what it believes the other to believe, by the other's
/// eyes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BeliefRule {
    /// The state in which the agent could last see it, or that at the start if it never could.
    LastSeen,
    /// As `LastSeen`, where the question is about its own belief; where it is about the other's, the state in
    /// which the agent itself could last see it: the other believes what the agent does.
    OwnBelief,
    /// Now.
    TrueState,
    /// At the start.
    FirstState,
}

impl BeliefReader for BeliefRule {
    fn read_beliefs(
        &self,
        observed: &ObservedEvent,
        order: BeliefOrder,
        steps: &[usize],
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Vec<Beliefs>> {
        let rows = observed.rows();
        let states: Vec<State> = rows.iter().map(|&row| State::new(row)).collect();
        let seen = observed_sets(&observed.physics([0.0; AGENT_COUNT]), &states);
        let of = |step: usize, agent: AgentId, entity: Entity| {
            let sees = |t: usize, viewer: AgentId| seen[t][viewer].contains(entity);
            let viewer = order.viewer(agent);
            let last = |viewer: AgentId| (0..=step).rev().find(|&t| sees(t, viewer)).unwrap_or(0);
            let then = match self {
                _ if sees(step, viewer) => return certain(SEEN),
                Self::LastSeen => last(viewer),
                Self::OwnBelief => last(agent),
                Self::TrueState => step,
                Self::FirstState => 0,
            };
            certain(room_of(rows[then][entity].position).index())
        };
        let objects = observed.object_sizes().len();
        let beliefs = |&step: &usize| {
            AgentId::ALL.map(|agent| {
                others(order.viewer(agent), objects).map(|entity| of(step, agent, entity)).collect()
            })
        };
        Ok(Some((steps.iter().map(beliefs).collect(), Value::Null)))
    }
}
