//! Bodies after a release: how deep, and for how long, a released object and its former holder overlap.

mod scenes;

use phase_forward::Forward;
use phase_model::{AgentId, Dynamics, Entity, ObjectId, PhysicsConfig, State, geometry::Outline};
use proptest::{prelude::*, strategy::ValueTree, test_runner::TestRunner};
use scenes::{actions, separated_bodies};

const SCENES: usize = 1500;
const RUNS: usize = 16;
const DEEP: f32 = 0.1;

fn depth(physics: &PhysicsConfig, state: &State, a: Entity, b: Entity) -> f32 {
    let [a, b] = [a, b].map(|entity| Outline::of(physics, entity, state.body(entity)));
    a.depth(&b).unwrap_or(0.0)
}

#[test]
fn measure() {
    let mut runner = TestRunner::deterministic();
    let strategy = (separated_bodies(), actions(RUNS));
    let scenes: Vec<_> = (0..SCENES).map(|_| strategy.new_tree(&mut runner).expect("a scene").current()).collect();
    for kind in 0..4 {
        let (mut releases, mut long, mut deepest, mut deepest_long, mut longest) = (0, 0, 0f32, 0f32, 0);
        for ((physics, start), actions) in &scenes {
            let forward = Forward::new(physics);
            let mut world = phase_world::World::new(physics, start);
            let (mut state, mut cache) = (*start, forward.fresh_cache(start));
            let mut rows = [[None::<u32>; 2]; 2];
            for &actions in actions {
                let before = state;
                match kind {
                    0 => forward.step(&mut state, actions),
                    1 => forward.step_coarse(&mut state, actions),
                    2 => { forward.step_warm(&mut state, &mut cache, actions); }
                    _ => state = world.step(actions)[4],
                }
                for agent in AgentId::ALL { for object in ObjectId::ALL {
                    let row = &mut rows[agent.index()][object.index()];
                    if before.holds(agent, object) && !state.holds(agent, object) { releases += 1; *row = Some(0); }
                    let busy = AgentId::ALL.iter().any(|&a| state.holds(a, object)) || state.held_object(agent).is_some();
                    if state.holds(agent, object) { *row = None; }
                    if let Some(row) = row {
                        let d = depth(physics, &state, Entity::Agent(agent), Entity::Object(object));
                        if d <= DEEP || busy { *row = 0 } else {
                            *row += 1;
                            deepest = deepest.max(d);
                            longest = longest.max(*row);
                            if *row == 5 { long += 1; }
                            if *row >= 5 { deepest_long = deepest_long.max(d); }
                        }
                    }
                }}
            }
        }
        println!("{}: releases {releases}, deeper than {DEEP} for more than four steps {long}, longest {longest}, deepest then {deepest_long}, deepest {deepest}", ["exact", "coarse", "warm", "world"][kind]);
    }
    let _ = Just(1);
}
