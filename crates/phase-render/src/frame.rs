//! One picture.

use crate::RenderError;
use tiny_skia::Pixmap;

/// An opaque picture, row by row from the top left.
#[derive(Clone, PartialEq, Debug)]
pub struct Frame {
    pixmap: Pixmap,
}

impl Frame {
    /// Width (pixels).
    #[must_use]
    pub fn width(&self) -> u32 {
        self.pixmap.width()
    }

    /// Height (pixels).
    #[must_use]
    pub fn height(&self) -> u32 {
        self.pixmap.height()
    }

    /// All pixels as red, green, blue and alpha; alpha is always 255.
    #[must_use]
    pub fn rgba(&self) -> &[u8] {
        self.pixmap.data()
    }

    /// Red, green and blue of one pixel, or `None` outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        // The pixmap itself only checks that the pixel lies within its memory, which wraps around at the
        // right.
        let pixel = if x < self.width() { self.pixmap.pixel(x, y) } else { None };
        pixel.map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
    }

    /// The picture as a .png file.
    ///
    /// # Errors
    /// [`RenderError::Png`] if the encoder fails, which it does only when memory runs out.
    pub fn png(&self) -> Result<Vec<u8>, RenderError> {
        self.pixmap.encode_png().map_err(|error| RenderError::Png(error.into()))
    }

    /// A frame of what has been drawn. The painters only draw on an opaque ground, so it stays opaque.
    pub(crate) const fn of(pixmap: Pixmap) -> Self {
        Self { pixmap }
    }

    pub(crate) const fn pixmap(&self) -> &Pixmap {
        &self.pixmap
    }
}
