//! Several frames in one picture.

use crate::{Frame, RenderError};
use tiny_skia::{Color, Pixmap, PixmapPaint, Transform};

/// Space between frames in one picture (pixels).
pub const GAP: u32 = 4;
/// Longest side of a contact sheet (pixels).
const MAX_SIDE: usize = 16_384;

/// Puts frames of one size into one picture, row by row from the top left, `columns` to a row, [`GAP`] apart
/// on a grey ground.
///
/// # Errors
/// [`RenderError::NoFrames`] without frames, [`RenderError::FrameSize`] if a frame differs in size from the
/// first, [`RenderError::Sheet`] if `columns` is 0 or the sheet would be over 16384 pixels wide or high.
pub fn contact_sheet(frames: &[Frame], columns: usize) -> Result<Frame, RenderError> {
    compose(frames, columns, GAP)
}

/// Puts frames of one size beside each other, [`GAP`] apart, without a border: `n` frames `w` pixels wide
/// make a picture `n · w + (n − 1) · GAP` wide.
///
/// # Errors
/// As for [`contact_sheet`].
pub fn side_by_side(frames: &[Frame]) -> Result<Frame, RenderError> {
    compose(frames, frames.len(), 0)
}

/// Frames in rows with a border around them (pixels).
fn compose(frames: &[Frame], columns: usize, border: u32) -> Result<Frame, RenderError> {
    let first = frames.first().ok_or(RenderError::NoFrames("contact sheet"))?;
    let width = first.width();
    let height = first.height();
    for (index, frame) in frames.iter().enumerate() {
        let found_width = frame.width();
        let found_height = frame.height();
        if (found_width, found_height) != (width, height) {
            return Err(RenderError::FrameSize { index, found_width, found_height, width, height });
        }
    }
    let refused = || RenderError::Sheet { frames: frames.len(), columns };
    let columns_used = columns.min(frames.len());
    if columns_used == 0 {
        return Err(refused());
    }
    let side = |count: usize, size: u32| {
        let frames_and_gaps = count.checked_mul((size + GAP) as usize)?.checked_sub(GAP as usize)?;
        let side = frames_and_gaps.checked_add(2 * border as usize)?;
        (side <= MAX_SIDE).then_some(side as u32)
    };
    let sheet_width = side(columns_used, width).ok_or_else(refused)?;
    let sheet_height = side(frames.len().div_ceil(columns_used), height).ok_or_else(refused)?;
    let mut sheet = Pixmap::new(sheet_width, sheet_height).ok_or_else(refused)?;
    sheet.fill(Color::from_rgba8(128, 128, 128, 255));
    for (k, frame) in frames.iter().enumerate() {
        let left = border as usize + k % columns_used * (width + GAP) as usize;
        let top = border as usize + k / columns_used * (height + GAP) as usize;
        sheet.draw_pixmap(
            left as i32,
            top as i32,
            frame.pixmap().as_ref(),
            &PixmapPaint::default(),
            Transform::identity(),
            None,
        );
    }
    Ok(Frame::of(sheet))
}
