//! The embedded font: characters as outlines.
//!
//! A subset of DejaVu Sans, so that text needs no font file of the machine. `assets/` has its licence and the
//! script that made it.

use crate::RenderError;
use ab_glyph::{Font as _, FontRef, Glyph, GlyphId, OutlinedGlyph, PxScale, point};

/// The font file.
const DATA: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");
/// Height of capitals (em): DejaVu Sans has 1493 of 2048 units.
const CAPITAL_HEIGHT: f32 = 1493.0 / 2048.0;

/// The embedded font: printable ASCII, Latin-1, Greek, dashes, arrows and common mathematical symbols.
#[derive(Clone, Debug)]
pub struct Font {
    face: FontRef<'static>,
    units_per_em: f32,
}

impl Font {
    /// Parses the embedded font.
    ///
    /// # Errors
    /// [`RenderError::Font`] if it cannot be parsed, which a test excludes.
    pub fn embedded() -> Result<Self, RenderError> {
        // The parser's error says no more than that it is one.
        let face = FontRef::try_from_slice(DATA).map_err(|_| RenderError::Font)?;
        let units_per_em = face.units_per_em().ok_or(RenderError::Font)?;
        Ok(Self { face, units_per_em })
    }

    /// Whether the font has a glyph for a character. Others are drawn as an empty box.
    #[must_use]
    pub fn contains(&self, character: char) -> bool {
        self.face.glyph_id(character) != GlyphId(0)
    }

    /// Advance: distance from a character to the next one (em).
    #[must_use]
    pub fn advance(&self, character: char) -> f32 {
        self.face.h_advance_unscaled(self.face.glyph_id(character)) / self.units_per_em
    }

    /// Height of capitals above the baseline (em).
    #[must_use]
    pub const fn capital_height(&self) -> f32 {
        CAPITAL_HEIGHT
    }

    /// A character's outline at a size (pixels per em) with its origin on the baseline at a point (pixels, y
    /// down); `None` if it leaves no ink.
    pub(crate) fn outline(&self, character: char, size: f32, x: f32, baseline: f32) -> Option<OutlinedGlyph> {
        let scale = PxScale::from(size * self.face.height_unscaled() / self.units_per_em);
        let glyph = Glyph { id: self.face.glyph_id(character), scale, position: point(x, baseline) };
        self.face.outline_glyph(glyph)
    }
}
