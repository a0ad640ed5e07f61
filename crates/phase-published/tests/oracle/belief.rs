//! Belief updates, particle by particle.

use crate::cases::{Tally, action, agent, cases, cells, entity, list, name, physics, state, whole};
use phase_belief::overwrite;
use phase_forward::Imagined;
use phase_model::{Action, Entity};
use phase_published::{Redraw, senses::observe};

/// Particles that may differ: one in which an agent grabs what the original has at an earlier place.
const KNOWN: usize = 1;

#[test]
fn belief_updates_are_the_originals() {
    let Some(cases) = cases("oracle-belief.json") else { return };
    let [mut imagined, mut grips, mut observed, mut visible, mut redrawn, mut overwritten] =
        [(); 6].map(|()| Tally::default());
    for case in &cases {
        let physics = physics(&case["scene"]);
        let forward = Imagined::new(&physics);
        let who = agent(whole(&case["agent"]));
        let truth = state(&case["truth"]["bodies"], &case["truth"]["grips"]);
        let observation = observe(&physics, &truth, who);
        visible.add(observation.visible == cells(&case["visible"]), || name(case));
        let known: Vec<Entity> = list(&case["observed"]).iter().map(|it| entity(whole(it))).collect();
        observed.add(observation.observed.iter().collect::<Vec<_>>() == known, || name(case));
        let seen = cells(&case["ever_seen"]);
        let mut actions = [Action::NoForce; 2];
        actions[who.index()] = action(&case["action"]);
        let redraw = Redraw {
            physics: &physics,
            flip: None,
            seen: &seen,
            observation: &observation,
            truth: Some(&truth),
        };
        for it in list(&case["particles"]) {
            let mut particle = state(&it["before"], &it["before_grips"]);
            let at = [2, 3].map(|body: usize| particle.bodies[body].position);
            forward.step_reaching(who, &mut particle, actions, at);
            let theirs = state(&it["imagined"], &it["imagined_grips"]);
            let error = |k: usize| (particle.bodies[k].position - theirs.bodies[k].position).length();
            let worst = (0..4).map(error).fold(0.0, f32::max);
            imagined.add(worst == 0.0, || format!("{}: {worst} {}", name(case), case["action"]));
            let held = |state: &phase_model::State| state.grips.map(|grip| grip.map(|grip| grip.object));
            grips.add(held(&particle) == held(&theirs), || name(case));
            particle = theirs;
            overwrite(&mut particle, &observation);
            for (number, judged) in it["unseen"].as_object().expect("bodies") {
                let entity = entity(number.parse().expect("a number"));
                let ours = redraw.contradicts(&particle, entity);
                let theirs = judged["redrawn"].as_bool().expect("yes or no");
                redrawn.add(ours == theirs, || {
                    format!("{}: {entity} redrawn {ours}, theirs {judged}", name(case))
                });
                let known = state(&it["overwritten"], &it["imagined_grips"]);
                let far = particle.position(entity).distance(known.position(entity));
                overwritten.add(far < 1e-5, || format!("{}: {entity} {far}", name(case)));
            }
        }
    }
    println!(
        "imagined: {imagined}; grips: {grips}; observed: {observed}; visible: {visible}; overwritten: {overwritten}; redrawn: {redrawn}"
    );
    for tally in [observed, visible, redrawn, overwritten] {
        assert_eq!(tally.different, 0);
    }
    assert!(imagined.different <= KNOWN && grips.different <= KNOWN);
}
