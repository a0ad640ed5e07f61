//! One distance field for a moving body between walls and around two others, and one query of it.

use core::hint::black_box;
use criterion::Criterion;
use phase_model::{Layout, Vec2};
use phase_navigation::{Disc, Field, Map, Mover, NavigationCosts, Target};

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let map = Map::new(Layout::new(16, None).expect("layout 16 exists"));
    let costs = NavigationCosts { impassable: 10.0, obstruction: 4.0 };
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
    criterion.final_summary();
}
