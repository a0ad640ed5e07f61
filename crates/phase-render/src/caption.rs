//! Lines of text and numbers below the arena.

use crate::{
    Style,
    painter::fill,
    text::{Align, SizedFont},
};
use tiny_skia::Pixmap;

/// One line below the arena.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Caption {
    /// Numbers or headings before the text, each right-aligned in a column [`Style::cell_width`] wide, so
    /// that numbers of successive lines stand below one another. Characters that the font lacks become an
    /// empty box.
    pub cells: Vec<String>,
    /// Text behind the cells. An ellipsis replaces the part that does not fit within [`Style::text_width`].
    pub text: String,
    /// A pale bar below the text, as a share of the arena's width: 0 or less for none, 1 for all of it.
    pub bar: f32,
}

impl From<String> for Caption {
    /// A line of text alone.
    fn from(text: String) -> Self {
        Self { cells: Vec::new(), text, bar: 0.0 }
    }
}

/// Draws as many captions as the style has lines for.
pub(crate) fn draw(pixmap: &mut Pixmap, style: &Style, font: &SizedFont, captions: &[Caption]) {
    let height = style.line_height();
    let width = style.text_width();
    let mut top = style.caption_top();
    for caption in captions.iter().take(style.caption_lines as usize) {
        // The cast turns NaN into 0. Text stands on its bar, whose end would otherwise run through it; the
        // two rows below are free.
        let bar = (caption.bar.clamp(0.0, 1.0) * width as f32).round() as u32;
        let thickness = (height / 5).max(2);
        let bar_top = top + height - 2 - thickness;
        fill(pixmap, (style.margin, bar_top), (bar, thickness), style.palette.bar);
        draw_line(pixmap, style, font, font.baseline(top, height - 2), caption);
        top += height;
    }
}

fn draw_line(pixmap: &mut Pixmap, style: &Style, font: &SizedFont, baseline: i32, caption: &Caption) {
    let gap = 0.5 * style.text_size() as f32;
    let cell = style.cell_width() as f32;
    let end = (style.margin + style.text_width()) as f32;
    let mut left = style.margin as f32;
    for text in &caption.cells {
        let cell = cell.min(end - left);
        let text = font.clip(text, cell);
        left += cell;
        font.draw(pixmap, &text, (left, baseline), Align::Right, style.palette.ink);
    }
    if !caption.cells.is_empty() {
        left += gap;
    }
    let text = font.clip(&caption.text, end - left);
    font.draw(pixmap, &text, (left, baseline), Align::Left, style.palette.ink);
}
