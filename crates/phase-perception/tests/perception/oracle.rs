//! Visibility computed by slower, independent methods and at higher precision.

use phase_model::{AgentId, Entity, PhysicsConfig, Segment, State};
use phase_perception::Cell;

/// Whether a cell's centre is seen, and the margin of the closest of the decisions (u or rad).
pub(crate) struct Sight {
    pub(crate) visible: bool,
    pub(crate) margin: f64,
}

/// Angles by the arc tangent, discs by walking along the ray, walls by where the ray meets their line.
pub(crate) fn look(physics: &PhysicsConfig, state: &State, agent: usize, cell: Cell) -> Sight {
    let body = &state.bodies[agent];
    let (viewpoint, heading) = centre_of_mass(physics, state, Entity::Agent(AgentId::ALL[agent]));
    let centre = cell.centre();
    let ray = (f64::from(centre.x) - viewpoint.0, f64::from(centre.y) - viewpoint.1);
    debug_assert!((heading - f64::from(body.angle)).abs() < 1e-9);

    let half_angle = (0.8_f64 / (17.0 / 30.0)).atan();
    let off_axis = wrapped((-ray.0).atan2(ray.1) - heading).abs();
    let mut visible = off_axis < half_angle;
    let mut margin = (off_axis - half_angle).abs();

    for wall in &physics.walls {
        let (meets, by) = meets(wall, viewpoint, ray);
        visible &= !meets;
        margin = margin.min(by);
    }
    for entity in physics.entities().filter(|&entity| entity != Entity::Agent(AgentId::ALL[agent])) {
        let (disc, _) = centre_of_mass(physics, state, entity);
        let radius = f64::from(physics.radius(entity));
        let offset = (disc.0 - viewpoint.0, disc.1 - viewpoint.1);
        let nearest = walk(ray, offset);
        // An eye inside a body, or right beside it, is a separate case.
        margin = margin.min(offset.0.hypot(offset.1) - radius);
        visible &= nearest >= radius;
        margin = margin.min((nearest - radius).abs());
    }
    Sight { visible, margin }
}

/// Distance between a point and the line segment from the origin to the end of a ray, by trying many steps
/// and then finer ones around the best.
fn walk(ray: (f64, f64), point: (f64, f64)) -> f64 {
    let distance = |t: f64| (ray.0 * t - point.0).hypot(ray.1 * t - point.1);
    let mut best = 0.0;
    let mut step = 0.1;
    for _ in 0..6 {
        let candidates = (-10..=10).map(|k| (best + f64::from(k) * step).clamp(0.0, 1.0));
        best = candidates.min_by(|&a, &b| distance(a).total_cmp(&distance(b))).expect("there are candidates");
        step *= 0.15;
    }
    distance(best)
}

/// Whether a ray meets an axis-aligned wall, and the distance from the opposite result.
fn meets(wall: &Segment, viewpoint: (f64, f64), ray: (f64, f64)) -> (bool, f64) {
    let upright = wall.a.x == wall.b.x;
    assert!(upright || wall.a.y == wall.b.y);
    let turned = |(x, y): (f64, f64)| if upright { (x, y) } else { (y, x) };
    let ends = [wall.a, wall.b].map(|end| turned((f64::from(end.x), f64::from(end.y))));
    let ((across, along), (ray_across, ray_along)) = (turned(viewpoint), turned(ray));
    let line = ends[0].0;
    let low = ends[0].1.min(ends[1].1);
    let high = ends[0].1.max(ends[1].1);
    let before = across - line;
    let after = across + ray_across - line;
    if (before > 0.0) == (after > 0.0) {
        return (false, before.abs().min(after.abs()));
    }
    let at = along + ray_along * (line - across) / ray_across;
    let by = (at - low).abs().min((at - high).abs());
    ((low..=high).contains(&at), by.min(before.abs()).min(after.abs()))
}

fn centre_of_mass(physics: &PhysicsConfig, state: &State, entity: Entity) -> ((f64, f64), f64) {
    let body = state.body(entity);
    let heading = f64::from(body.angle);
    let behind = match entity {
        Entity::Agent(_) => f64::from(physics.radius(entity)) / 6.0,
        Entity::Object(_) => 0.0,
    };
    let x = f64::from(body.position.x);
    let y = f64::from(body.position.y);
    ((x + heading.sin() * behind, y - heading.cos() * behind), heading)
}

fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (angle + PI).rem_euclid(TAU) - PI
}

/// The minimum margin of all cells: how far a state is from a different observation.
pub(crate) fn least_margin(physics: &PhysicsConfig, state: &State, agent: usize) -> f64 {
    Cell::all().map(|cell| look(physics, state, agent, cell).margin).fold(f64::INFINITY, f64::min)
}
