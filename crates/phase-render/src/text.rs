//! Captions, dot by dot, and the bars behind them.

use crate::{
    Colour,
    font::{self, GLYPH_WIDTH},
};
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// Writes one line with its upper left corner at a pixel, each dot `scale` pixels wide. What does not fit
/// is cut off.
pub(crate) fn write(pixmap: &mut Pixmap, corner: (u32, u32), scale: u32, line: &str, colour: Colour) {
    let advance = (GLYPH_WIDTH as u32 + 1) * scale;
    let (width, left) = (pixmap.width(), corner.0);
    let fits = (width.saturating_sub(left) / advance.max(1)) as usize;
    for (x, character) in (left..).step_by(advance.max(1) as usize).zip(line.chars().take(fits)) {
        for (row, bits) in (0..).zip(font::glyph(character)) {
            for column in (0..GLYPH_WIDTH as u32).filter(|column| bits & (0b10000 >> column) != 0) {
                fill(pixmap, (x + column * scale, corner.1 + row * scale), (scale, scale), colour);
            }
        }
    }
}

/// Fills a rectangle with its upper left corner at a pixel and so many pixels wide and high, as far as it lies
/// in the picture.
pub(crate) fn fill(
    pixmap: &mut Pixmap,
    (left, top): (u32, u32),
    (across, down): (u32, u32),
    [red, green, blue]: Colour,
) {
    let (width, height) = (pixmap.width(), pixmap.height());
    let Some(colour) = PremultipliedColorU8::from_rgba(red, green, blue, 255) else { return };
    for y in top..(top + down).min(height) {
        for x in left..(left + across).min(width) {
            pixmap.pixels_mut()[(y * width + x) as usize] = colour;
        }
    }
}
