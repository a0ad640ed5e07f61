//! Distribution of particles over the arena. All generators are seeded, so these tests are deterministic.

use crate::common::{BALL, Lost, ME, OTHER, StaticDynamics, physics, random, state, wall};
use core::f32::consts::{FRAC_PI_2, PI};
use phase_belief::Belief;
use phase_model::{Action, AgentId, Body, Dynamics, Entity, PhysicsConfig, Size, State, Vec2};
use phase_perception::{Cell, Observation, observe};

/// A sequence of observations of agent 0: the state before, and one after each.
fn looks(
    physics: &PhysicsConfig,
    dynamics: &impl Dynamics,
    particles: usize,
    states: &[State],
) -> (Belief, Observation) {
    let mut chance = random(7);
    let mut observation = observe(physics, &states[0], AgentId::ZERO);
    let mut belief = Belief::new(physics, &observation, particles, &mut chance);
    for (k, state) in states.iter().enumerate().skip(1) {
        observation = observe(physics, state, AgentId::ZERO);
        if k + 1 == states.len() {
            belief.update(dynamics, physics, Action::TurnLeft, &observation, &mut chance);
        } else {
            belief.update(&StaticDynamics, physics, Action::TurnLeft, &observation, &mut chance);
        }
    }
    (belief, observation)
}

/// Cells whose neighbours up to a distance all satisfy a condition; cells at the boundary are excluded.
fn amid(distance: i32, condition: impl Fn(Cell) -> bool) -> Vec<Cell> {
    let satisfied = |point: Vec2| Cell::at(point).is_some_and(&condition);
    let around = |cell: Cell| {
        (-distance..=distance)
            .flat_map(move |x| (-distance..=distance).map(move |y| Vec2::new(x as f32, y as f32)))
            .map(move |offset| cell.centre() + offset)
    };
    Cell::all().filter(|&cell| around(cell).all(satisfied)).collect()
}

/// Particles that have an entity in each of some cells.
fn counts(belief: &Belief, entity: Entity, cells: &[Cell]) -> Vec<f64> {
    let mut counts = [0.0; 400];
    for particle in belief.particles() {
        if let Some(cell) = Cell::at(particle.position(entity)) {
            counts[cell.index()] += 1.0;
        }
    }
    cells.iter().map(|cell| counts[cell.index()]).collect()
}

/// χ² of counts that should all be equal, in standard deviations above its expectation.
fn excess(counts: &[f64]) -> f64 {
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    let chi_squared: f64 = counts.iter().map(|count| (count - mean) * (count - mean) / mean).sum();
    let freedom = counts.len() as f64 - 1.0;
    (chi_squared - freedom) / (2.0 * freedom).sqrt()
}

#[test]
fn the_first_belief_is_uniform() {
    // Agent 0 in a corner, facing the wall; the other agent leans on it.
    let physics = physics(Vec::new(), Size::Small, 1);
    let mut truth = state([(7.5, 3.5, PI), (10.0, 3.5, 0.0), (20.0, 15.0, 0.0), (0.0, 0.0, 0.0)]);
    truth.contacts.insert(ME, OTHER);
    let (belief, observation) = looks(&physics, &StaticDynamics, 40_000, &[truth]);
    assert!(observation.body(OTHER).is_some() && observation.body(BALL).is_none());
    let bodies = [ME, OTHER].map(|agent| truth.position(agent));
    let cells = amid(1, |cell| {
        !observation.sees_cell(cell) && bodies.iter().all(|body| body.distance(cell.centre()) > 2.5)
    });
    assert!(cells.len() > 250, "{}", cells.len());
    let counts = counts(&belief, BALL, &cells);
    assert!(counts.iter().sum::<f64>() / 40_000.0 > 0.8);
    assert!(excess(&counts).abs() < 4.0, "{}", excess(&counts));
    // And within cells.
    for part in [|place: Vec2| place.x, |place: Vec2| place.y] {
        let mut tenths = [0.0; 10];
        for particle in belief.particles() {
            let place = particle.position(BALL);
            if Cell::at(place).is_some_and(|cell| cells.contains(&cell)) {
                tenths[((part(place).fract() * 10.0) as usize).min(9)] += 1.0;
            }
        }
        assert!(excess(&tenths).abs() < 4.0, "{tenths:?}");
    }
    // The test has power: with a tenth of the cells counted twice, the statistic is far off.
    let skewed: Vec<f64> =
        counts.iter().enumerate().map(|(k, count)| if k % 10 == 0 { count * 2.0 } else { *count }).collect();
    assert!(excess(&skewed) > 40.0);
}

#[test]
fn headings_of_unseen_agents_are_uniform() {
    let physics = physics(Vec::new(), Size::Small, 0);
    let truth = state([(7.5, 3.5, PI), (20.0, 15.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]);
    let (belief, _) = looks(&physics, &StaticDynamics, 20_000, &[truth]);
    // In the middle of the arena, where walls favour no heading.
    let mut counts = [0.0; 16];
    for particle in belief.particles() {
        let Body { position, angle, .. } = *particle.body(OTHER);
        if position.distance(Vec2::new(16.0, 12.0)) < 7.0 {
            counts[(((angle + PI) / (2.0 * PI) * 16.0) as usize).min(15)] += 1.0;
        }
    }
    assert!(counts.iter().sum::<f64>() > 5_000.0);
    assert!(excess(&counts).abs() < 4.0, "{counts:?}");
}

/// Two rooms of equal size and no door; agent 0 stands in the left one at a place and heading, and nothing
/// else is near.
fn in_left_room(x: f32, y: f32, angle: f32) -> State {
    state([(x, y, angle), (24.0, 4.0, 0.0), (24.0, 20.0, 0.0), (0.0, 0.0, 0.0)])
}

fn two_rooms() -> PhysicsConfig {
    physics(vec![wall((16.0, 22.0), (16.0, 2.0))], Size::Small, 1)
}

fn share_on_the_left(belief: &Belief, entity: Entity) -> f64 {
    let left = belief.particles().iter().filter(|particle| particle.position(entity).x < 16.0).count();
    left as f64 / belief.particles().len() as f64
}

#[test]
fn after_a_look_at_half_the_arena_all_is_in_the_other_half() {
    // At first facing the wall, then from two corners, and from the middle to both sides.
    let looking = [
        in_left_room(7.0, 12.0, FRAC_PI_2),
        in_left_room(7.2, 3.2, -0.6),
        in_left_room(14.5, 20.5, PI - 0.6),
        in_left_room(14.5, 3.5, 0.6),
        in_left_room(7.5, 20.5, PI + 0.6),
        in_left_room(8.0, 12.0, -FRAC_PI_2),
    ];
    let physics = two_rooms();
    let (first, _) = looks(&physics, &StaticDynamics, 4_000, &looking[..1]);
    let (last, _) = looks(&physics, &StaticDynamics, 4_000, &looking);
    let unseen = last.never_seen().filter(|cell| cell.centre().x < 16.0).count();
    assert!(unseen <= 2, "{unseen}");
    for entity in [OTHER, BALL] {
        let before = share_on_the_left(&first, entity);
        assert!((before - 0.47).abs() < 0.06, "{entity:?}: {before}");
    }
    // Six steps of decay leave a small probability that a body moved back unseen, larger for an agent.
    let agent = share_on_the_left(&last, OTHER);
    let object = share_on_the_left(&last, BALL);
    assert!(agent < 0.05 && object < 0.005, "{agent} {object}");
}

#[test]
fn a_place_last_seen_five_steps_ago_counts_as_stated() {
    // One observation of the left room, then five steps facing the wall; then all bodies are lost from sight
    // and from the belief at once.
    let physics = two_rooms();
    let mut states = vec![in_left_room(7.0, 12.0, -FRAC_PI_2)];
    states.extend([in_left_room(7.0, 12.0, FRAC_PI_2); 5]);
    let (belief, _) = looks(&physics, &Lost(&[OTHER, BALL]), 300_000, &states);
    for (entity, reach, expected) in [(OTHER, 2, 0.221_2), (BALL, 1, 0.024_69)] {
        let mean = |age: Option<u32>| {
            let cells = amid(reach, |cell| belief.memory().age(cell) == age);
            assert!(cells.len() > 15, "{}", cells.len());
            // Clear of the wall between the rooms, too.
            let cells: Vec<Cell> =
                cells.into_iter().filter(|cell| (cell.centre().x - 16.0).abs() > 2.0).collect();
            counts(&belief, entity, &cells).iter().sum::<f64>() / cells.len() as f64
        };
        let ratio = mean(Some(5)) / mean(None);
        assert!((ratio / expected - 1.0).abs() < 0.1, "{entity:?}: {ratio} instead of {expected}");
    }
}

#[test]
fn bodies_do_not_slip_into_gaps_between_what_was_just_seen() {
    // Three observations leave three wedges of 10.6° unseen, everywhere narrower than an object. If only the
    // cell of a body's centre counted, some would be placed there.
    let physics = two_rooms();
    let states = [0.0, 1.0, 2.0].map(|thirds| in_left_room(12.0, 12.0, thirds * 2.0 * PI / 3.0));
    let (belief, _) = looks(&physics, &Lost(&[BALL]), 20_000, &states);
    let gaps = belief.never_seen().filter(|cell| cell.centre().x < 16.0).count();
    assert!(gaps >= 8, "there is no gap to slip into: {gaps}");
    let slipped = share_on_the_left(&belief, BALL);
    assert!(slipped < 0.015, "{slipped}");
}
