//! Key frames side by side.

use crate::common::{physics, state};
use phase_render::{Frame, RenderError, SceneRenderer, Style, contact_sheet, sheet::GAP, side_by_side};

/// Frames of 100 × 100 pixels that differ.
fn frames(count: usize) -> Vec<Frame> {
    let renderer = SceneRenderer::new(&physics(), Style::with_side(100)).expect("a valid style");
    let move_right = |k: usize| {
        let mut state = state();
        state.bodies[0].position.x += k as f32;
        renderer.frame(&state, None)
    };
    (0..count).map(move_right).collect()
}

#[test]
fn frames_keep_their_pixels() {
    let frames = frames(5);
    for (columns, wide, high) in [(1, 1, 5), (2, 2, 3), (3, 3, 2), (5, 5, 1), (80, 5, 1)] {
        let sheet = contact_sheet(&frames, columns).unwrap();
        assert_eq!((sheet.width(), sheet.height()), (wide * 104 + 4, high * 104 + 4), "{columns} columns");
        for (k, frame) in (0..).zip(&frames) {
            let left = GAP + k % wide * 104;
            let top = GAP + k / wide * 104;
            for (x, y) in (0..100).flat_map(|y| (0..100).map(move |x| (x, y))) {
                assert_eq!(sheet.pixel(left + x, top + y), frame.pixel(x, y), "frame {k} at ({x}, {y})");
            }
        }
        assert_eq!(sheet.pixel(0, 0), Some([128; 3]), "the ground is grey");
    }
}

#[test]
fn frames_beside_each_other_have_a_gap_and_no_border() {
    let frames = frames(2);
    let both = side_by_side(&frames).unwrap();
    assert_eq!((both.width(), both.height()), (2 * 100 + GAP, 100));
    assert!(both.width().is_multiple_of(2), "or it could not become a video");
    for (x, y) in (0..100).flat_map(|y| (0..100).map(move |x| (x, y))) {
        assert_eq!(both.pixel(x, y), frames[0].pixel(x, y), "left at ({x}, {y})");
        assert_eq!(both.pixel(100 + GAP + x, y), frames[1].pixel(x, y), "right at ({x}, {y})");
    }
    assert!((100..100 + GAP).all(|x| both.pixel(x, 50) == Some([128; 3])), "the gap is grey");
    assert!(matches!(side_by_side(&[]), Err(RenderError::NoFrames(_))));
}

#[test]
fn sheets_that_cannot_be_are_refused() {
    assert!(matches!(contact_sheet(&[], 3), Err(RenderError::NoFrames("contact sheet"))));
    assert!(matches!(contact_sheet(&frames(2), 0), Err(RenderError::Sheet { frames: 2, columns: 0 })));
    let mut mixed = frames(2);
    mixed.push(SceneRenderer::new(&physics(), Style::with_side(120)).unwrap().frame(&state(), None));
    let refused = contact_sheet(&mixed, 2);
    assert!(matches!(refused, Err(RenderError::FrameSize { index: 2, found_width: 120, width: 100, .. })));
    let many = vec![frames(1).remove(0); 200];
    assert!(matches!(contact_sheet(&many, 200), Err(RenderError::Sheet { frames: 200, columns: 200 })));
    assert!(contact_sheet(&many, 20).is_ok());
}
