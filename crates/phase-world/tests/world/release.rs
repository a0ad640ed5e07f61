//! Bodies after a release: no pair stays inside one another.

use crate::physics;
use phase_model::{
    Action, AgentId, Body, Entity, Flip, Grip, Layout, ObjectId, PhysicsConfig, Side, Size, State, Strength, Vec2,
    arena, geometry::Outline,
};
use phase_world::World;
use proptest::{prelude::*, strategy::ValueTree, test_runner::TestRunner};

const SCENES: usize = 2000;
const DEEP: f32 = 0.1;

fn depth(physics: &PhysicsConfig, state: &State, a: Entity, b: Entity) -> f32 {
    match [a, b].map(|entity| Outline::of(physics, entity, state.body(entity))) {
        [Outline::Disc { centre: a, radius: r }, Outline::Disc { centre: b, radius: s }] => r + s - a.distance(b),
        [Outline::Disc { centre, radius }, Outline::Trapezoid(corners)]
        | [Outline::Trapezoid(corners), Outline::Disc { centre, radius }] => radius - distance(&corners, centre),
        [Outline::Trapezoid(a), Outline::Trapezoid(b)] => -separation(&a, &b).max(separation(&b, &a)),
    }
}

fn edges(corners: &[Vec2; 4]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    (0..4).map(|k| (corners[k], corners[(k + 1) % 4]))
}

/// Distance of a point from a convex outline; inside, minus the distance from the closest side (u).
fn distance(corners: &[Vec2; 4], point: Vec2) -> f32 {
    let beyond = |(a, b): (Vec2, Vec2)| (point - a).dot(-(b - a).normalize().perp());
    let deepest = edges(corners).map(beyond).fold(f32::MIN, f32::max);
    if deepest <= 0.0 {
        return deepest;
    }
    edges(corners)
        .map(|(a, b)| point.distance(a + (b - a) * ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0)))
        .fold(f32::MAX, f32::min)
}

fn separation(a: &[Vec2; 4], b: &[Vec2; 4]) -> f32 {
    edges(a)
        .map(|(p, q)| {
            let outward = -(q - p).normalize().perp();
            b.iter().map(|&corner| (corner - p).dot(outward)).fold(f32::MAX, f32::min)
        })
        .fold(f32::MIN, f32::max)
}

fn scene() -> impl Strategy<Value = (PhysicsConfig, State, Vec<[Action; 2]>, Vec<[Action; 2]>)> {
    let size = || prop::sample::select(Size::ALL.to_vec());
    let agent = || (size(), prop::sample::select(vec![Strength::Fair, Strength::Strong, Strength::Mighty]));
    let place = || (8.0..24.0f32, 4.0..20.0f32, -3.2..3.2f32);
    let layout = (0..22u8, prop::option::of(prop::sample::select(Flip::ALL.to_vec())))
        .prop_map(|(base, flip)| Layout::new(base, flip).expect("base up to 21"));
    let actions = || {
        let action = || prop::sample::select(Action::ALL.iter().copied().filter(|a| *a != Action::Attach).collect::<Vec<_>>());
        let stretch = (action(), action(), 1..6usize).prop_map(|(a, b, steps)| vec![[a, b]; steps]);
        prop::collection::vec(stretch, 1..5).prop_map(|stretches| stretches.concat())
    };
    let carry = || {
        let action = || prop::sample::select(Action::ALL.iter().copied().filter(|a| !matches!(a, Action::Attach | Action::Detach)).collect::<Vec<_>>());
        let stretch = (action(), action(), 1..8usize).prop_map(|(a, b, steps)| vec![[a, b]; steps]);
        prop::collection::vec(stretch, 0..4).prop_map(|stretches| stretches.concat())
    };
    let side = || prop::sample::select(Side::ALL.to_vec());
    (layout, [agent(), agent()], [size(), size()], prop::array::uniform4(place()), side(), side(), 0..3usize, carry(), actions(), prop::bool::ANY)
        .prop_map(|(layout, agents, objects, places, side, other, second, before, after, walls)| {
            let mut physics = physics(agents, objects);
            if walls { physics.walls = layout.walls(); }
            let mut bodies = places.map(|(x, y, angle)| Body::at_rest(Vec2::new(x, y), angle));
            let mut state = State::new(bodies);
            let at = |body: &Body, side: Side, length: f32| {
                body.position + Vec2::from_angle(body.angle).rotate(side.direction() * length)
            };
            let length = |agent: usize, object: usize| physics.agents[agent].radius + physics.object_radii[object];
            bodies[2].position = at(&bodies[0], side, length(0, 0));
            let mut grips = [None; 2];
            grips[0] = Some(Grip { object: ObjectId::ZERO, side, relative_angle: bodies[2].angle - bodies[0].angle });
            match second {
                0 => {
                    bodies[3].position = at(&bodies[1], other, length(1, 1));
                    grips[1] = Some(Grip { object: ObjectId::ONE, side: other, relative_angle: bodies[3].angle - bodies[1].angle });
                }
                1 => {
                    // both hold object 0: agent 1 on the far side of it
                    let angle = bodies[1].angle;
                    bodies[1].position = bodies[2].position - Vec2::from_angle(angle).rotate(other.direction() * length(1, 0));
                    grips[1] = Some(Grip { object: ObjectId::ZERO, side: other, relative_angle: bodies[2].angle - angle });
                }
                _ => {}
            }
            state.bodies = bodies;
            state.grips = grips;
            (physics, state, before, after)
        })
        .prop_filter("inside", |(physics, state, ..)| {
            physics.entities().all(|entity| {
                let outline = Outline::of(physics, entity, state.body(entity));
                outline.inside_arena() && !physics.walls.iter().any(|&wall| outline.overlaps_wall(wall))
            }) && physics.entities().all(|a| physics.entities().all(|b| a.index() <= b.index() || state.touching(a, b) || depth(physics, state, a, b) < 0.0
                    || matches!((a,b), (Entity::Object(o), Entity::Agent(g)) | (Entity::Agent(g), Entity::Object(o)) if state.holds(g, o))))
        })
}

#[test]
fn measure() {
    let mut runner = TestRunner::deterministic();
    let strategy = scene();
    let (mut pairs, mut long, mut longest, mut worst, mut deep5) = ([0; 2], [0; 2], [0; 2], [0f32; 2], [0f32; 2]);
    let mut shown = 0;
    for scene in 0..SCENES {
        let (physics, start, before, after) = strategy.new_tree(&mut runner).expect("a scene").current();
        let mut world = World::new(&physics, &start);
        for &actions in &before {
            world.step(actions);
        }
        // [agent][object]: steps in a row deeper than DEEP since the release
        let mut released = [[false; 2]; 2];
        let mut rows = [[0; 4]; 4];
        let mut maxes = [[0f32; 4]; 4];
        let all: Vec<_> = core::iter::once([Action::Detach, if scene % 2 == 0 { Action::Detach } else { after[0][1] }]).chain(after.iter().copied()).chain([[Action::NoForce; 2]; 6]).collect();
        for (k, &actions) in all.iter().enumerate() {
            let held = world.state();
            let state = world.step(actions)[4];
            for agent in AgentId::ALL {
                for object in ObjectId::ALL {
                    if held.holds(agent, object) && !state.holds(agent, object) {
                        released[agent.index()][object.index()] = true;
                        pairs[0] += 1;
                    }
                }
            }
            for i in 0..4 {
                for j in 0..i {
                    let (a, b) = (Entity::ALL[i], Entity::ALL[j]);
                    let gripped = |entity: Entity| match entity {
                        Entity::Agent(agent) => state.held_object(agent).is_some(),
                        Entity::Object(object) => AgentId::ALL.iter().any(|&agent| state.holds(agent, object)),
                    };
                    if gripped(a) || gripped(b) { rows[i][j] = 0; maxes[i][j] = 0.0; continue; }
                    let d = depth(&physics, &state, a, b);
                    let row = &mut rows[i][j];
                    *row = if d > DEEP { *row + 1 } else { 0 };
                    maxes[i][j] = if d > DEEP { maxes[i][j].max(d) } else { 0.0 };
                    let kind = usize::from(!(j < 2 && i >= 2 && released[j][i - 2]));
                    worst[kind] = worst[kind].max(d);
                    longest[kind] = longest[kind].max(*row);
                    if *row == 5 {
                        long[kind] += 1;
                        if shown < 25 { shown += 1; println!("scene {scene} step {k} pair {i}{j} kind {kind} depth {d} max {}", maxes[i][j]); }
                    }
                    if *row >= 5 { deep5[kind] = deep5[kind].max(d); }
                }
            }
        }
    }
    println!("released pairs {}: longer than 4 steps {:?}, longest {longest:?} steps, worst {worst:?}, deepest after 4 steps {deep5:?} ([released pair, other])", pairs[0], long);
    let _ = arena::SIDE;
}
