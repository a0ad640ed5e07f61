//! What both agents see, observe and could grab.

use crate::cases::{Tally, agent, cases, cells, entity, list, name, object, physics, state, whole};
use phase_model::BodySet;
use phase_published::senses::{attachable, in_view, observe};
use serde_json::Value;

fn entities(numbers: &Value) -> BodySet {
    list(numbers).iter().map(|number| entity(whole(number))).collect()
}

#[test]
fn observations_are_the_originals() {
    let Some(cases) = cases("oracle-observe.json") else { return };
    let [mut visible, mut observed, mut viewed, mut grabbed] = [(); 4].map(|()| Tally::default());
    for case in &cases {
        let physics = physics(&case["scene"]);
        let state = state(&case["state"]["bodies"], &case["state"]["grips"]);
        for who in 0..2 {
            let theirs = &case["agents"][who];
            let who = agent(who);
            let found = observe(&physics, &state, who);
            let seen = cells(&theirs["visible"]);
            visible.add(found.visible == seen, || {
                let differing = |a: &phase_perception::CellSet, b: &phase_perception::CellSet| {
                    a.iter().filter(|&cell| !b.contains(cell)).map(|cell| cell.centre()).collect::<Vec<_>>()
                };
                let (more, less) = (differing(&found.visible, &seen), differing(&seen, &found.visible));
                format!("{}, {who}: more {more:?}, less {less:?}", name(case))
            });
            let known = entities(&theirs["observed"]);
            observed.add(found.observed == known, || {
                format!("{}, {who}: observes {:?}, theirs {known:?}", name(case), found.observed)
            });
            let view = entities(&theirs["in_view"]);
            let ours: BodySet = physics
                .entities()
                .filter(|&it| it != phase_model::Entity::Agent(who) && in_view(&physics, &state, who, it))
                .collect();
            viewed.add(ours == view, || {
                format!("{}, {who}: has {ours:?} in view, theirs {view:?}", name(case))
            });
            for (k, able) in list(&theirs["attachable"]).iter().enumerate() {
                let ours = attachable(&physics, &state, who, object(k));
                grabbed.add(Some(ours) == able.as_bool(), || {
                    format!("{}, {who}: object {k} within reach {ours}, theirs {able}", name(case))
                });
            }
        }
    }
    println!("visible cells: {visible}; observed: {observed}; in view: {viewed}; attachable: {grabbed}");
    for tally in [visible, observed, viewed, grabbed] {
        assert_eq!(tally.different, 0);
    }
}
