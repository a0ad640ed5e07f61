//! Steering compared with hand calculations.

use phase_agent::steering::{
    IMPASSABLE_DOOR_COST, PlannedPath, Steering, avoid_discs, into_room, to_point, yield_to,
};
use phase_model::{Layout, Vec2, arena};
use phase_planner::Routes;

/// A narrow door (x 6 to 8.5) between rooms 0 and 3, a full wall between 0 and 1, the rest open.
fn narrow() -> Routes {
    Routes::new(Layout::new(4, None).expect("layout 4"))
}

/// Half a wall between rooms 0 and 3 (door x 6 to 11).
fn half() -> Routes {
    Routes::new(Layout::new(2, None).expect("layout 2"))
}

#[test]
fn in_the_open_one_goes_straight() {
    let (from, to) = (Vec2::new(18.0, 10.0), Vec2::new(24.0, 18.0));
    let steering = to_point(&PlannedPath::find(&narrow(), from, to, 2.4));
    assert!((steering.remaining - 10.0).abs() < 1e-3, "{steering:?}");
}

#[test]
fn a_wide_door_is_headed_for_directly() {
    let steering = to_point(&PlannedPath::find(&half(), Vec2::new(8.0, 16.0), Vec2::new(8.0, 6.0), 2.4));
    assert!(steering.waypoint.distance(Vec2::new(8.0, 12.0)) < 0.1, "{steering:?}");
    assert!((steering.remaining - 10.0).abs() < 0.1);
}

#[test]
fn before_a_tight_door_one_lines_up() {
    let steering = to_point(&PlannedPath::find(&narrow(), Vec2::new(13.0, 16.0), Vec2::new(8.0, 6.0), 2.4));
    assert!((steering.waypoint.x - 7.25).abs() < 0.1, "{steering:?}");
    assert!(steering.waypoint.y > 13.0, "not yet in the door: {steering:?}");
}

#[test]
fn who_does_not_fit_waits_beside_the_door() {
    for steering in [
        to_point(&PlannedPath::find(&narrow(), Vec2::new(9.0, 17.0), Vec2::new(8.0, 6.0), 3.6)),
        into_room(&PlannedPath::find(&narrow(), Vec2::new(9.0, 17.0), arena::LANDMARKS[3], 3.6)),
    ] {
        let place = steering.waypoint;
        assert!(place.y > 14.0 && place.x > 8.5, "{steering:?}");
        assert!(steering.remaining > IMPASSABLE_DOOR_COST, "{steering:?}");
    }
}

#[test]
fn one_gives_way_to_who_is_in_the_door() {
    let (from, to) = (Vec2::new(7.3, 15.0), Vec2::new(8.0, 6.0));
    let yields = |other| yield_to(&PlannedPath::find(&narrow(), from, to, 2.4), other, false).is_some();
    assert!(yields(Vec2::new(7.3, 11.8)));
    assert!(!yields(Vec2::new(14.0, 8.0)));
    // A wide opening has room for both.
    assert!(
        yield_to(
            &PlannedPath::find(&half(), Vec2::new(20.0, 15.0), Vec2::new(20.0, 8.0), 2.4),
            Vec2::new(20.0, 12.0),
            true
        )
        .is_none()
    );
}

#[test]
fn who_gives_way_leaves_the_door_free() {
    let path_of = |from, to| (from, to, Vec2::new(7.3, 11.8));
    for (from, to, other) in [
        path_of(Vec2::new(7.3, 15.0), Vec2::new(8.0, 6.0)),
        path_of(Vec2::new(10.0, 9.0), Vec2::new(8.0, 18.0)),
    ] {
        let routes = narrow();
        let steering =
            yield_to(&PlannedPath::find(&routes, from, to, 2.4), other, true).expect("the door is taken");
        let place = steering.waypoint;
        assert!(place.x >= 8.5 + 1.2 && (place.y - 12.0).signum() == (from.y - 12.0).signum(), "{place}");
    }
}

#[test]
fn of_two_that_are_as_near_to_a_door_the_polite_one_goes_back() {
    let (from, facing) = (Vec2::new(7.2, 13.4), Vec2::new(7.2, 10.6));
    let routes = narrow();
    let way = |from| PlannedPath::find(&routes, from, Vec2::new(7.2, 4.5), 2.4);
    assert!(yield_to(&way(from), facing, false).is_none());
    let steering = yield_to(&way(from), facing, true).expect("it waits");
    let nearer = from + (steering.waypoint - from).normalize() * 0.5;
    let later = yield_to(&way(nearer), facing, true).expect("it still waits");
    assert!(
        later.remaining < steering.remaining - 0.3,
        "every step towards the place gains: {steering:?} {later:?}"
    );
}

#[test]
fn one_walks_round_what_is_in_the_way() {
    let straight = Steering { waypoint: Vec2::new(20.0, 12.0), remaining: 8.0 };
    let from = Vec2::new(12.0, 12.0);
    let bent = avoid_discs(straight, from, [(Vec2::new(16.0, 12.3), 1.5)].into_iter());
    assert!(bent.waypoint.distance(Vec2::new(16.0, 10.8)) < 0.1, "past the nearer side: {bent:?}");
    assert!(bent.remaining > 8.0);
    for harmless in [Vec2::new(16.0, 15.0), Vec2::new(10.0, 12.0), Vec2::new(24.0, 12.0)] {
        assert_eq!(avoid_discs(straight, from, [(harmless, 1.5)].into_iter()), straight, "{harmless}");
    }
}
