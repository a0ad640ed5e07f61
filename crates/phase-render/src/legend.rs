//! The legend: the meaning of the marks of an overlay.

use crate::{
    Colour, Style,
    bodies::{self, GRIP_BAR, GRIP_RIM},
    overlay::{SEEN, UNSEEN},
    painter::{Painter, fill},
    style::LEGEND_LINES,
    text::{Align, SizedFont},
};
use phase_model::Vec2;

/// Entries in one line.
const COLUMNS: u32 = 3;

/// Something drawn in an overlay or in the lines below it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mark {
    /// Cells that the agent sees, tinted.
    Seen,
    /// Cells that the agent does not see, covered.
    Unseen,
    /// The grip of an agent on an object.
    Grip,
    /// Bodies where they are.
    TrueState,
    /// Bodies where the agent's particles have them.
    Particles,
    /// The bar behind a caption.
    Share,
}

/// The marks in the order of the legend, with the text beside each.
pub const ENTRIES: [(Mark, &str); (LEGEND_LINES * COLUMNS) as usize] = [
    (Mark::Seen, "field of view"),
    (Mark::TrueState, "true state"),
    (Mark::Grip, "grip"),
    (Mark::Unseen, "out of view"),
    (Mark::Particles, "particles"),
    (Mark::Share, "share (bar)"),
];

/// A sample of a mark: its upper left corner and its size (pixels).
struct Sample {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
}

/// Draws the legend; without captions it has no bars to explain.
pub(crate) fn draw(painter: &mut Painter, style: &Style, font: &SizedFont) {
    let line = style.line_height();
    let entries = ENTRIES.into_iter().filter(|(mark, _)| *mark != Mark::Share || style.caption_lines > 0);
    for (k, (mark, label)) in (0..).zip(entries) {
        let sample = Sample {
            left: style.margin + k % COLUMNS * (style.text_width() / COLUMNS),
            top: style.legend_top() + k / COLUMNS * line + 1,
            width: 5 * line / 4,
            height: line.saturating_sub(4),
        };
        draw_sample(painter, style, mark, &sample);
        let left = sample.left + sample.width + style.text_size() / 2;
        // Small pictures have room for the samples alone.
        let room = (style.text_width() / COLUMNS).saturating_sub(left - sample.left);
        let place = (left as f32, font.baseline(sample.top, sample.height));
        font.draw(&mut painter.pixmap, &font.clip(label, room as f32), place, Align::Left, style.palette.ink);
    }
}

fn draw_sample(painter: &mut Painter, style: &Style, mark: Mark, sample: &Sample) {
    let palette = &style.palette;
    let Sample { left, top, width, height } = *sample;
    let corner = Vec2::new(left as f32, top as f32);
    let size = Vec2::new(width as f32, height as f32);
    let view = painter.view;
    let at = |share: f32| view.point(corner + size * Vec2::new(share, 0.5));
    // A pixel of room above and below.
    let radius = (0.5 * size.y - 1.0) / view.scale;
    match mark {
        Mark::Seen => framed(painter, style, sample, palette.seen, SEEN),
        Mark::Unseen => framed(painter, style, sample, palette.unseen, UNSEEN),
        Mark::Share => fill(&mut painter.pixmap, (left, top), (width, height), palette.bar),
        Mark::TrueState => {
            let first = at(0.25);
            let second = at(0.75);
            bodies::draw_disc(painter, palette, first, radius, palette.objects[0]);
            bodies::draw_disc(painter, palette, second, radius, palette.objects[1]);
        }
        Mark::Particles => {
            for share in [0.25, 0.36, 0.43, 0.47, 0.5, 0.52, 0.6, 0.75] {
                bodies::draw_believed_disc(painter, at(share), radius, palette.objects[0]);
            }
        }
        Mark::Grip => {
            let centre = at(0.5);
            let scale = 0.5 * size.x / GRIP_RIM.x / view.scale;
            let mut bar = |half: Vec2, colour| {
                let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
                painter.polygon(&corners.map(|sign| centre + half * scale * Vec2::from(sign)), colour, 255);
            };
            bar(GRIP_RIM, palette.agents[0]);
            bar(GRIP_BAR, palette.outline);
        }
    }
}

/// A rectangle of background under a translucent colour, as cells of the arena are, with a thin frame.
fn framed(painter: &mut Painter, style: &Style, sample: &Sample, colour: Colour, alpha: u8) {
    let Sample { left, top, width, height } = *sample;
    fill(&mut painter.pixmap, (left, top), (width, height), style.palette.grid);
    fill(&mut painter.pixmap, (left + 1, top + 1), (width - 2, height - 2), style.palette.background);
    let low = Vec2::new((left + 1) as f32, (top + 1) as f32);
    let high = Vec2::new((left + width - 1) as f32, (top + height - 1) as f32);
    painter.rectangle(painter.view.point(low), painter.view.point(high), colour, alpha);
}
