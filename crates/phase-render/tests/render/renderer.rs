//! Frames show the world where it is, y up.

use crate::common::{RADII, at, physics, renderer, state};
use phase_model::{Body, Grip, ObjectId, PhysicsConfig, Side, State, Vec2};
use phase_render::{Frame, Palette, RenderError, SceneRenderer, Style};
use std::f32::consts::{FRAC_PI_2, PI};

const WHITE: [u8; 3] = [255, 255, 255];
const BLACK: [u8; 3] = [0, 0, 0];
/// Somewhere far away, to get a body out of the picture.
const GONE: Vec2 = Vec2::new(-500.0, -500.0);

/// A state with agent 0 alone.
fn alone(position: Vec2, angle: f32) -> State {
    let mut bodies = [Body::at_rest(GONE, 0.0); 4];
    bodies[0] = Body::at_rest(position, angle);
    State::new(bodies)
}

#[test]
fn what_stands_still_is_where_it_belongs() {
    let renderer = renderer();
    let frame = renderer.frame(&alone(GONE, 0.0), None);
    let landmarks = Palette::default().landmarks;
    for (x, y, colour, what) in [
        (8.5, 19.5, landmarks[0], "top left landmark"),
        (23.5, 19.5, landmarks[1], "top right landmark"),
        (23.5, 4.5, landmarks[2], "bottom right landmark"),
        (8.5, 4.5, landmarks[3], "bottom left landmark"),
        (6.1, 21.9, landmarks[0], "its outer corner"),
        (10.9, 17.1, landmarks[0], "its inner corner"),
        (11.1, 17.1, WHITE, "beside it"),
        (10.0, 12.0, WHITE, "open floor"),
        (16.0, 9.0, BLACK, "the wall downwards"),
        (16.0, 7.1, BLACK, "its end"),
        (16.0, 6.9, WHITE, "just past its end"),
        (16.0, 15.0, WHITE, "where a wall upwards would be"),
        (21.0, 12.0, BLACK, "the wall to the right"),
        (13.0, 12.0, WHITE, "where a wall to the left would be"),
        (15.93, 12.07, BLACK, "the corner where the walls meet"),
        (5.95, 10.0, BLACK, "left boundary"),
        (26.02, 10.0, BLACK, "right boundary"),
        (10.0, 22.05, BLACK, "upper boundary"),
        (10.0, 1.95, BLACK, "lower boundary"),
        (5.5, 10.0, WHITE, "margin"),
    ] {
        assert_eq!(at(&renderer, &frame, x, y), colour, "{what}");
    }
    let top_left = frame.pixel(60, 60).unwrap();
    assert!(top_left[2] > top_left[0] && top_left[2] > top_left[1], "{top_left:?} is not blue");
}

#[test]
fn bodies_have_their_colours() {
    let renderer = renderer();
    let frame = renderer.frame(&state(), None);
    let palette = Palette::default();
    for (x, y, colour, what) in [
        (10.0, 12.0, palette.agents[0], "agent 0"),
        (10.0 - 1.2, 12.0 - 1.0, palette.agents[0], "its rear left"),
        (10.0 + 1.2, 12.0 - 1.0, palette.agents[0], "its rear right"),
        (10.0 - 1.2, 12.0 + 1.0, WHITE, "left of its head"),
        (23.5, 19.4, palette.agents[1], "agent 1"),
        (13.0, 4.0, palette.objects[0], "object 0"),
        (20.0, 6.0, palette.objects[1], "object 1"),
        (20.0 + 1.4, 6.0, palette.objects[1], "object 1 to the right"),
        (20.0 + 1.56, 6.0, palette.outline, "object 1's outline"),
        (20.0 + 1.7, 6.0, palette.landmarks[2], "the landmark beside object 1"),
        (20.0 - 1.7, 6.0, WHITE, "the floor beside object 1"),
    ] {
        assert_eq!(at(&renderer, &frame, x, y), colour, "{what}");
    }
}

/// The white of an eye lies 0.35 R ahead of the origin and 0.5 R aside, the pupil 0.7 R ahead.
#[test]
fn eyes_show_the_heading() {
    let renderer = renderer();
    let centre = Vec2::new(12.0, 15.0);
    for angle in [0.0, FRAC_PI_2, PI, -FRAC_PI_2, 0.7, 7.0] {
        let frame = renderer.frame(&alone(centre, angle), None);
        let (sin, cos) = f32::sin_cos(angle);
        let ahead = Vec2::new(-sin, cos);
        let right = Vec2::new(cos, sin);
        let look = |forward: f32, sideways: f32| {
            let point = centre + (ahead * forward + right * sideways) * RADII[0];
            at(&renderer, &frame, point.x, point.y)
        };
        for side in [-0.5, 0.5] {
            assert_eq!(look(0.33, side), WHITE, "white at {angle}");
            assert_eq!(look(0.7, side), BLACK, "pupil at {angle}");
            assert_eq!(look(-0.33, side), Palette::default().agents[0], "no eye behind at {angle}");
            assert_eq!(look(-0.7, side), Palette::default().agents[0], "no pupil behind at {angle}");
        }
    }
}

/// Area and place of a silhouette against geometry: a trapezoid of 4R², a disc of πr².
#[test]
fn silhouettes_have_the_right_area() {
    let renderer = renderer();
    let empty = renderer.frame(&alone(GONE, 0.0), None);
    let scale = renderer.pixel(Vec2::new(7.0, 2.0)).x - renderer.pixel(Vec2::new(6.0, 2.0)).x;
    let cases = [
        (0, 0.0, 4.0 * RADII[0] * RADII[0]),
        (0, 0.6, 4.0 * RADII[0] * RADII[0]),
        (1, 2.0, 4.0 * RADII[1] * RADII[1]),
        (2, 0.0, PI * RADII[2] * RADII[2]),
        (3, 0.0, PI * RADII[3] * RADII[3]),
    ];
    for (entity, angle, area) in cases {
        let mut state = alone(GONE, 0.0);
        state.bodies[entity] = Body::at_rest(Vec2::new(12.0, 15.0), angle);
        let frame = renderer.frame(&state, None);
        let drawn = changed(&frame, &empty) as f32 / (scale * scale);
        // Antialiased edges count as changed: about half a pixel more all around, and the pupils stick out.
        assert!(drawn > area && drawn < 1.12 * area, "entity {entity}: {drawn} against {area} square units");
    }
}

#[test]
fn a_grip_is_marked_and_a_broken_grip_is_not() {
    let renderer = renderer();
    let palette = Palette::default();
    for (side, angle) in Side::ALL.into_iter().flat_map(|side| [(side, 0.0), (side, 1.3)]) {
        let mut state = alone(Vec2::new(12.0, 15.0), angle);
        let along = Vec2::from_angle(angle).rotate(side.direction());
        let point = state.bodies[0].position + along * RADII[0];
        state.bodies[2] = Body::at_rest(point + along * RADII[2], 0.0);
        let free = renderer.frame(&state, None);
        state.grips[0] = Some(Grip { object: ObjectId::ZERO, side, relative_angle: 0.0 });
        let held = renderer.frame(&state, None);
        assert_eq!(at(&renderer, &held, point.x, point.y), palette.outline, "{side:?}");
        // The mark is wider than the outlines that meet there anyway.
        let aside = point + along.perp() * 0.35 * RADII[0];
        assert_eq!(at(&renderer, &held, aside.x, aside.y), palette.outline, "{side:?} at {angle}");
        let marked = changed(&free, &held);
        assert!((100..900).contains(&marked), "{marked} pixels mark the grip");
        let single =
            SceneRenderer::new(&PhysicsConfig { object_count: 1, ..physics() }, Style::default()).unwrap();
        state.grips[0] = Some(Grip { object: ObjectId::ONE, side, relative_angle: 0.0 });
        let absent = single.frame(&state, None);
        state.grips[0] = None;
        assert_eq!(absent, single.frame(&state, None));
    }
}

#[test]
fn impossible_states_are_drawn_without_the_impossible() {
    let renderer = renderer();
    let expected = renderer.frame(&alone(GONE, 0.0), None);
    for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e30, -1e9] {
        for body in [
            Body::at_rest(Vec2::new(odd, 12.0), 0.0),
            Body::at_rest(Vec2::new(12.0, odd), 0.0),
            Body::at_rest(Vec2::splat(odd), odd),
        ] {
            let mut state = State::new([body; 4]);
            state.grips = [Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: odd }); 2];
            assert_eq!(renderer.frame(&state, None), expected, "{body:?}");
        }
    }
    let turned = renderer.frame(&alone(Vec2::new(12.0, 12.0), f32::NAN), None);
    assert_eq!(turned, expected, "a body without an angle");
}

#[test]
fn only_objects_present_are_drawn() {
    let mut physics = physics();
    let empty = renderer().frame(&alone(GONE, 0.0), None);
    let mut state = state();
    state.bodies[0].position = GONE;
    state.bodies[1].position = GONE;
    for (count, present) in [(0, false), (1, true), (2, true), (9, true)] {
        physics.object_count = count;
        let renderer = SceneRenderer::new(&physics, Style::default()).unwrap();
        assert_eq!(renderer.frame(&state, None) != empty, present, "{count} objects");
    }
}

#[test]
fn sizes_out_of_range_are_refused() {
    let style = |side, margin, caption_lines| Style { side, margin, caption_lines, ..Style::default() };
    for (style, field) in [
        (style(0, 0, 0), "side"),
        (style(63, 2, 0), "side"),
        (style(2001, 20, 0), "side"),
        (style(u32::MAX, 20, 0), "side"),
        (style(480, 121, 0), "margin"),
        (style(480, u32::MAX, 0), "margin"),
        (style(480, 20, 17), "caption_lines"),
        (style(480, 20, u32::MAX), "caption_lines"),
    ] {
        match SceneRenderer::new(&physics(), style) {
            Err(RenderError::Style { field: found, .. }) => assert_eq!(found, field),
            other => panic!("{style:?} gave {other:?}"),
        }
    }
    for (style, width, height) in [
        (Style::default(), 480, 480),
        (style(481, 20, 0), 481, 481),
        (Style { caption_lines: 2, ..Style::with_side(240) }, 240, 240 + 2 * 16),
        (style(480, 20, 3), 480, 480 + 3 * 18),
        (Style { title: true, legend: true, caption_lines: 1, ..Style::default() }, 480, 480 + 4 * 18 + 6),
    ] {
        let renderer = SceneRenderer::new(&physics(), style).unwrap();
        let frame = renderer.frame(&state(), None);
        assert_eq!((frame.width(), frame.height()), (width, height));
        assert_eq!((renderer.width(), renderer.height()), (width, height));
        assert_eq!(frame.rgba().len(), (width * height * 4) as usize);
    }
}

#[test]
fn a_png_holds_the_frame() {
    let frame = renderer().frame(&state(), None);
    let png = frame.png().unwrap();
    let read = tiny_skia::Pixmap::decode_png(&png).unwrap();
    assert_eq!((read.width(), read.height()), (frame.width(), frame.height()));
    assert_eq!(read.data(), frame.rgba());
    assert!(frame.rgba().chunks_exact(4).all(|pixel| pixel[3] == 255), "frames are opaque");
    for (x, y) in [(480, 0), (0, 480), (u32::MAX, 1), (1, u32::MAX)] {
        assert_eq!(frame.pixel(x, y), None, "({x}, {y})");
    }
}

/// Number of pixels that differ.
fn changed(a: &Frame, b: &Frame) -> usize {
    a.rgba().chunks_exact(4).zip(b.rgba().chunks_exact(4)).filter(|(a, b)| a != b).count()
}
