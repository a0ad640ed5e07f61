//! Input features of the strength regressor.

use phase_model::{AgentId, Body, Entity, MAX_ENTITIES, Size, Vec2, arena::STEP_SECONDS};

/// Number of [`features`].
pub const FEATURES: usize = 7;

/// Mean, maximum and minimum speed (u/s) of an agent, the same of its acceleration (u/s²), and its radius
/// (u), from the rows of a time window.
///
/// Acceleration is the change of velocity from row to row. Features for which there are too few rows are 0:
/// one row gives no accelerations, none gives no speeds. The paper does not use the radius; but it is
/// observable, and the same push moves a big body less.
#[must_use]
pub fn features(rows: &[[Body; MAX_ENTITIES]], agent: AgentId, size: Size) -> [f64; FEATURES] {
    let velocities = || rows.iter().map(|row| wide(row[Entity::Agent(agent)].velocity));
    let speeds = summary(velocities().map(length));
    let changes = velocities().zip(velocities().skip(1));
    let accelerations =
        summary(changes.map(|(from, to)| length([to[0] - from[0], to[1] - from[1]]) / STEP_SECONDS));
    let [mean_speed, greatest_speed, least_speed] = speeds;
    let [mean_acceleration, greatest_acceleration, least_acceleration] = accelerations;
    let radius = f64::from(size.radius());
    [
        mean_speed,
        greatest_speed,
        least_speed,
        mean_acceleration,
        greatest_acceleration,
        least_acceleration,
        radius,
    ]
}

fn wide(vector: Vec2) -> [f64; 2] {
    [f64::from(vector.x), f64::from(vector.y)]
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// Mean, maximum and minimum of values that are not negative; zeros if there are none.
fn summary(values: impl Iterator<Item = f64>) -> [f64; 3] {
    let mut sum = 0.0;
    let mut greatest = 0.0_f64;
    let mut argmin = f64::INFINITY;
    let mut count = 0_usize;
    for number in values {
        sum += number;
        greatest = greatest.max(number);
        argmin = argmin.min(number);
        count += 1;
    }
    if count == 0 { [0.0; 3] } else { [sum / count as f64, greatest, argmin] }
}
