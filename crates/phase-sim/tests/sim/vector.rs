//! The vector of an observation has what its table says, and loses nothing.

use phase_model::{
    Action, AgentId, Body, Entity, Goal, Grip, LandmarkId, ObjectId, Scene, Side, Vec2, arena,
    random::{Purpose, stream},
};
use phase_perception::{Cell, CellSet, Observation, observe};
use phase_sim::{
    Engine, Episode, View,
    vector::{self, InvalidVector, PARTS, SIZE, VectorWriter},
};
use rand::RngExt;

const KINDS: [&str; 6] = ["helping", "hindering", "chasing", "competing", "collaborating", "independent"];

fn scene(kind: &str, seed: u64) -> Scene {
    phase_sampler::sample_named(Some(kind), None, seed).expect("the kind has a scene")
}

/// Both agents' vectors after some random steps, with contacts among them.
fn played(view: View, mut check: impl FnMut(&Scene, &Episode, AgentId, &[f32])) {
    let mut random = stream(1, Purpose::Scene, 0);
    for (seed, kind) in KINDS.into_iter().enumerate() {
        let scene = scene(kind, seed as u64);
        let mut episode = Episode::new(&scene, Engine::Forward);
        for _ in 0..30 {
            let actions = [(); 2].map(|()| Action::ALL[random.random_range(0..Action::ALL.len())]);
            episode.step(actions);
            for agent in AgentId::ALL {
                let mut numbers = vec![f32::NAN; SIZE];
                episode.write_observation(agent, view, &mut numbers);
                check(&scene, &episode, agent, &numbers);
            }
        }
    }
}

/// The numbers of a part, found by the lengths of those before it.
fn part<'a>(numbers: &'a [f32], name: &str) -> &'a [f32] {
    let mut start = 0;
    for part in PARTS {
        let length: usize = part.shape.iter().product();
        if part.name == name {
            return &numbers[start..start + length];
        }
        start += length;
    }
    panic!("no part {name}");
}

#[test]
fn parts_fill_the_vector() {
    let lengths = [44, 14, 6, 400, 4, 2, 8, 1, 12, 12, 2, 8, 1];
    assert_eq!(PARTS.map(|part| part.len()), lengths);
    assert_eq!(SIZE, lengths.iter().sum::<usize>());
    assert!(PARTS.iter().all(|part| !part.is_empty()));
}

#[test]
fn reading_gives_the_observation_back() {
    let mut unseen = false;
    for view in [View::Own, View::Everything] {
        played(view, |_, episode, agent, numbers| {
            let observation = episode.observe(agent, view);
            unseen |= observation.body(Entity::Agent(agent.other())).is_none();
            assert_eq!(vector::read(agent, numbers).unwrap(), observation);
        });
    }
    assert!(unseen, "some observation lacks something");
}

#[test]
fn entities_are_in_the_agents_order_and_hidden_if_unseen() {
    played(View::Own, |scene, episode, agent, numbers| {
        let physics = scene.physics();
        let seen = observe(&physics, episode.state(), agent);
        let order = [
            Entity::Agent(agent),
            Entity::Agent(agent.other()),
            Entity::Object(ObjectId::ALL[0]),
            Entity::Object(ObjectId::ALL[1]),
        ];
        for (row, entity) in part(numbers, "entities").chunks(11).zip(order) {
            let there = physics.entities().any(|present| present == entity);
            assert_eq!(row[0], f32::from(u8::from(there)));
            assert_eq!(row[1], f32::from(u8::from(there && seen.observed.contains(entity))));
            assert_eq!(row[2], f32::from(u8::from(seen.touched.contains(entity))));
            let Body { position, angle, velocity, angular_velocity } = *episode.state().body(entity);
            let expected = if row[1] == 0.0 {
                [0.0; 8]
            } else {
                let Vec2 { x, y } = position;
                [x, y, angle.cos(), angle.sin(), angle, velocity.x, velocity.y, angular_velocity]
            };
            for (found, expected) in row[3..].iter().zip(expected) {
                assert!((found - expected).abs() < 1e-6, "{entity:?}: {row:?}");
            }
        }
        let radii: Vec<f32> = order.into_iter().map(|entity| physics.radius(entity)).collect();
        assert_eq!(part(numbers, "radii"), radii);
    });
}

#[test]
fn contacts_and_sight_are_the_states() {
    let mut touching = 0;
    played(View::Everything, |_, episode, agent, numbers| {
        let state = episode.state();
        let [first, second] = ObjectId::ALL;
        let order = [
            Entity::Agent(agent),
            Entity::Agent(agent.other()),
            Entity::Object(first),
            Entity::Object(second),
        ];
        let mut contacts = part(numbers, "contacts").iter();
        for a in 0..4 {
            for b in a + 1..4 {
                let there = state.contacts.touching(order[a], order[b]);
                assert_eq!(*contacts.next().unwrap(), f32::from(u8::from(there)));
                touching += u32::from(there);
            }
        }
        assert!(part(numbers, "visible").iter().all(|&cell| cell == 1.0));
    });
    assert!(touching > 0, "some bodies touch");
    played(View::Own, |scene, episode, agent, numbers| {
        let seen = observe(&scene.physics(), episode.state(), agent);
        for row in 0..20 {
            for column in 0..20 {
                let centre = arena::MIN + Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
                let expected = seen.sees_cell(Cell::at(centre).unwrap());
                assert_eq!(part(numbers, "visible")[20 * row + column], f32::from(u8::from(expected)));
            }
        }
    });
}

#[test]
fn grips_name_object_and_side() {
    let scene = scene("helping", 1);
    let physics = scene.physics();
    let all = physics.entities().collect();
    let writer = VectorWriter::new(&scene);
    let object = physics.entities().find_map(|entity| match entity {
        Entity::Object(object) => Some(object),
        Entity::Agent(_) => None,
    });
    let object = object.expect("a scene of helping has an object");
    for agent in AgentId::ALL {
        for (row, holder) in [agent, agent.other()].into_iter().enumerate() {
            for (column, side) in [(2, Side::Head), (3, Side::Tail), (4, Side::Right), (5, Side::Left)] {
                let mut state = scene.initial_state();
                state.grips[holder] = Some(Grip { object, side, relative_angle: 0.7 });
                let observation = Observation::of(&physics, &state, agent, CellSet::EMPTY, all);
                let mut numbers = vec![0.0; SIZE];
                writer.write(&observation, &mut numbers);
                let mut expected = [[0.0; 7]; 2];
                expected[row][usize::from(object)] = 1.0;
                expected[row][column] = 1.0;
                expected[row][6] = 0.7;
                assert_eq!(part(&numbers, "grips"), expected.as_flattened());
                assert_eq!(vector::read(agent, &numbers).unwrap(), observation);
            }
        }
    }
}

#[test]
fn the_scene_is_what_both_agents_know() {
    played(View::Own, |scene, episode, agent, numbers| {
        let physics = scene.physics();
        let other = agent.other();
        let forces = [agent, other].map(|agent| physics.agents[agent].max_force / 100.0);
        assert_eq!(part(numbers, "forces"), forces);
        assert_eq!(part(numbers, "attitude"), [f32::from(scene.agents[agent].attitude.alpha())]);
        assert_eq!(part(numbers, "agent"), [f32::from(agent.number())]);
        let landmarks: Vec<f32> =
            LandmarkId::ALL.into_iter().flat_map(|one| arena::LANDMARKS[one].to_array()).collect();
        assert_eq!(part(numbers, "landmarks"), landmarks);
        for door in part(numbers, "doors").chunks(2) {
            assert!((0.0..=10.0).contains(&door[0]) && door[0] <= door[1] && door[1] <= 10.0, "{door:?}");
        }
        for (name, whose) in [("own_goal", agent), ("other_goal", other)] {
            let goal = scene.goals()[whose];
            let found = part(numbers, name);
            let mut expected = [0.0; 12];
            let (kind, subject) = match goal {
                Goal::AgentOnLandmark { agent: subject, .. } => (0, usize::from(subject != agent)),
                Goal::ObjectOnLandmark { object, .. } => (1, 2 + usize::from(object)),
                Goal::Touch { agent: subject, .. } => (2, usize::from(subject != agent)),
            };
            expected[kind] = 1.0;
            expected[3 + subject] = 1.0;
            if let Some(landmark) = goal.landmark() {
                expected[7 + usize::from(landmark)] = 1.0;
            }
            expected[11] = f32::from(i8::from(goal.sign()));
            assert_eq!(found, expected);
        }
        // What is said of goals is true where everything is seen, and never said of what is unseen.
        let mut everything = vec![0.0; SIZE];
        episode.write_observation(agent, View::Everything, &mut everything);
        let truth = episode.achieved().map(|holds| f32::from(u8::from(holds)));
        assert_eq!(part(&everything, "holds"), [agent, other].map(|agent| truth[usize::from(agent)]));
        for (seen, all) in part(numbers, "holds").iter().zip(part(&everything, "holds")) {
            assert!(seen <= all);
        }
    });
}

#[test]
fn rubbish_is_refused() {
    let scene = scene("helping", 1);
    let writer = VectorWriter::new(&scene);
    let mut numbers = vec![0.0; SIZE];
    writer.write(&observe(&scene.physics(), &scene.initial_state(), AgentId::ZERO), &mut numbers);
    assert!(vector::read(AgentId::ZERO, &numbers).is_ok());
    let refused = |change: &dyn Fn(&mut Vec<f32>)| {
        let mut changed = numbers.clone();
        change(&mut changed);
        vector::read(AgentId::ZERO, &changed).unwrap_err()
    };
    assert_eq!(refused(&|numbers| numbers.truncate(3)), InvalidVector::Length { found: 3 });
    assert_eq!(
        refused(&|numbers| numbers[7] = f32::INFINITY),
        InvalidVector::NotFinite { index: 7, number: f32::INFINITY }
    );
    assert!(matches!(
        refused(&|numbers| numbers[500] = f32::NAN),
        InvalidVector::NotFinite { index: 500, .. }
    ));
    assert_eq!(refused(&|numbers| numbers[1] = 0.0), InvalidVector::SelfUnobserved);
    let other = vector::read(AgentId::ONE, &numbers).unwrap_err();
    assert_eq!(other.to_string(), "the observation is of agent 0, not of agent 1");
}
