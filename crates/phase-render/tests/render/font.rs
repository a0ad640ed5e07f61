//! The embedded font is the one it claims to be, and text is measured, shortened and placed as documented.

use crate::common::{physics, state};
use phase_model::AgentId;
use phase_perception::CellSet;
use phase_render::{Caption, Frame, Overlay, SceneRenderer, SizedFont, Style, font::Font};

/// Advances in DejaVu Sans 2.37, in units of 1/2048 em, as fonttools reads them from the file published.
const ADVANCES: [(char, u16); 13] = [
    ('A', 1401),
    ('g', 1300),
    ('L', 1141),
    ('1', 1303),
    (' ', 651),
    ('.', 651),
    ('…', 2048),
    ('λ', 1212),
    ('−', 1716),
    ('i', 569),
    ('W', 2025),
    ('é', 1260),
    ('→', 1716),
];

fn font() -> SizedFont {
    SizedFont::new(16).expect("the embedded font is a font")
}

#[test]
fn advances_are_those_of_dejavu_sans() {
    let font = Font::embedded().expect("the embedded font is a font");
    for (character, units) in ADVANCES {
        assert_eq!(font.advance(character), f32::from(units) / 2048.0, "{character}");
    }
}

#[test]
fn all_that_is_written_has_a_glyph() {
    let font = Font::embedded().expect("the embedded font is a font");
    for character in (' '..='~').chain('\u{a0}'..='ÿ').chain("αλεθΔΣΩ−·…→←↕↔≤≥≈≠∞∈–—‘’“”₀₁⁴′".chars())
    {
        assert!(font.contains(character), "{character:?} is missing");
    }
    for character in ['\u{4e2d}', '\u{1f600}', '\u{10ffff}'] {
        assert!(!font.contains(character), "{character:?}");
        assert_eq!(font.advance(character), font.advance('\u{10fffe}'), "all that is missing is one box");
    }
}

#[test]
fn the_width_of_a_text_is_the_sum_of_its_advances() {
    let font = font();
    for text in ["", "A", "Wig", "1.1 λ → −1…"] {
        let units: f32 = text
            .chars()
            .map(|character| {
                ADVANCES
                    .iter()
                    .find(|(known, _)| *known == character)
                    .map_or(0.0, |(_, units)| f32::from(*units))
            })
            .sum();
        assert!((font.width(text) - 16.0 * units / 2048.0).abs() < 1e-3, "{text:?}");
    }
}

#[test]
fn text_is_shortened_only_where_it_must_be_and_then_fits() {
    let font = font();
    let text = "On(object 1, landmark 2)";
    let full = font.width(text);
    assert_eq!(font.clip(text, full), text);
    for available in 0..=full as u32 {
        let clipped = font.clip(text, available as f32);
        assert!(font.width(&clipped) <= available as f32, "{clipped:?} in {available}");
        if available < 16 {
            assert_eq!(clipped, "", "an ellipsis is 16 pixels wide");
            continue;
        }
        let beginning = clipped.strip_suffix('…').expect("an ellipsis shows that something is missing");
        let rest = text.strip_prefix(beginning).expect("what is left is the beginning");
        // One more character would not fit, spaces aside.
        let next = rest.trim_start().chars().next().expect("something is missing");
        let longer = format!("{beginning}{}{next}…", &rest[..rest.len() - rest.trim_start().len()]);
        assert!(font.width(&longer) > available as f32, "{clipped:?} could be longer in {available}");
    }
}

fn captioned(style: Style, captions: &[Caption]) -> Frame {
    let renderer = SceneRenderer::new(&physics(), style).expect("a valid style");
    let visible = CellSet::EMPTY;
    renderer.frame(
        &state(),
        Some(&Overlay { agent: AgentId::ZERO, visible: &visible, particles: &[], title: "", captions }),
    )
}

/// The columns and rows of the first caption that are not white, as first and last of each.
fn ink(frame: &Frame, style: &Style) -> Option<[u32; 4]> {
    let rows = style.caption_top()..style.caption_top() + style.line_height();
    let inked = rows.flat_map(|y| (0..frame.width()).map(move |x| (x, y)));
    let inked: Vec<_> = inked.filter(|&(x, y)| frame.pixel(x, y) != Some([255; 3])).collect();
    let columns = || inked.iter().map(|(x, _)| *x);
    let rows = || inked.iter().map(|(_, y)| *y);
    Some([columns().min()?, columns().max()?, rows().min()?, rows().max()?])
}

/// An H of DejaVu Sans spans 201 to 1339 units across, of an advance of 1540, and 0 to 1493 units upwards.
#[test]
fn letters_are_as_large_as_they_are_meant_to_be_and_aligned() {
    for side in [320, 480, 960, 1440] {
        let style = Style { caption_lines: 1, ..Style::with_side(side) };
        let size = style.text_size() as f32;
        let em = |units: f32| units / 2048.0 * size;
        let line = |cells: Vec<String>, text: &str| {
            captioned(style, &[Caption { cells, text: text.into(), bar: 0.0 }])
        };
        let [left, right, top, bottom] = ink(&line(vec![], "H"), &style).expect("an H is visible");
        let close = |found: u32, expected: f32| (found as f32 - expected).abs() <= 1.5;
        let margin = style.margin as f32;
        assert!(
            close(left, margin + em(201.0)) && close(right + 1, margin + em(1339.0)),
            "{side}: {left} to {right}"
        );
        assert!(close(bottom + 1 - top, em(1493.0)), "{side}: {top} to {bottom}");
        let middle = style.caption_top() as f32 + 0.5 * (style.line_height() - 2) as f32;
        assert!((0.5 * (top + bottom + 1) as f32 - middle).abs() <= 1.5, "{side}: in the middle of the line");

        let [left, right, ..] = ink(&line(vec!["H".into()], ""), &style).expect("an H is visible");
        let end = margin + style.cell_width() as f32;
        assert!(
            close(left, end - em(1540.0 - 201.0)) && close(right + 1, end - em(1540.0 - 1339.0)),
            "{side}: a cell"
        );
    }
}

#[test]
fn edges_of_letters_are_blended_and_black_inside() {
    let style = Style { caption_lines: 1, ..Style::with_side(960) };
    let frame = captioned(style, &["O".to_owned().into()]);
    let [left, right, top, bottom] = ink(&frame, &style).expect("an O is visible");
    let levels: std::collections::BTreeSet<u8> = (top..=bottom)
        .flat_map(|y| (left..=right).map(move |x| (x, y)))
        .filter_map(|(x, y)| frame.pixel(x, y))
        .map(|[red, green, blue]| {
            assert!(red == green && green == blue, "black on white is grey between");
            red
        })
        .collect();
    assert!(levels.len() > 20, "{levels:?}");
    assert!(levels.contains(&0) && levels.contains(&255));
    let centre = frame.pixel(u32::midpoint(left, right), u32::midpoint(top, bottom));
    assert_eq!(centre, Some([255; 3]), "the counter of an O is open");
}
