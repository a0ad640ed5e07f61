//! Resampling of bodies when there is hardly any place left, or none.

use crate::common::{BALL, Lost, OTHER, clear_of_walls, physics, random, state};
use core::f32::consts::PI;
use phase_belief::Belief;
use phase_model::{Action, AgentId, PhysicsConfig, Size, State, Vec2, geometry::Outline};
use phase_perception::{Cell, CellSet, Observation, footprint, observe};

/// Agent 0 in a corner, facing the wall; the others far away.
fn truth() -> State {
    state([(7.5, 3.5, PI), (20.0, 8.0, 0.0), (20.0, 15.0, 0.0), (0.0, 0.0, 0.0)])
}

/// The observation of agent 0 if it saw all cells but those in a square with this lower left corner.
fn all_but(physics: &PhysicsConfig, corner: (f32, f32), side: usize) -> Observation {
    let mut observation = observe(physics, &truth(), AgentId::ZERO);
    let hidden = |cell: Cell| {
        let offset = cell.centre() - Vec2::from(corner);
        offset.min_element() > 0.0 && offset.max_element() < side as f32
    };
    observation.visible = Cell::all().filter(|&cell| !hidden(cell)).collect();
    assert_eq!(observation.visible.len(), 400 - side * side);
    observation
}

#[test]
fn a_tight_hiding_place_is_found() {
    // The side of the square of cells, and the size of the object that just fits in.
    let cases = [(2, Size::Small), (3, Size::Large), (3, Size::Medium), (4, Size::Huge)];
    for (side, size) in cases {
        let physics = physics(Vec::new(), size, 1);
        let mut truth = truth();
        truth.contacts.insert(phase_model::Entity::Agent(AgentId::ZERO), OTHER);
        let mut observation = observe(&physics, &truth, AgentId::ZERO);
        observation.visible = all_but(&physics, (12.0, 17.0), side).visible;
        let belief = Belief::new(&physics, &observation, 200, &mut random(3));
        assert_eq!(belief.unresolved(), 0, "{size:?}");
        for particle in belief.particles() {
            let cells = footprint(&physics, BALL, particle.body(BALL));
            assert!(!cells.intersects(&observation.visible), "{size:?}");
        }
    }
}

#[test]
fn a_tight_hiding_place_is_found_among_many_that_are_too_tight() {
    // A hundred single cells into which nothing fits, and one square of four into which the object does.
    let physics = physics(Vec::new(), Size::Small, 1);
    let mut truth = truth();
    truth.contacts.insert(phase_model::Entity::Agent(AgentId::ZERO), OTHER);
    let mut observation = observe(&physics, &truth, AgentId::ZERO);
    let square = |x: usize, y: usize| (10..12).contains(&x) && (14..16).contains(&y);
    let hidden = |cell: Cell| {
        let x = cell.index() % 20;
        let y = cell.index() / 20;
        (x % 2 == 1 && y % 2 == 1) || square(x, y)
    };
    observation.visible = Cell::all().filter(|&cell| !hidden(cell)).collect();
    let belief = Belief::new(&physics, &observation, 50, &mut random(8));
    assert_eq!(belief.unresolved(), 0);
    for particle in belief.particles() {
        let cells = footprint(&physics, BALL, particle.body(BALL));
        assert!(cells.iter().all(|cell| square(cell.index() % 20, cell.index() / 20)));
    }
}

#[test]
fn two_that_hide_together_do_not_overlap() {
    let physics = physics(Vec::new(), Size::Small, 1);
    let observation = all_but(&physics, (12.0, 17.0), 5);
    let belief = Belief::new(&physics, &observation, 500, &mut random(4));
    assert_eq!(belief.unresolved(), 0);
    for particle in belief.particles() {
        let [agent, ball] = [OTHER, BALL].map(|entity| Outline::of(&physics, entity, particle.body(entity)));
        assert!(!agent.overlaps(&ball));
    }
}

#[test]
fn where_no_place_is_left_bodies_lie_in_view_and_are_counted() {
    let physics = physics(Vec::new(), Size::Small, 1);
    let mut chance = random(5);
    let cases: [(&str, CellSet); 2] = [
        ("all in view", Cell::all().collect()),
        ("all but a nook", all_but(&physics, (12.0, 17.0), 1).visible),
    ];
    for (name, visible) in cases {
        let mut observation = observe(&physics, &truth(), AgentId::ZERO);
        observation.visible = visible;
        let mut belief = Belief::new(&physics, &observation, 10, &mut chance);
        for _ in 0..3 {
            assert_eq!(belief.unresolved(), 20, "{name}");
            assert_eq!(belief.resampled(), 20, "{name}");
            for particle in belief.particles() {
                let outlines: Vec<_> = physics
                    .entities()
                    .map(|entity| Outline::of(&physics, entity, particle.body(entity)))
                    .collect();
                for (k, outline) in outlines.iter().enumerate() {
                    assert!(clear_of_walls(&physics, outline), "{name}");
                    assert!(!outlines[..k].iter().any(|other| outline.overlaps(other)), "{name}");
                }
            }
            belief.update(&Lost(&[BALL]), &physics, Action::Stop, &observation, &mut chance);
        }
        // As soon as there is room, they are resampled into it.
        let roomy = all_but(&physics, (12.0, 17.0), 5);
        belief.update(&Lost(&[]), &physics, Action::Stop, &roomy, &mut chance);
        assert_eq!(belief.unresolved(), 0, "{name}");
    }
}

#[test]
fn bodies_too_large_for_the_arena_do_not_panic() {
    let mut physics = physics(Vec::new(), Size::Small, 2);
    physics.object_radii = [15.0, f32::NAN];
    let belief = Belief::new(&physics, &observe(&physics, &truth(), AgentId::ZERO), 3, &mut random(6));
    assert!(belief.unresolved() >= 3);
    assert!(belief.particles().iter().all(|particle| particle.is_finite(&physics)));
}

#[test]
fn a_belief_of_no_particles_is_empty() {
    let physics = physics(Vec::new(), Size::Small, 1);
    let observation = observe(&physics, &truth(), AgentId::ZERO);
    let mut belief = Belief::new(&physics, &observation, 0, &mut random(1));
    belief.update(&Lost(&[BALL]), &physics, Action::Up, &observation, &mut random(1));
    assert!(belief.particles().is_empty());
}
