//! The legend shows a sample of each mark, with its meaning beside it.

use crate::common::{physics, state};
use phase_model::{AgentId, State};
use phase_perception::{Cell, CellSet};
use phase_render::{
    Frame, Overlay, Palette, SceneRenderer, SizedFont, Style,
    legend::{ENTRIES, Mark},
    style::LEGEND_LINES,
};

fn style(caption_lines: u32) -> Style {
    Style { legend: true, caption_lines, ..Style::default() }
}

fn draw(style: Style, visible: &CellSet) -> Frame {
    let renderer = SceneRenderer::new(&physics(), style).expect("a valid style");
    renderer.frame(
        &state(),
        Some(&Overlay { agent: AgentId::ZERO, visible, particles: &[], title: "", captions: &[] }),
    )
}

/// The colours in an entry's third of its line: those of its sample, then those of its label.
fn colours(frame: &Frame, style: &Style, entry: u32) -> [Vec<[u8; 3]>; 2] {
    let line = style.line_height();
    let third = style.text_width() / 3;
    let left = style.margin + entry % 3 * third;
    let top = style.legend_top() + entry / 3 * line;
    let split = 5 * line / 4 + style.text_size() / 2;
    [left..left + 5 * line / 4, left + split..left + third].map(|columns| {
        columns.flat_map(|x| (top..top + line).filter_map(move |y| frame.pixel(x, y))).collect()
    })
}

#[test]
fn samples_have_the_colours_of_what_they_explain() {
    let style = style(1);
    let palette = Palette::default();
    let visible: CellSet = Cell::all().filter(|&cell| Cell::min(cell).x >= 12.0).collect();
    let frame = draw(style, &visible);
    let renderer = SceneRenderer::new(&physics(), style).expect("a valid style");
    let floor = |x: f32| crate::common::at(&renderer, &frame, x, 15.0);
    for (entry, (mark, label)) in (0..).zip(ENTRIES) {
        let [sample, text] = colours(&frame, &style, entry);
        let expected = match mark {
            Mark::Seen => vec![floor(14.0)],
            Mark::Unseen => vec![floor(11.5)],
            Mark::Grip => vec![palette.agents[0], palette.outline],
            Mark::TrueState => vec![palette.objects[0], palette.objects[1], palette.outline],
            Mark::Particles => vec![],
            Mark::Share => vec![palette.bar],
        };
        for colour in &expected {
            assert!(sample.contains(colour), "{mark:?} has no {colour:?}");
        }
        // Believed bodies are between the ground and their colour, and get closer to it where several agree.
        if mark == Mark::Particles {
            let bluish =
                sample.iter().filter(|[red, _, blue]| blue > red).collect::<std::collections::BTreeSet<_>>();
            assert!(bluish.len() > 5, "{bluish:?}");
        }
        assert!(text.iter().any(|colour| *colour == palette.ink || colour[0] < 60), "{label} is written");
    }
}

#[test]
fn labels_fit_at_the_sizes_in_use() {
    for side in [320, 480, 960] {
        let style = Style { legend: true, ..Style::with_side(side) };
        let font = SizedFont::new(style.text_size()).expect("the embedded font is a font");
        let room = style.text_width() / 3 - 5 * style.line_height() / 4 - style.text_size() / 2;
        for (mark, label) in ENTRIES {
            assert!(font.width(label) <= room as f32, "{mark:?} in {room} pixels at {side}");
        }
    }
}

#[test]
fn a_legend_takes_its_lines_and_leaves_the_rest_alone() {
    let style = style(0);
    let with = draw(style, &CellSet::EMPTY);
    let without = draw(Style { legend: false, ..style }, &CellSet::EMPTY);
    assert_eq!(with.height(), without.height() + LEGEND_LINES * style.line_height() + 6);
    let size = without.rgba().len();
    assert!(with.rgba()[..size] == *without.rgba());
    let share = ENTRIES.iter().position(|(mark, _)| *mark == Mark::Share).expect("there is one") as u32;
    let [sample, label] = colours(&with, &style, share);
    let white = |colours: &[[u8; 3]]| colours.iter().all(|colour| *colour == [255; 3]);
    assert!(white(&sample) && white(&label), "without captions there are no bars to explain");
}

#[test]
fn the_legend_does_not_depend_on_what_is_shown() {
    let renderer = SceneRenderer::new(&physics(), style(2)).expect("a valid style");
    let legend = |frame: Frame| frame.rgba()[480 * 480 * 4..].to_vec();
    let state: State = state();
    let visible: CellSet = Cell::all().collect();
    let overlay =
        Overlay { agent: AgentId::ONE, visible: &visible, particles: &[state; 3], title: "", captions: &[] };
    assert!(legend(renderer.frame(&state, None)) == legend(renderer.frame(&state, Some(&overlay))));
}
