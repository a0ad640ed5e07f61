//! What an agent sees is light, what it does not see is dim, what it believes is faint.

use crate::common::{RADII, at, physique, state};
use phase_model::{AgentId, Body, State, Vec2};
use phase_perception::{Cell, CellSet};
use phase_render::{Caption, Frame, Overlay, Palette, Stage, Style, font};

fn stage(caption_lines: u32) -> Stage {
    Stage::new(&physique(), Style { caption_lines, ..Style::default() }).expect("a valid style")
}

/// The cells right of x = 12 and above y = 14.
fn upper_right() -> CellSet {
    Cell::all().filter(|&cell| Cell::min(cell).x >= 12.0 && Cell::min(cell).y >= 14.0).collect()
}

fn draw(stage: &Stage, visible: &CellSet, particles: &[State], captions: &[Caption]) -> Frame {
    stage.frame(&state(), Some(&Overlay { agent: AgentId::ZERO, visible, particles, captions }))
}

fn lightness(colour: [u8; 3]) -> u32 {
    colour.into_iter().map(u32::from).sum()
}

#[test]
fn cells_out_of_sight_are_dimmed() {
    let stage = stage(0);
    let frame = draw(&stage, &upper_right(), &[], &[]);
    let seen = at(&stage, &frame, 14.0, 16.0);
    let unseen = at(&stage, &frame, 9.0, 9.0);
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
        assert_eq!(at(&stage, &frame, x, y), expected, "({x}, {y})");
    }
    assert_eq!(at(&stage, &frame, 16.0, 9.0), [0, 0, 0], "walls stay black");
    assert_eq!(at(&stage, &frame, 5.5, 9.0), [255, 255, 255], "the margin stays white");
    assert_eq!(at(&stage, &frame, 20.0, 6.0), Palette::default().objects[1], "bodies keep their colour");
}

#[test]
fn no_seams_between_cells_at_any_size() {
    for side in [100, 333, 480, 500] {
        let mut empty = physique();
        empty.object_count = 0;
        empty.walls.clear();
        let stage = Stage::new(&empty, Style::with_side(side)).unwrap();
        let gone = State::new([Body::at_rest(Vec2::splat(-500.0), 0.0); 4]);
        let none = CellSet::EMPTY;
        let frame = stage.frame(
            &gone,
            Some(&Overlay { agent: AgentId::ZERO, visible: &none, particles: &[], captions: &[] }),
        );
        let inside = |x: f32, y: f32| stage.pixel(Vec2::new(x, y));
        let (from, to) = (inside(11.5, 16.5), inside(20.5, 7.5));
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
    let stage = stage(0);
    let visible = Cell::all().collect();
    let elsewhere = Vec2::new(12.5, 16.5);
    let believe = |entity: usize, count: usize| {
        let mut particle = state();
        particle.bodies[entity] = Body::at_rest(elsewhere, 0.0);
        let frame = draw(&stage, &visible, &vec![particle; count], &[]);
        at(&stage, &frame, elsewhere.x, elsewhere.y)
    };
    let floor = {
        let frame = draw(&stage, &visible, &[], &[]);
        at(&stage, &frame, elsewhere.x, elsewhere.y)
    };
    assert_eq!(believe(0, 50), floor, "the agent knows where it is itself");
    let palette = Palette::default();
    for (entity, colour) in [(1, palette.agents[1]), (2, palette.objects[0]), (3, palette.objects[1])] {
        let distance = |a: [u8; 3]| -> u32 { (0..3).map(|k| u32::from(a[k].abs_diff(colour[k]))).sum() };
        let (one, ten, many) = (believe(entity, 1), believe(entity, 10), believe(entity, 60));
        assert_ne!(one, floor, "one particle of entity {entity} shows");
        assert!(distance(one) < distance(floor), "towards its colour");
        assert!(distance(ten) < distance(one), "ten are clearer");
        assert!(distance(many) < 24, "many are nearly solid: {many:?} against {colour:?}");
    }
}

#[test]
fn the_true_state_is_on_top_of_beliefs() {
    let stage = stage(0);
    let visible = CellSet::EMPTY;
    let mut particle = state();
    particle.bodies[1] = Body::at_rest(Vec2::new(20.0, 6.0), 0.0);
    let frame = draw(&stage, &visible, &[particle; 50], &[]);
    assert_eq!(at(&stage, &frame, 20.0, 6.0), Palette::default().objects[1]);
    assert_eq!(at(&stage, &frame, 20.0, 6.0 + 0.9 * RADII[3]), Palette::default().objects[1]);
}

#[test]
fn captions_are_written_dot_by_dot() {
    let stage = stage(2);
    let style = Style { caption_lines: 2, ..Style::default() };
    let captions =
        ["get object 1", "V = -0.25", "one line too many"].map(|text| Caption::from(text.to_owned()));
    let frame = draw(&stage, &CellSet::EMPTY, &[], &captions);
    let scale = style.text_scale();
    for (line, caption) in (0..).zip(&captions[..2]) {
        for (position, character) in (0..).zip(caption.text.chars()) {
            for (row, bits) in (0..).zip(font::glyph(character)) {
                for column in 0..5 {
                    let x = style.margin + (position * 6 + column) * scale;
                    let y = style.side + line * style.line_height() + row * scale;
                    let expected = if bits & (0b10000 >> column) != 0 { [0; 3] } else { [255; 3] };
                    assert_eq!(frame.pixel(x, y).unwrap(), expected, "{character:?} row {row}");
                }
            }
        }
    }
    let above = |frame: &Frame| frame.rgba()[..(480 * 480 * 4)].to_vec();
    assert_eq!(above(&frame), above(&draw(&stage, &CellSet::EMPTY, &[], &[])), "the arena is left alone");
}

#[test]
fn captions_that_do_not_fit_are_cut_off() {
    let stage = stage(1);
    let long = |text: &str| draw(&stage, &CellSet::EMPTY, &[], &[text.repeat(300).into()]);
    let frame = long("#");
    let last_column = (0..frame.height()).filter(|&y| frame.pixel(479, y) != Some([255; 3])).count();
    assert_eq!(last_column, 0, "the margin stays free");
    assert_ne!(frame, long(" "));
    assert_eq!(long("\u{3bb}"), long("?"), "what the font lacks is a question mark");
    let no_room = self::stage(0);
    let none = draw(&no_room, &CellSet::EMPTY, &[], &[]);
    assert_eq!(draw(&no_room, &CellSet::EMPTY, &[], &["unseen".to_owned().into()]), none);
}

#[test]
fn as_many_characters_are_written_as_there_are_columns() {
    for side in [64, 320, 359, 480, 721] {
        let style = Style { caption_lines: 1, ..Style::with_side(side) };
        let stage = Stage::new(&physique(), style).unwrap();
        let written = |count| draw(&stage, &CellSet::EMPTY, &[], &["#".repeat(count).into()]);
        let columns = style.caption_columns();
        assert_ne!(written(columns - 1), written(columns), "side {side}: the last column is written");
        assert_eq!(written(columns), written(columns + 1), "side {side}: nothing is written past it");
    }
}

#[test]
fn bars_are_as_long_as_their_share_of_the_arena() {
    let stage = stage(3);
    let bar = Palette::default().bar;
    // The arena is 440 pixels wide and begins at 20; a line is 24 pixels high.
    for (share, length) in [
        (0.0, 0),
        (0.25, 110),
        (0.5, 220),
        (1.0, 440),
        (7.0, 440),
        (-1.0, 0),
        (f32::NAN, 0),
        (f32::INFINITY, 440),
    ] {
        let lines = [Caption::default(), Caption { text: String::new(), bar: share }, Caption::default()];
        let frame = draw(&stage, &CellSet::EMPTY, &[], &lines);
        let coloured = |y: u32| (0..480).filter(|&x| frame.pixel(x, y) == Some(bar)).collect::<Vec<_>>();
        assert_eq!(coloured(480 + 24 + 3), (20..20 + length).collect::<Vec<_>>(), "share {share}");
        for y in [480 + 3, 480 + 23, 480 + 46, 480 + 48] {
            assert!(
                coloured(y).is_empty(),
                "share {share}: other lines and the gap below stay free, row {y}"
            );
        }
    }
    let lined = |bar| draw(&stage, &CellSet::EMPTY, &[], &[Caption { text: "#".into(), bar }]);
    let ink = |frame: &Frame| frame.rgba().chunks(4).filter(|pixel| pixel[..3] == [0; 3]).count();
    assert_eq!(ink(&lined(0.0)), ink(&lined(1.0)), "text stays on top");
}

#[test]
fn an_agent_is_drawn_as_a_belief_of_the_other_only() {
    let stage = stage(0);
    let visible = CellSet::EMPTY;
    let mut particle = state();
    particle.bodies[0].position = Vec2::new(12.5, 16.5);
    let overlay = |agent| Overlay {
        agent,
        visible: &visible,
        particles: std::slice::from_ref(&particle),
        captions: &[],
    };
    let (own, other) = (
        stage.frame(&state(), Some(&overlay(AgentId::ZERO))),
        stage.frame(&state(), Some(&overlay(AgentId::ONE))),
    );
    assert_ne!(own, other);
}
