//! Imagined steps, bit for bit.

use crate::cases::{Tally, action, cases, list, name, physics, real, state, text, whole};
use phase_forward::Imagined;
use phase_model::{Action, AgentId, Vec2};
use std::collections::BTreeMap;

#[test]
fn imagined_steps_are_the_originals() {
    let Some(cases) = cases("oracle-imagined.json") else { return };
    let [mut places, mut grips] = [(); 2].map(|()| Tally::default());
    let mut by_action: BTreeMap<String, Tally> = BTreeMap::new();
    let mut errors = Vec::new();
    for case in &cases {
        let physics = physics(&case["scene"]);
        let forward = Imagined::new(&physics);
        let before = state(&case["state"]["bodies"], &case["state"]["grips"]);
        for it in list(&case["steps"]) {
            let own = whole(&it[0]);
            let mut actions = [Action::NoForce; 2];
            actions[own] = action(&it[1]);
            if !it[2].is_null() {
                actions[1 - own] = action(&it[2]);
            }
            let mut after = before;
            let at = [0, 1].map(|k: usize| {
                let place = &case["root_items"][k];
                Vec2::new(real(&place[0]) as f32, real(&place[1]) as f32)
            });
            forward.step_reaching(AgentId::ALL[own], &mut after, actions, at);
            let theirs = state(&it[3]["bodies"], &it[3]["grips"]);
            let error = |k: usize| (after.bodies[k].position - theirs.bodies[k].position).length();
            let worst = (0..4).map(error).fold(0.0, f32::max);
            errors.push(worst);
            let what = || {
                let each: Vec<f32> = (0..4).map(error).collect();
                format!("{}, agent {own} {} {}: {each:?}, grips {}", name(case), it[1], it[2], it[3]["grips"])
            };
            places.add(worst == 0.0, what);
            by_action.entry(text(&it[1]).to_owned()).or_default().add(worst == 0.0, String::new);
            let held = |state: &phase_model::State| state.grips.map(|grip| grip.map(|grip| grip.object));
            grips.add(held(&after) == held(&theirs), what);
        }
    }
    errors.sort_by(f32::total_cmp);
    let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    println!(
        "positions: {places}; grips: {grips}; error at 50 %, 90 %, 99 %, 100 %: {:?}",
        [0.5, 0.9, 0.99, 1.0].map(at)
    );
    for (action, tally) in &by_action {
        println!("{action}: {tally}");
    }
    for tally in [places, grips] {
        assert_eq!(tally.different, 0);
    }
}
