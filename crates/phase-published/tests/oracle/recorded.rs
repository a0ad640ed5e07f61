//! The recordings in the world in which they were made.

use crate::cases::{action, cases, list, object, real, reference, scene, state, text, whole};
use phase_forward::OriginalWorld;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, Body, EventKind, Flip, Goal, LandmarkId, MAX_ENTITIES, Scene,
    Sign, State, Strength, Vec2, arena::SUBSTEPS,
};
use serde_json::{Value, json};

/// A recording in the world before reflection, with the actions that are known.
pub(crate) struct Recorded {
    pub(crate) id: String,
    pub(crate) kind: EventKind,
    pub(crate) scene: Scene,
    start: State,
    pub(crate) actions: Vec<[Action; AGENT_COUNT]>,
    /// Mean places of all bodies, by step, the start first.
    pub(crate) rows: Vec<[Vec2; MAX_ENTITIES]>,
}

/// All recordings, or `None` (with a message) where there are none.
pub(crate) fn recordings() -> Option<Vec<Recorded>> {
    let known = reference("reference/oracle-actions.json")?;
    let events = reference("real-phase/dev.json")?;
    let of = |event: &Value| recorded(event, &known["recordings"][text(&event["id"])]);
    Some(list(&events["events"]).iter().map(of).collect())
}

fn recorded(event: &Value, known: &Value) -> Recorded {
    let flip = known["flip"].as_u64().map(|flip| Flip::ALL[flip as usize]);
    let goal = |k: usize| {
        let it = &event["agents"][k]["goal"];
        let agent = |name: &str| AgentId::ALL[whole(&it[name])];
        let sign = if it["sign"] == -1 { Sign::Negative } else { Sign::Positive };
        let landmark = || LandmarkId::ALL[whole(&it["landmark"])];
        let goal = match text(&it["kind"]) {
            "agent_on_landmark" => {
                Goal::AgentOnLandmark { agent: agent("agent"), landmark: landmark(), sign }
            }
            "object_on_landmark" => {
                Goal::ObjectOnLandmark { object: object(whole(&it["object"])), landmark: landmark(), sign }
            }
            _ => Goal::Touch { agent: agent("agent"), other: agent("other"), sign },
        };
        flip.map_or(goal, |flip| goal.mirrored(flip))
    };
    let attitude = |k: usize| match real(&event["agents"][k]["alpha"]) {
        alpha if alpha > 0.0 => Attitude::Help,
        alpha if alpha < 0.0 => Attitude::Hinder,
        _ => Attitude::Neutral,
    };
    let of = |k: usize| if k < 2 { &event["agents"][k] } else { &event["objects"][k - 2] };
    let sizes = [0, 1, 2, 3].map(|k| &of(k)["size_level"]);
    let strengths = [0, 1].map(|k| &of(k)["strength_level"]);
    let like = json!({"base": known["base"], "sizes": sizes, "strengths": strengths});
    let start = |k: usize| {
        let angle = if k < 2 { real(&known["start_angles"][k]) as f32 } else { 0.0 };
        let at = |axis: usize| real(&known["start_points"][k][axis]) as f32;
        Body::at_rest(Vec2::new(at(0), at(1)), angle)
    };
    let tracks = [0, 1, 2, 3].map(|k| {
        let all = &event["trajectory"];
        list(if k < 2 { &all["agents"][k] } else { &all["objects"][k - 2] })
    });
    let row = |t: usize| {
        tracks.map(|track| {
            let place = Vec2::new(real(&track[t][0]) as f32, real(&track[t][1]) as f32);
            flip.map_or(place, |flip| flip.point(place))
        })
    };
    let name = text(&event["event"]);
    Recorded {
        id: text(&event["id"]).into(),
        kind: EventKind::ALL.into_iter().find(|kind| kind.name() == name).expect("a kind"),
        scene: scene(&like, [goal(0), goal(1)], [attitude(0), attitude(1)]),
        start: State::new([0, 1, 2, 3].map(start)),
        actions: list(&known["actions"]).iter().map(|it| [action(&it[0]), action(&it[1])]).collect(),
        rows: (0..tracks[0].len()).map(row).collect(),
    }
}

impl Recorded {
    /// The actions that bodies carry out when minds choose `actions`.
    pub(crate) fn carried_out(&self, actions: [Action; AGENT_COUNT]) -> [Action; AGENT_COUNT] {
        let strongest = Strength::Mighty.max_force();
        AgentId::ALL.map(|agent| match actions[agent.index()] {
            Action::TurnRight => Action::TurnLeft,
            Action::Stop if self.scene.physics().agents[agent].max_force >= strongest => Action::NoForce,
            action => action,
        })
    }

    /// The world before the first step.
    pub(crate) fn world(&self) -> OriginalWorld {
        let mut world = OriginalWorld::new(&self.scene.physics(), &self.start);
        world.settle();
        world
    }

    /// Greatest distance of a body's mean place in a step from the recorded one (u).
    pub(crate) fn error(&self, substeps: &[State; SUBSTEPS], step: usize) -> f32 {
        let place = mean_places(substeps);
        let row = &self.rows[step + 1];
        (0..MAX_ENTITIES).map(|k| place[k].distance(row[k])).fold(0.0, f32::max)
    }
}

/// Mean places of all bodies in a step.
fn mean_places(substeps: &[State; SUBSTEPS]) -> [Vec2; MAX_ENTITIES] {
    core::array::from_fn(|k| substeps.iter().map(|it| it.bodies[k].position).sum::<Vec2>() / SUBSTEPS as f32)
}

/// Steps to the states at which the original was asked, from the start of each recording.
#[test]
fn worlds_are_the_originals() {
    let (Some(recordings), Some(cases)) = (recordings(), cases("oracle-decisions.json")) else { return };
    let mut states = 0;
    for recording in &recordings {
        let mut world = recording.world();
        for t in 0..=recording.actions.len() {
            for case in cases.iter().filter(|it| it["source"] == recording.id.as_str() && it["t"] == t) {
                let known = state(&case["state"]["bodies"], &case["state"]["grips"]);
                assert_eq!(world.state().bodies, known.bodies, "{}, step {t}", recording.id);
                states += 1;
            }
            if let Some(&actions) = recording.actions.get(t) {
                world.step(recording.carried_out(actions));
            }
        }
    }
    println!("{states} of {} states equal", cases.len());
    assert_eq!(states, cases.len());
}

#[test]
fn recordings_are_repeated() {
    /// Rows have five decimals; contact carries a difference in the last bit on.
    const NEAR: f32 = 1e-4;
    const MOST: f32 = 0.003;
    let Some(recordings) = recordings() else { return };
    let mut errors = Vec::new();
    for recording in &recordings {
        let mut world = recording.world();
        for (t, &actions) in recording.actions.iter().enumerate() {
            let substeps = world.step(recording.carried_out(actions));
            errors.push(recording.error(&substeps, t));
        }
    }
    let near = errors.iter().filter(|&&error| error < NEAR).count();
    let most = errors.iter().copied().fold(0.0, f32::max);
    println!("{near} of {} steps within {NEAR} u, all within {most} u", errors.len());
    assert!(near * 5 > errors.len() * 4 && most < MOST);
}
