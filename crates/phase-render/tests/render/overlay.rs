//! What an agent sees is light, what it does not see is dim, what it believes is faint.

use crate::common::{RADII, at, physics, state};
use phase_model::{AgentId, Body, State, Vec2};
use phase_perception::{Cell, CellSet};
use phase_render::{Frame, Overlay, Palette, SceneRenderer, Style};

fn renderer() -> SceneRenderer {
    SceneRenderer::new(&physics(), Style::default()).expect("a valid style")
}

/// The cells right of x = 12 and above y = 14.
fn upper_right() -> CellSet {
    Cell::all().filter(|&cell| Cell::min(cell).x >= 12.0 && Cell::min(cell).y >= 14.0).collect()
}

fn draw(renderer: &SceneRenderer, visible: &CellSet, particles: &[State]) -> Frame {
    renderer.frame(
        &state(),
        Some(&Overlay { agent: AgentId::ZERO, visible, particles, title: "", captions: &[] }),
    )
}

fn lightness(colour: [u8; 3]) -> u32 {
    colour.into_iter().map(u32::from).sum()
}

#[test]
fn cells_out_of_sight_are_dimmed() {
    let renderer = renderer();
    let frame = draw(&renderer, &upper_right(), &[]);
    let seen = at(&renderer, &frame, 14.0, 16.0);
    let unseen = at(&renderer, &frame, 9.0, 9.0);
    assert!(lightness(seen) > lightness(unseen) + 120, "{seen:?} against {unseen:?}");
    let eps = 0.03;
    for (x, y, is_seen) in [
        (12.0 + eps, 14.0 + eps, true),
        (12.0 - eps, 14.0 + eps, false),
        (12.0 + eps, 14.0 - eps, false),
        (20.0, 15.0, true),
        (11.5, 20.0, false),
        (14.5, 9.5, false),
    ] {
        let expected = if is_seen { seen } else { unseen };
        assert_eq!(at(&renderer, &frame, x, y), expected, "({x}, {y})");
    }
    assert_eq!(at(&renderer, &frame, 16.0, 9.0), [0, 0, 0], "walls stay black");
    assert_eq!(at(&renderer, &frame, 5.5, 9.0), [255, 255, 255], "the margin stays white");
    assert_eq!(at(&renderer, &frame, 20.0, 6.0), Palette::default().objects[1], "bodies keep their colour");
}

#[test]
fn no_seams_between_cells_at_any_size() {
    for side in [100, 333, 480, 500] {
        let mut empty = physics();
        empty.object_count = 0;
        empty.walls.clear();
        let renderer = SceneRenderer::new(&empty, Style::with_side(side)).unwrap();
        let gone = State::new([Body::at_rest(Vec2::splat(-500.0), 0.0); 4]);
        let none = CellSet::EMPTY;
        let frame = renderer.frame(
            &gone,
            Some(&Overlay { agent: AgentId::ZERO, visible: &none, particles: &[], title: "", captions: &[] }),
        );
        let inside = |x: f32, y: f32| renderer.pixel(Vec2::new(x, y));
        let from = inside(11.5, 16.5);
        let to = inside(20.5, 7.5);
        let first = frame.pixel(from.x as u32, from.y as u32).unwrap();
        for y in from.y as u32..to.y as u32 {
            for x in from.x as u32..to.x as u32 {
                assert_eq!(frame.pixel(x, y).unwrap(), first, "at ({x}, {y}) of {side}");
            }
        }
    }
}

#[test]
fn beliefs_are_faint_and_add_up() {
    let renderer = renderer();
    let visible = Cell::all().collect();
    let elsewhere = Vec2::new(12.5, 16.5);
    let believe = |entity: usize, count: usize| {
        let mut particle = state();
        particle.bodies[entity] = Body::at_rest(elsewhere, 0.0);
        let frame = draw(&renderer, &visible, &vec![particle; count]);
        at(&renderer, &frame, elsewhere.x, elsewhere.y)
    };
    let floor = {
        let frame = draw(&renderer, &visible, &[]);
        at(&renderer, &frame, elsewhere.x, elsewhere.y)
    };
    assert_eq!(believe(0, 50), floor, "the agent knows where it is itself");
    let palette = Palette::default();
    for (entity, colour) in [(1, palette.agents[1]), (2, palette.objects[0]), (3, palette.objects[1])] {
        let distance = |a: [u8; 3]| -> u32 { (0..3).map(|k| u32::from(a[k].abs_diff(colour[k]))).sum() };
        let one = believe(entity, 1);
        let ten = believe(entity, 10);
        let many = believe(entity, 60);
        assert_ne!(one, floor, "one particle of entity {entity} shows");
        assert!(distance(one) < distance(floor), "towards its colour");
        assert!(distance(ten) < distance(one), "ten are clearer");
        assert!(distance(many) < 24, "many are nearly solid: {many:?} against {colour:?}");
    }
}

#[test]
fn the_true_state_is_on_top_of_beliefs() {
    let renderer = renderer();
    let visible = CellSet::EMPTY;
    let mut particle = state();
    particle.bodies[1] = Body::at_rest(Vec2::new(20.0, 6.0), 0.0);
    let frame = draw(&renderer, &visible, &[particle; 50]);
    assert_eq!(at(&renderer, &frame, 20.0, 6.0), Palette::default().objects[1]);
    assert_eq!(at(&renderer, &frame, 20.0, 6.0 + 0.9 * RADII[3]), Palette::default().objects[1]);
}

#[test]
fn an_agent_is_drawn_as_a_belief_of_the_other_only() {
    let renderer = renderer();
    let visible = CellSet::EMPTY;
    let mut particle = state();
    particle.bodies[0].position = Vec2::new(12.5, 16.5);
    let overlay = |agent| Overlay {
        agent,
        visible: &visible,
        particles: std::slice::from_ref(&particle),
        title: "",
        captions: &[],
    };
    let own = renderer.frame(&state(), Some(&overlay(AgentId::ZERO)));
    let other = renderer.frame(&state(), Some(&overlay(AgentId::ONE)));
    assert_ne!(own, other);
}
