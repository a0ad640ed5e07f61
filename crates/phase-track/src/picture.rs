//! A frame of a video, and colours.

use crate::TrackError;

/// Greatest width and height of a picture (pixels).
pub const MOST_PIXELS_ACROSS: usize = 4096;

/// One frame: `width × height` pixels of red, green and blue, row by row from the top left.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    width: usize,
    height: usize,
    rgb: &'a [u8],
}

/// Red, green and blue, 0 to 255.
pub(crate) type Rgb = [f32; 3];

impl<'a> Picture<'a> {
    /// A frame of these bytes.
    ///
    /// # Errors
    /// [`TrackError::Size`] unless width and height are 32 to 4096 pixels and there are three bytes a pixel.
    pub fn new(width: usize, height: usize, rgb: &'a [u8]) -> Result<Self, TrackError> {
        let fits = [width, height].iter().all(|side| (32..=MOST_PIXELS_ACROSS).contains(side));
        if !fits || rgb.len() != 3 * width * height {
            return Err(TrackError::Size { width, height });
        }
        Ok(Self { width, height, rgb })
    }

    /// Width and height (pixels).
    #[must_use]
    pub const fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    pub(crate) const fn bytes(&self) -> &'a [u8] {
        self.rgb
    }

    pub(crate) fn at(&self, x: usize, y: usize) -> Rgb {
        let k = 3 * (y * self.width + x);
        [0, 1, 2].map(|channel| f32::from(self.rgb[k + channel]))
    }
}

/// The bytes of a picture in which light is dark.
pub(crate) fn negative(picture: &Picture<'_>) -> Vec<u8> {
    picture.rgb.iter().map(|channel| 255 - channel).collect()
}

/// Distance of two colours, 0 to 442.
pub(crate) fn distance(a: Rgb, b: Rgb) -> f32 {
    square(a, b).sqrt()
}

pub(crate) fn square(a: Rgb, b: Rgb) -> f32 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum()
}

pub(crate) fn mix(a: Rgb, b: Rgb, share: f32) -> Rgb {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * share)
}

/// 1 for black, 0 for anything lighter than a medium grey or coloured.
pub(crate) fn darkness(colour: Rgb) -> f32 {
    ((128.0 - colour[0].max(colour[1]).max(colour[2])) / 128.0).max(0.0)
}
