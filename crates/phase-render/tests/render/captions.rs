//! Titles and captions stand where they belong and nowhere else.

use crate::common::{physics, state};
use phase_model::AgentId;
use phase_perception::CellSet;
use phase_render::{Annotation, Caption, Course, Frame, Overlay, Palette, SceneRenderer, Style};

fn renderer(caption_lines: u32) -> SceneRenderer {
    SceneRenderer::new(&physics(), Style { caption_lines, ..Style::default() }).expect("a valid style")
}

fn draw(renderer: &SceneRenderer, title: &str, captions: &[Caption]) -> Frame {
    let visible = CellSet::EMPTY;
    renderer.frame(
        &state(),
        Some(&Overlay { agent: AgentId::ZERO, visible: &visible, particles: &[], title, captions }),
    )
}

/// The rows in which two frames differ.
fn rows_that_differ(a: &Frame, b: &Frame) -> Vec<u32> {
    let row = |frame: &Frame, y: u32| (0..frame.width()).map(|x| frame.pixel(x, y)).collect::<Vec<_>>();
    (0..a.height()).filter(|&y| row(a, y) != row(b, y)).collect()
}

#[test]
fn each_caption_has_its_line() {
    let renderer = renderer(2);
    let empty = draw(&renderer, "", &[]);
    let lines = |texts: [&str; 3]| texts.map(|text| Caption::from(text.to_owned()));
    for (texts, rows) in [
        (["get object 1", "", ""], 480..498),
        (["", "V = −0.25", ""], 498..516),
        (["", "", "one line too many"], 0..0),
    ] {
        let differing = rows_that_differ(&empty, &draw(&renderer, "", &lines(texts)));
        assert_eq!(differing.is_empty(), rows.is_empty(), "{texts:?}");
        assert!(differing.iter().all(|row| rows.contains(row)), "{texts:?} is in rows {differing:?}");
    }
}

#[test]
fn captions_that_do_not_fit_end_in_an_ellipsis_within_the_margins() {
    let renderer = renderer(1);
    let line = |cells: Vec<String>, text: String| draw(&renderer, "", &[Caption { cells, text, bar: 0.0 }]);
    let empty = draw(&renderer, "", &[]);
    for frame in [line(vec![], "#".repeat(300)), line(vec!["8".repeat(300); 12], "#".repeat(300))] {
        assert_ne!(frame, empty);
        for x in (0..20).chain(460..480) {
            assert!((480..498).all(|y| frame.pixel(x, y) == Some([255; 3])), "column {x} is margin");
        }
    }
    // 440 pixels hold 39 of 10.89 pixels each, with an ellipsis of 13.
    let shown = |text: &str| line(vec![], text.to_owned());
    assert_eq!(shown(&"#".repeat(41)), shown(&format!("{}…", "#".repeat(39))));
    assert_ne!(shown(&"#".repeat(40)), shown(&format!("{}…", "#".repeat(39))), "40 fit as they are");
}

#[test]
fn a_title_stands_above_the_arena_and_moves_it_down() {
    let style = Style { title: true, ..Style::default() };
    let titled = SceneRenderer::new(&physics(), style).expect("a valid style");
    let blank = draw(&titled, "", &[]);
    let frame = draw(&titled, "Agent 0 (red)", &[]);
    assert_eq!(frame.height(), 480 + 18);
    let rows = rows_that_differ(&blank, &frame);
    // The boundary is 2 pixels thick and lies around the arena, which begins 20 below the title.
    assert!(!rows.is_empty() && rows.iter().all(|&row| row < 18 + 20 - 2), "{rows:?}");
    let plain = draw(&renderer(0), "not shown", &[]);
    for (x, y) in (0..480).flat_map(|y| (0..480).map(move |x| (x, y))) {
        assert_eq!(blank.pixel(x, y + 18), plain.pixel(x, y), "the picture is the same 18 rows further down");
    }
}

#[test]
fn bars_are_as_long_as_their_share_of_the_arena() {
    let renderer = renderer(3);
    let bar = Palette::default().bar;
    // The arena is 440 pixels wide and begins at 20; a line is 18 pixels high.
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
        let lines = [Caption::default(), Caption { bar: share, ..Caption::default() }, Caption::default()];
        let frame = draw(&renderer, "", &lines);
        let coloured = |y: u32| (0..480).filter(|&x| frame.pixel(x, y) == Some(bar)).collect::<Vec<_>>();
        assert_eq!(coloured(480 + 18 + 14), (20..20 + length).collect::<Vec<_>>(), "share {share}");
        for y in [480 + 3, 480 + 17, 480 + 18 + 8, 480 + 34, 480 + 36] {
            assert!(
                coloured(y).is_empty(),
                "share {share}: the text, other lines and the gap below stay free, row {y}"
            );
        }
    }
    let lined = |bar| draw(&renderer, "", &[Caption { bar, ..Caption::from("#".to_owned()) }]);
    let ink = |frame: &Frame| frame.rgba().chunks(4).filter(|pixel| pixel[..3] == [0; 3]).count();
    assert_eq!(ink(&lined(0.0)), ink(&lined(1.0)), "text stays on top");
}

/// A course grows from left to right, and its shares are stacked from the bottom up.
#[test]
fn a_course_is_stacked_from_the_left() {
    let style = Style { caption_lines: 1, course_lines: 2, ..Style::default() };
    let renderer = SceneRenderer::new(&physics(), style).expect("a valid style");
    let shares = [[0.5, 0.25, 0.25], [0.0, 1.0, 0.0]];
    let course = Course { shares: &shares, times: 4 };
    let frame = renderer.annotated(&state(), &Annotation { course: Some(course), ..Annotation::default() });
    let palette = Palette::default();
    let top = style.course_top();
    let bottom = style.course_top() + style.course_height() - 1;
    // The arena is 440 pixels wide, a time 110.
    for (x, y, colour) in [
        (20, bottom, palette.shares[0]),
        (129, bottom, palette.shares[0]),
        (129, bottom - style.course_height() * 5 / 8, palette.shares[1]),
        (20, top, palette.shares[2]),
        (130, bottom, palette.shares[1]),
        (239, top, palette.shares[1]),
        (240, bottom, palette.background),
        (19, bottom, palette.background),
    ] {
        assert_eq!(frame.pixel(x, y), Some(colour), "{x}, {y}");
    }
    let plain = renderer.annotated(&state(), &Annotation::default());
    assert!(rows_that_differ(&plain, &frame).into_iter().all(|row| (top..=bottom).contains(&row)));
}

/// Shares that are not shares are drawn somewhere within the strip, and more times than there are fill it.
#[test]
fn no_share_leaves_the_strip() {
    let style = Style { course_lines: 2, ..Style::default() };
    let renderer = SceneRenderer::new(&physics(), style).expect("a valid style");
    let plain = renderer.annotated(&state(), &Annotation::default());
    let shares = [[f32::NAN, 2.0, -1.0], [f32::INFINITY, 1.0, 1.0], [-5.0, f32::NEG_INFINITY, 0.2]];
    for times in [0, 1, 3, usize::MAX] {
        let course = Some(Course { shares: &shares, times });
        let frame = renderer.annotated(&state(), &Annotation { course, ..Annotation::default() });
        let strip = style.course_top()..style.course_top() + style.course_height();
        assert!(rows_that_differ(&plain, &frame).into_iter().all(|row| strip.contains(&row)));
    }
}
