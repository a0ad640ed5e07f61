//! Text and drawings around a state that is shown as it is: a title, captions, and the course of some shares.

use crate::{Caption, Style, painter::fill, palette::SHARES};
use tiny_skia::Pixmap;

/// The course of some shares of a whole up to now.
#[derive(Clone, Copy, Debug)]
pub struct Course<'a> {
    /// The shares at successive times, each 0 to 1; what they lack to 1 stays white.
    pub shares: &'a [[f32; SHARES]],
    /// Number of times in the whole event, at least as many as there are shares: the course ends there.
    pub times: usize,
}

/// An observer's judgement of a state.
#[derive(Clone, Copy, Debug, Default)]
pub struct Annotation<'a> {
    /// A line above the arena, drawn if [`Style::title`] is set.
    pub title: &'a str,
    /// Lines below the arena. Lines past [`Style::caption_lines`] are left out.
    pub captions: &'a [Caption],
    /// The course, stacked in [`Palette::shares`](crate::Palette::shares) from the bottom up, in the strip
    /// below the captions that is [`Style::course_lines`] high.
    pub course: Option<Course<'a>>,
}

/// Draws a course into its strip, as wide as a line of text.
pub(crate) fn draw_course(pixmap: &mut Pixmap, style: &Style, course: &Course<'_>) {
    let top = style.course_top();
    let height = style.course_height();
    let width = style.text_width();
    let times = course.times.max(course.shares.len()).max(1) as u128;
    // The cast is exact: no time is past the last one.
    let column = |time: usize| (u128::from(width) * time as u128 / times) as u32;
    for (time, shares) in course.shares.iter().enumerate() {
        let left = column(time);
        let right = column(time + 1);
        let mut bottom = top + height;
        let mut sum = 0.0;
        for (share, colour) in shares.iter().zip(style.palette.shares) {
            sum += share.clamp(0.0, 1.0);
            // The cast turns NaN into 0, so that a share which is not a number takes no room.
            let level = top + height - (sum.min(1.0) * height as f32).round() as u32;
            let level = level.min(bottom);
            fill(pixmap, (style.margin + left, level), (right - left, bottom - level), colour);
            bottom = level;
        }
    }
}
