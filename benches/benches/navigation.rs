//! One distance field for a moving body between walls and around two others, one for an assembly, and queries
//! of both.

use core::hint::black_box;
use criterion::Criterion;
use phase_model::{Grip, Layout, ObjectId, PhysicsConfig, Side, Vec2, physics::AgentBody};
use phase_navigation::{
    Assembly, AssemblyField, AssemblyParameters, Disc, Field, IMPASSABLE_COST, Map, Mover,
    NavigationParameters, Target,
};

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let map = Map::new(Layout::new(16, None).expect("layout 16 exists"));
    let costs = NavigationParameters { impassable: 10.0, obstruction: 4.0, ..NavigationParameters::DEFAULT };
    let mover = Mover { half_width: 1.2 };
    let target = Target::Point(Vec2::new(8.5, 19.5));
    let bodies = [(9.0, 9.0), (18.0, 7.0)].map(|(x, y)| Disc { centre: Vec2::new(x, y), radius: 1.0 });
    for (name, obstacles) in [("no obstacles", &bodies[..0]), ("two obstacles", &bodies[..])] {
        criterion.bench_function(&format!("navigation/field/{name}"), |bencher| {
            bencher.iter(|| Field::new(&map, black_box(target), mover, obstacles, costs));
        });
        let field = Field::new(&map, target, mover, obstacles, costs);
        for (place, from) in [("same room", Vec2::new(13.0, 14.0)), ("farthest room", Vec2::new(24.0, 20.0))]
        {
            criterion.bench_function(&format!("navigation/distance/{name}/{place}"), |bencher| {
                bencher.iter(|| field.distance(black_box(from)));
            });
            criterion.bench_function(&format!("navigation/direction/{name}/{place}"), |bencher| {
                bencher.iter(|| field.direction(black_box(from)));
            });
        }
    }
    // What a plan pays for the same distance, through doors alone (docs/explanation/minds.md).
    criterion.bench_function("navigation/route of a plan", |bencher| {
        let from = Vec2::new(24.0, 20.0);
        let to = Vec2::new(8.5, 19.5);
        bencher.iter(|| map.route_cost(black_box(from), to, 2.4, map.gaps(), IMPASSABLE_COST));
    });
    let assembly = both_hold();
    let costs = AssemblyParameters { collision: 20.0, ..AssemblyParameters::DEFAULT };
    criterion.bench_function("navigation/assembly field", |bencher| {
        bencher.iter(|| AssemblyField::new(&map, black_box(target), 1.414, &assembly, costs));
    });
    let field = AssemblyField::new(&map, target, 1.414, &assembly, costs);
    let from = Vec2::new(24.0, 10.0);
    criterion.bench_function("navigation/assembly field/distance", |bencher| {
        bencher.iter(|| field.distance(black_box(from), 1.0));
    });
    criterion.bench_function("navigation/assembly field/descent", |bencher| {
        bencher.iter(|| field.descent(black_box(from), 1.0));
    });
    criterion.final_summary();
}

/// An object between two agents.
fn both_hold() -> Assembly {
    let physics = PhysicsConfig {
        walls: Vec::new(),
        agents: [AgentBody { radius: 0.8, max_force: 300.0 }; 2],
        object_radii: [0.8, 0.0],
        object_count: 1,
    };
    let grip = |relative_angle| Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle };
    Assembly::of(&physics, &[Some(grip(0.0)), Some(grip(core::f32::consts::PI))], ObjectId::ZERO)
}
