//! Routes, by which plans are costed, against fields, by which agents move.

use phase_model::{
    Layout, Size, Vec2, arena,
    random::{Purpose, stream},
};
use phase_navigation::{Field, IMPASSABLE_COST, Map, Mover, NavigationParameters, Target};
use rand::RngExt;

/// Number of random pairs of points.
const PAIRS: usize = 2000;

#[test]
fn routes_and_fields_agree_on_what_is_closed_and_nearly_always_on_the_distance() {
    let mut random = stream(5, Purpose::Scene, 0);
    let costs = NavigationParameters {
        impassable: IMPASSABLE_COST,
        obstruction: 0.0,
        ..NavigationParameters::DEFAULT
    };
    let mut differences = Vec::with_capacity(PAIRS);
    for _ in 0..PAIRS {
        let layout = Layout::new(random.random_range(0..22), None).unwrap();
        let half_width = Size::ALL[random.random_range(0..Size::ALL.len())].radius();
        let mut point = || {
            let mut along = || random.random_range(half_width..arena::SIDE - half_width);
            arena::MIN + Vec2::new(along(), along())
        };
        let from = point();
        let to = point();
        let map = Map::new(layout);
        let route = map.route_cost(from, to, 2.0 * half_width, map.gaps(), IMPASSABLE_COST);
        let mover = Mover { half_width };
        let field = Field::new(&map, Target::Point(to), mover, &[], costs).distance(from);
        assert_eq!(route >= IMPASSABLE_COST, field >= IMPASSABLE_COST, "{layout:?} {from} {to}");
        if field < IMPASSABLE_COST {
            differences.push((field - route).abs() / field.max(1.0));
        }
    }
    differences.sort_by(f32::total_cmp);
    let quantile = |share: f32| differences[((differences.len() - 1) as f32 * share) as usize];
    // Measured: 0.000 and 0.08.
    assert!(quantile(0.5) < 0.01 && quantile(0.95) < 0.12, "{} {}", quantile(0.5), quantile(0.95));
}
