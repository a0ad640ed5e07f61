//! Sizes and colours of a picture.

use crate::{RenderError, font};

/// An opaque sRGB colour: red, green, blue.
pub type Colour = [u8; 3];

/// The colours of everything drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Palette {
    /// Behind everything.
    pub background: Colour,
    /// Inner walls, the arena's boundary and text.
    pub ink: Colour,
    /// Landmarks by id; paler than the published ones so that bodies stand out on them.
    pub landmarks: [Colour; 4],
    /// Agents 0 and 1.
    pub agents: [Colour; 2],
    /// Objects 0 and 1.
    pub objects: [Colour; 2],
    /// Outlines of bodies.
    pub outline: Colour,
    /// What is not seen in an overlay is covered with this colour, half transparent.
    pub unseen: Colour,
    /// What is seen in an overlay is tinted with this colour, slightly.
    pub seen: Colour,
    /// Bars behind captions; pale, since text is written over them.
    pub bar: Colour,
}

impl Default for Palette {
    /// Blue, green, red and yellow landmarks; a red and a green agent; a light blue and a pink object.
    fn default() -> Self {
        Self {
            background: [255, 255, 255],
            ink: [0, 0, 0],
            landmarks: [
                soften([45, 45, 180]),
                soften([50, 150, 50]),
                soften([180, 45, 45]),
                soften([180, 180, 45]),
            ],
            agents: [[235, 20, 20], [20, 190, 20]],
            objects: [[117, 216, 230], [255, 153, 153]],
            outline: [40, 40, 40],
            unseen: [110, 110, 120],
            seen: [255, 240, 150],
            bar: [185, 212, 245],
        }
    }
}

/// How a picture is laid out: a square with the arena in the middle, and room for captions below.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Style {
    /// Side of the square (pixels), 64 to 2000.
    pub side: u32,
    /// White space on each side between the picture's edge and the arena (pixels), below a quarter of `side`.
    pub margin: u32,
    /// Lines of text below the square, 0 to 16.
    pub caption_lines: u32,
    /// The colours.
    pub palette: Palette,
}

impl Default for Style {
    /// 480 × 480 pixels without captions. An arena unit is 22 pixels, so that whole units fall on the 2 × 2
    /// blocks in which video keeps colour and straight edges stay crisp.
    fn default() -> Self {
        Self { side: 480, margin: 20, caption_lines: 0, palette: Palette::default() }
    }
}

impl Style {
    /// The default style at another size, in pixels; the margin keeps its share.
    #[must_use]
    pub fn with_side(side: u32) -> Self {
        Self { side, margin: side / 24, ..Self::default() }
    }

    /// Width of a picture (pixels).
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.side
    }

    /// Height of a picture, captions included (pixels).
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.side.saturating_add(self.caption_height())
    }

    /// Pixels across one dot of a caption's letters.
    #[must_use]
    pub const fn text_scale(&self) -> u32 {
        if self.side < 360 { 1 } else { self.side / 240 }
    }

    /// Distance from one line of text to the next (pixels); even, so that video stays possible.
    #[must_use]
    pub const fn line_height(&self) -> u32 {
        (font::GLYPH_HEIGHT as u32 + 3) * self.text_scale()
    }

    /// Characters that fit into a line of text.
    #[must_use]
    pub const fn caption_columns(&self) -> usize {
        let advance = (font::GLYPH_WIDTH as u32 + 1) * self.text_scale();
        (self.side.saturating_sub(self.margin) / advance) as usize
    }

    /// Height of the strip with the captions (pixels).
    #[must_use]
    pub const fn caption_height(&self) -> u32 {
        self.caption_lines.saturating_mul(self.line_height())
    }

    /// Checks that the fields lie in the ranges given with them.
    ///
    /// # Errors
    /// [`RenderError::Style`] for the first that does not.
    pub fn validate(&self) -> Result<(), RenderError> {
        let check = |field, low: u32, high: u32, found: u32| {
            if (low..=high).contains(&found) {
                Ok(())
            } else {
                Err(RenderError::Style { field, rule: format!("{low} to {high}"), found })
            }
        };
        check("side", 64, 2000, self.side)?;
        check("margin", 0, self.side / 4, self.margin)?;
        check("caption_lines", 0, 16, self.caption_lines)
    }
}

/// A colour mixed half and half with white.
const fn soften(colour: Colour) -> Colour {
    let mut soft = colour;
    let mut channel = 0;
    while channel < soft.len() {
        soft[channel] = 128 + soft[channel] / 2;
        channel += 1;
    }
    soft
}
