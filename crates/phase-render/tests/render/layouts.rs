//! The chart of all layouts.

use phase_model::{Flip, Layout};
use phase_render::{Palette, layout_chart};

/// The chart's geometry, found in the picture itself: small arenas are frames of 100 × 100 pixels.
#[test]
fn the_chart_shows_every_layout_in_every_mirror() {
    let chart = layout_chart(&Palette::default()).expect("a chart");
    let dark = |x: u32, y: u32| chart.pixel(x, y).is_some_and(|[red, ..]| red < 140);
    // The upper left corner of the arena of a base layout in one of its five variants.
    let corner = |base: u32, variant: u32| (base % 2 * 688 + 78 + variant * 122, 478 + base / 2 * 126);
    for base in 0..22 {
        for (variant, flip) in (0..).zip([None].into_iter().chain(Flip::ALL.map(Some))) {
            let (left, top) = corner(base, variant);
            let walls = Layout::new(base as u8, flip).expect("a layout").walls();
            for (x, y) in [
                (16.0, 14.0),
                (16.0, 21.0),
                (16.0, 10.0),
                (16.0, 3.0),
                (14.0, 12.0),
                (7.0, 12.0),
                (18.0, 12.0),
                (25.0, 12.0),
            ] {
                let point = phase_model::Vec2::new(x, y);
                let walled = walls.iter().any(|wall| wall.distance(point) == 0.0);
                let across = left + (5.0 * (x - 6.0)) as u32;
                let down = top + (5.0 * (22.0 - y)) as u32;
                // A wall of 0.25 u covers more of one of the two pixels beside the line than half.
                let seen = dark(across, down) || dark(across - 1, down) || dark(across, down - 1);
                assert_eq!(seen, walled, "layout {base} {flip:?} at ({x}, {y})");
            }
        }
    }
}

#[test]
fn the_picture_in_the_documentation_is_the_chart() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/images/layouts.png");
    let picture = tiny_skia::Pixmap::load_png(path).expect("docs/images/layouts.png");
    let chart = layout_chart(&Palette::default()).expect("a chart");
    assert_eq!((picture.width(), picture.height()), (chart.width(), chart.height()));
    assert!(
        picture.data() == chart.rgba(),
        "draw it anew: cargo run --package phase-render --example layouts -- docs/images/layouts.png"
    );
}
