//! Whole searches with the original's random numbers.

use crate::cases::{Tally, action, agent, aim, cases, goal, list, name, real, scene, state, whole};
use phase_model::{
    Action, AgentId, Attitude, State,
    random::{Purpose, stream},
};
use phase_published::{Mind, PublishedParameters, RandomNumbers};
use serde_json::Value;

/// The particles of an agent's belief; and whether those that it searched with are in the order in which the
/// original drew from them, since of equal ones only the number is told. `None` where they are left out.
fn particles(of: &Value) -> Option<(Vec<State>, bool)> {
    let particles = of["particles"].as_array()?;
    let repeated = |it: &Value| vec![state(&it["state"], &it["grips"]); whole(&it["n"])];
    let selected: Vec<usize> =
        particles.iter().filter(|it| it["subgoal"] == of["subgoal"]).map(|it| whole(&it["n"])).collect();
    let is_ordered = selected.len() == 1 || selected.iter().all(|&number| number == 1);
    Some((particles.iter().flat_map(repeated).collect(), is_ordered))
}

#[test]
fn searches_are_the_originals() {
    let Some(cases) = cases("oracle-decisions.json") else { return };
    let [mut subgoals, mut chosen, mut visits, mut values, mut unordered] =
        [(); 5].map(|()| Tally::default());
    let mut skipped = 0;
    for case in &cases {
        let attitude = |k: usize| match real(&case["alpha"][k]) {
            _ if k == 1 => Attitude::Neutral,
            alpha if alpha > 0.0 => Attitude::Help,
            alpha if alpha < 0.0 => Attitude::Hinder,
            _ => Attitude::Neutral,
        };
        let goals = [goal(&case["goals"][0]), goal(&case["goals"][1])];
        let scene = scene(&case["scene"], goals, [attitude(0), attitude(1)]);
        let parameters = PublishedParameters {
            older_actions: whole(&case["lma_actions"]) == 12,
            strongest_coasts: case["stop_works_for_strongest"] == false,
            random: RandomNumbers::Original,
            ..PublishedParameters::default()
        };
        let mut first: Option<Mind> = None;
        // The second agent's random numbers follow from the first one's search.
        let mut is_followed = true;
        let mut is_exact = true;
        for of in list(&case["agents"]) {
            let who: AgentId = agent(whole(&of["agent"]));
            let mut mind = Mind::new(&scene, who, parameters).expect("a mind");
            let Some((particles, is_ordered)) = particles(of).filter(|_| is_followed) else {
                skipped += list(&of["searches"]).len();
                is_followed = false;
                continue;
            };
            is_exact &= is_ordered;
            if let Some(first) = &first {
                mind.begin_at(first.stream_position());
            }
            let searches = list(&of["searches"]);
            let (ours, thought) =
                mind.decide(&particles, &mut stream(1, Purpose::Search, 0)).expect("a decision");
            let wanted = aim(&of["subgoal"]).subgoal();
            subgoals.add(thought.subgoal == wanted, || {
                format!("{}, {who}: {}, theirs {}", name(case), thought.subgoal, of["subgoal"])
            });
            for theirs in searches.iter().filter(|search| search["seed"] == "original") {
                let actions: Vec<Action> = list(&theirs["order"]).iter().map(action).collect();
                let of_ours =
                    |action: &Action| thought.actions.iter().find(|it| it.action == *action).copied();
                let found: Vec<u32> =
                    actions.iter().map(|it| of_ours(it).map_or(0, |it| it.visits)).collect();
                let known: Vec<u32> = list(&theirs["visits"]).iter().map(|it| whole(it) as u32).collect();
                let what = || {
                    format!(
                        "{}, {who} {} ({} particles): {ours:?} {found:?}, theirs {} {known:?} {:?}",
                        name(case),
                        of["subgoal"],
                        of["n_selected"],
                        theirs["action"],
                        actions
                    )
                };
                let is_same = ours == action(&theirs["action"]);
                if !is_exact {
                    unordered.add(is_same, String::new);
                    continue;
                }
                visits.add(found == known, what);
                chosen.add(is_same, what);
                let near = actions
                    .iter()
                    .zip(list(&theirs["values"]))
                    .all(|(it, value)| of_ours(it).is_some_and(|it| (it.value - real(value)).abs() < 2e-6));
                values.add(near, String::new);
            }
            first = Some(mind);
        }
    }
    println!(
        "subgoals: {subgoals}; actions: {chosen}; visits: {visits}; values: {values}; actions of searches whose \
         particles have lost their order, or those of the search before: {unordered}; {skipped} searches whose \
         particles, or those of the search before, are left out"
    );
    for tally in [subgoals, chosen, visits, values] {
        assert_eq!(tally.different, 0);
    }
}
