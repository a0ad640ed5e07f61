//! The subgoal pursued among those of the particles.

use crate::cases::{Tally, agent, aim, cases, goal, list, name, real, scene, state, text, whole};
use phase_model::{
    Attitude,
    random::{Purpose, stream},
};
use phase_published::{Mind, PublishedParameters};

#[test]
fn selections_are_the_originals() {
    let Some(cases) = cases("oracle-selection.json") else { return };
    let [mut aims, mut costs, mut selected] = [(); 3].map(|()| Tally::default());
    for case in &cases {
        let who = agent(whole(&case["agent"]));
        let mut attitudes = [Attitude::Neutral; 2];
        attitudes[who.index()] = match text(&case["mode"]) {
            "neutral" => Attitude::Neutral,
            "friendly" => Attitude::Help,
            _ => Attitude::Hinder,
        };
        let scene = scene(&case["scene"], [goal(&case["goal"]); 2], attitudes);
        let parameters = PublishedParameters { simulations: 1, ..PublishedParameters::default() };
        let mut mind = Mind::new(&scene, who, parameters).expect("a mind");
        let mut particles = Vec::new();
        for it in list(&case["particles"]) {
            let particle = state(&it["bodies"], &it["grips"]);
            let (ours, theirs) = (mind.aim(&particle), aim(&it["subgoal"]));
            aims.add(ours == theirs, || format!("{}: {ours:?}, theirs {theirs:?}", name(case)));
            let (ours, theirs) = (mind.cost(&particle), real(&it["cost"]));
            costs.add((ours - theirs).abs() < 1e-5, || {
                format!("{}: {ours}, theirs {theirs}, {}", name(case), it["subgoal"])
            });
            particles.push(particle);
        }
        let (_, thought) = mind.decide(&particles, &mut stream(1, Purpose::Search, 0)).expect("a decision");
        let (ours, theirs) = (thought.subgoal, aim(&case["selected"]).subgoal());
        selected.add(ours == theirs, || {
            format!("{}: {ours}, theirs {theirs}; {:?}", name(case), thought.subgoals)
        });
    }
    println!("subgoals: {aims}; costs: {costs}; selected: {selected}");
    for tally in [aims, costs, selected] {
        assert_eq!(tally.different, 0);
    }
}
