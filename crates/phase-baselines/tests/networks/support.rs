//! Synthetic events.

use phase_baselines::{nodes::Nodes, parameters::Parameter, recognition::LabelledEvent};
use phase_event::ObservedEvent;
use phase_model::{
    AGENT_COUNT, AgentId, Body, Goal, LandmarkId, Layout, MAX_ENTITIES, Relation, Sign, Size, Vec2,
    arena::{CENTRE, LANDMARKS},
    random::{Pcg64Mcg, Purpose, stream},
};

/// A generator for tests.
pub(crate) fn random(index: u64) -> Pcg64Mcg {
    stream(7, Purpose::Training, index)
}

/// An event with the given number of rows in which agent 0 goes to a landmark and agent 1 to another one,
/// past some objects. Entries past the last object are `rubbish`.
pub(crate) fn event(number: usize, rows: usize, objects: usize, rubbish: f32) -> ObservedEvent {
    let targets = [LANDMARKS[number % 4], LANDMARKS[(number / 2) % 4]];
    let row = |t: usize| {
        let share = t as f32 / rows as f32;
        let mut bodies = [Body::at_rest(Vec2::splat(rubbish), rubbish); MAX_ENTITIES];
        for (agent, target) in targets.into_iter().enumerate() {
            let start = CENTRE + Vec2::new(2.0 * agent as f32 - 1.0, 0.3 * number as f32);
            bodies[agent] = Body::at_rest(start.lerp(target, share), share);
            bodies[agent].velocity = (target - start) / rows as f32;
        }
        for object in 0..objects {
            bodies[AGENT_COUNT + object] = Body::at_rest(CENTRE - Vec2::new(3.0, object as f32), 0.0);
        }
        bodies
    };
    let layout = Layout::new((2 * number % 22) as u8, None).expect("a layout");
    let sizes = vec![Size::Small; objects];
    ObservedEvent::new(layout, [Size::Small, Size::Huge], sizes, (0..rows).map(row).collect())
        .expect("an event")
}

/// Eight events, short and different, with labels that follow from them.
pub(crate) fn labelled() -> Vec<LabelledEvent> {
    (0..8)
        .map(|number| {
            let goal = |agent: u8, landmark: usize| Goal::AgentOnLandmark {
                agent: AgentId::ALL[usize::from(agent)],
                landmark: LandmarkId::ALL[landmark],
                sign: Sign::Positive,
            };
            let goals = [goal(0, number % 4), goal(1, (number / 2) % 4)];
            let relation = [Relation::Friendly, Relation::Adversarial, Relation::Neutral][number % 3];
            LabelledEvent::new(&event(number, 6 + number % 3, number % 3, 0.0), goals, relation)
                .expect("labels")
        })
        .collect()
}

/// Nodes of events of 5, 12 and 9 rows with 1, 2 and 0 objects.
pub(crate) fn unlike() -> Vec<Nodes> {
    [(0, 5, 1), (1, 12, 2), (2, 9, 0)]
        .map(|(number, rows, objects)| Nodes::of(&event(number, rows, objects, 0.0)))
        .into()
}

/// The maximum difference between two lists of values.
pub(crate) fn difference(a: &[f32], b: &[f32]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Whether a loss has a non-zero gradient for every parameter; the names of those for which it is zero.
pub(crate) fn without_slope(parameters: &[Parameter], loss: &candle_core::Tensor) -> Vec<String> {
    let gradients = loss.backward().expect("slopes");
    let flat = |(_, variable): &&Parameter| {
        let Some(gradient) = gradients.get(variable) else { return true };
        gradient.abs().expect("numbers").max_all().expect("numbers").to_scalar::<f32>().expect("numbers")
            == 0.0
    };
    parameters.iter().filter(flat).map(|(name, _)| name.clone()).collect()
}
