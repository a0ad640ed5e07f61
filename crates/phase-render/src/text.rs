//! Text: measured, shortened to fit, aligned and drawn with antialiasing.

use crate::{Colour, RenderError, font::Font};
use std::borrow::Cow;
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// Mark in place of the part of a text that does not fit.
const ELLIPSIS: char = '…';

/// The part of a text that lies at the given position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Align {
    /// The left end.
    Left,
    /// The middle.
    Centre,
    /// The right end.
    Right,
}

/// The embedded font at one size.
#[derive(Clone, Debug)]
pub struct SizedFont {
    font: Font,
    size: f32,
}

impl SizedFont {
    /// The font at a size (pixels per em).
    ///
    /// # Errors
    /// [`RenderError::Font`] if the embedded font cannot be parsed, which a test excludes.
    pub fn new(size: u32) -> Result<Self, RenderError> {
        Ok(Self { font: Font::embedded()?, size: size as f32 })
    }

    /// Width of a text (pixels): the sum of its characters' advances.
    #[must_use]
    pub fn width(&self, text: &str) -> f32 {
        text.chars().map(|character| self.advance(character)).sum()
    }

    /// The text if it is at most `available` pixels wide; otherwise as much of its beginning as fits with an
    /// ellipsis behind it. Empty if not even the ellipsis fits.
    #[must_use]
    pub fn clip<'a>(&self, text: &'a str, available: f32) -> Cow<'a, str> {
        if self.width(text) <= available {
            return Cow::Borrowed(text);
        }
        let mut left = available - self.advance(ELLIPSIS);
        if left < 0.0 {
            return Cow::Borrowed("");
        }
        let fits = |character: &char| {
            left -= self.advance(*character);
            left >= 0.0
        };
        let beginning: String = text.chars().take_while(fits).collect();
        Cow::Owned(format!("{}{ELLIPSIS}", beginning.trim_end()))
    }

    /// The baseline (pixels, y down) that centres capitals in a line of a height below `top`.
    #[must_use]
    pub fn baseline(&self, top: u32, height: u32) -> i32 {
        let capitals = self.font.capital_height() * self.size;
        top as i32 + (0.5 * (height as f32 + capitals)).round() as i32
    }

    /// Draws a text with the part named by `align` at `x` and its baseline at `baseline` (pixels, y down).
    /// Parts outside of the picture are left out.
    pub(crate) fn draw(
        &self,
        pixmap: &mut Pixmap,
        text: &str,
        (x, baseline): (f32, i32),
        align: Align,
        colour: Colour,
    ) {
        // Whole pixels at the start, so that equal texts look equal wherever they stand.
        let mut pen = match align {
            Align::Left => x,
            Align::Centre => x - 0.5 * self.width(text),
            Align::Right => x - self.width(text),
        }
        .round();
        for character in text.chars() {
            if let Some(outline) = self.font.outline(character, self.size, pen, baseline as f32) {
                let corner = outline.px_bounds().min;
                outline.draw(|right, down, coverage| {
                    blend(
                        pixmap,
                        corner.x as i32 + right as i32,
                        corner.y as i32 + down as i32,
                        coverage,
                        colour,
                    );
                });
            }
            pen += self.advance(character);
        }
    }

    fn advance(&self, character: char) -> f32 {
        self.font.advance(character) * self.size
    }
}

/// Mixes an opaque pixel with a colour by the share of it that is covered. In whole numbers from here on.
fn blend(pixmap: &mut Pixmap, x: i32, y: i32, coverage: f32, colour: Colour) {
    let width = pixmap.width() as i32;
    let height = pixmap.height() as i32;
    if !(0..width).contains(&x) || !(0..height).contains(&y) {
        return;
    }
    let cover = (coverage.clamp(0.0, 1.0) * 255.0 + 0.5) as u32;
    let pixel = &mut pixmap.pixels_mut()[(y * width + x) as usize];
    let mix = |under: u8, over: u8| {
        ((u32::from(under) * (255 - cover) + u32::from(over) * cover + 127) / 255) as u8
    };
    let [red, green, blue] = colour;
    let mixed = (mix(pixel.red(), red), mix(pixel.green(), green), mix(pixel.blue(), blue));
    if let Some(mixed) = PremultipliedColorU8::from_rgba(mixed.0, mixed.1, mixed.2, 255) {
        *pixel = mixed;
    }
}
