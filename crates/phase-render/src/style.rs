//! The layout of a picture.

use crate::{Palette, RenderError};

/// Lines of text that the legend takes.
pub const LEGEND_LINES: u32 = 2;

/// The layout of a picture: a square with the arena in the middle; above it room for a title, below it for a
/// legend and captions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Style {
    /// Side of the square (pixels), 64 to 2000.
    pub side: u32,
    /// White space on each side between the picture's edge and the arena (pixels), below a quarter of `side`.
    pub margin: u32,
    /// Whether there is a line above the square for [`crate::Overlay::title`].
    pub title: bool,
    /// Whether a legend below the square says what the marks of an overlay mean.
    pub legend: bool,
    /// Lines of text below the square and the legend, 0 to 16.
    pub caption_lines: u32,
    /// Height of the strip below the captions in which a [`crate::annotation::Course`] is drawn (lines of
    /// text), 0 to 16.
    pub course_lines: u32,
    /// The colours.
    pub palette: Palette,
    /// Whether a dark bar marks each grip. Recordings of the published simulator have none.
    pub grips: bool,
}

/// Space between legend and captions (pixels).
const LEGEND_GAP: u32 = 6;

impl Default for Style {
    /// 480 × 480 pixels without title, legend and captions. An arena unit is 22 pixels, so that whole units
    /// fall on the 2 × 2 blocks in which video keeps colour and straight edges stay crisp.
    fn default() -> Self {
        Self {
            side: 480,
            margin: 20,
            title: false,
            legend: false,
            caption_lines: 0,
            course_lines: 0,
            palette: Palette::default(),
            grips: true,
        }
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

    /// Height of a picture, title, legend and captions included (pixels).
    #[must_use]
    pub const fn height(&self) -> u32 {
        let margin = if self.course_lines > 0 { self.line_height() } else { 0 };
        self.course_top().saturating_add(self.course_height()).saturating_add(margin)
    }

    /// Top of the strip with the course (pixels from the top).
    #[must_use]
    pub const fn course_top(&self) -> u32 {
        self.caption_top().saturating_add(self.caption_lines.saturating_mul(self.line_height()))
    }

    /// Height of the strip with the course (pixels).
    #[must_use]
    pub const fn course_height(&self) -> u32 {
        self.course_lines.saturating_mul(self.line_height())
    }

    /// Size of text (pixels per em): 13 at the default size, and never below 11, which is the smallest that
    /// is easy to read.
    #[must_use]
    pub const fn text_size(&self) -> u32 {
        let proportional = self.side.saturating_mul(13) / 480;
        if proportional < 11 { 11 } else { proportional }
    }

    /// Distance from one line of text to the next (pixels); even, so that video stays possible.
    #[must_use]
    pub const fn line_height(&self) -> u32 {
        (self.text_size().saturating_mul(7) / 5 + 1) & !1
    }

    /// Width of a line of text (pixels): that of the arena.
    #[must_use]
    pub const fn text_width(&self) -> u32 {
        self.side.saturating_sub(self.margin.saturating_mul(2))
    }

    /// Width of one cell at the beginning of a caption (pixels).
    #[must_use]
    pub const fn cell_width(&self) -> u32 {
        self.text_size().saturating_mul(5)
    }

    /// Height of the strip with the title (pixels).
    #[must_use]
    pub const fn title_height(&self) -> u32 {
        if self.title { self.line_height() } else { 0 }
    }

    /// Top of the legend (pixels from the top).
    #[must_use]
    pub const fn legend_top(&self) -> u32 {
        self.title_height().saturating_add(self.side)
    }

    /// Top of the captions (pixels from the top).
    #[must_use]
    pub const fn caption_top(&self) -> u32 {
        let legend =
            if self.legend { self.line_height().saturating_mul(LEGEND_LINES) + LEGEND_GAP } else { 0 };
        self.legend_top().saturating_add(legend)
    }

    /// Checks that the fields lie in the ranges given with them.
    ///
    /// # Errors
    /// [`RenderError::Style`] for the first field that does not.
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
        check("caption_lines", 0, 16, self.caption_lines)?;
        check("course_lines", 0, 16, self.course_lines)
    }
}
