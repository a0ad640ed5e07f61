//! The stage on which an event plays: what does not change, and the frames of what does.

use crate::{
    Caption, Frame, Overlay, RenderError, Style, bodies, overlay,
    painter::{Painter, View},
    text,
};
use phase_model::{Physique, State, Vec2, arena};
use tiny_skia::{Color, Pixmap};

/// Thickness of an inner wall (u); physically walls have none.
const WALL_THICKNESS: f32 = 0.25;
/// Thickness of the boundary, drawn outside the arena so that bodies touch it and do not cover it (u).
const BOUNDARY_THICKNESS: f32 = 2.0 / 22.0;

/// Draws states of one event as frames of one size.
#[derive(Clone, Debug)]
pub struct Stage {
    physique: Physique,
    style: Style,
    /// Landmarks, walls and boundary: drawn once, copied for each frame.
    background: Pixmap,
}

impl Stage {
    /// A stage for the events of one physique.
    ///
    /// # Errors
    /// [`RenderError::Style`] if the style's sizes are out of range; [`Style::default`] never is.
    pub fn new(physique: &Physique, style: Style) -> Result<Self, RenderError> {
        style.validate()?;
        let mut pixmap = Pixmap::new(style.width(), style.height()).ok_or_else(|| RenderError::Style {
            field: "side",
            rule: "a size that fits in memory".into(),
            found: style.side,
        })?;
        let [red, green, blue] = style.palette.background;
        pixmap.fill(Color::from_rgba8(red, green, blue, 255));
        let mut painter = Painter { pixmap, view: View::of(&style) };
        for (centre, colour) in arena::LANDMARKS.into_iter().zip(style.palette.landmarks) {
            let half = Vec2::splat(arena::LANDMARK_HALF_SIDE);
            painter.rectangle(centre - half, centre + half, colour, 255);
        }
        draw_walls(&mut painter, physique, &style);
        Ok(Self { physique: physique.clone(), style, background: painter.pixmap })
    }

    /// Draws a state; with an overlay also what an agent sees and believes of it, and captions.
    ///
    /// Bodies whose pose is not finite, or which lie outside the picture, are left out.
    #[must_use]
    pub fn frame(&self, state: &State, overlay: Option<&Overlay<'_>>) -> Frame {
        let palette = &self.style.palette;
        let mut painter = Painter { pixmap: self.background.clone(), view: View::of(&self.style) };
        if let Some(overlay) = overlay {
            overlay::shade(&mut painter, palette, overlay.visible);
            draw_walls(&mut painter, &self.physique, &self.style);
            overlay::draw_particles(&mut painter, palette, &self.physique, overlay);
        }
        bodies::draw(&mut painter, palette, &self.physique, state);
        if let Some(overlay) = overlay {
            self.write_captions(&mut painter.pixmap, overlay.captions);
        }
        Frame::of(painter.pixmap)
    }

    /// Width of the frames (pixels).
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.style.width()
    }

    /// Height of the frames, captions included (pixels).
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.style.height()
    }

    /// The place of a world point in the frames (pixels from the upper left corner, y down).
    #[must_use]
    pub fn pixel(&self, point: Vec2) -> Vec2 {
        View::of(&self.style).pixel(point)
    }

    fn write_captions(&self, pixmap: &mut Pixmap, captions: &[Caption]) {
        let style = &self.style;
        let (scale, left) = (style.text_scale(), style.margin);
        let full = style.side.saturating_sub(2 * left);
        let mut top = style.side;
        for caption in captions.iter().take(style.caption_lines as usize) {
            // The cast takes what is not a number for nothing. The two dots left free tell bars apart.
            let across = (caption.bar.clamp(0.0, 1.0) * full as f32).round() as u32;
            let down = style.line_height() - 2 * scale;
            text::fill(pixmap, (left, top), (across, down), style.palette.bar);
            text::write(pixmap, (left, top), scale, &caption.text, style.palette.ink);
            top += style.line_height();
        }
    }
}

/// Draws the inner walls and the boundary.
fn draw_walls(painter: &mut Painter, physique: &Physique, style: &Style) {
    let ink = style.palette.ink;
    for (k, &wall) in physique.walls.iter().enumerate() {
        // Where walls meet, each reaches over the other's half, so that the corner is filled; a free end
        // stops where the wall stops, so that doors are as wide as they look.
        let meets = |end: Vec2| {
            let others = physique.walls.iter().enumerate().filter(|(other, _)| *other != k);
            others.into_iter().any(|(_, other)| other.distance(end) == 0.0)
        };
        let along = (wall.b - wall.a).normalize_or_zero() * (0.5 * WALL_THICKNESS);
        let a = if meets(wall.a) { wall.a - along } else { wall.a };
        let b = if meets(wall.b) { wall.b + along } else { wall.b };
        let across = along.perp();
        painter.polygon(&[a - across, b - across, b + across, a + across], ink, 255);
    }
    let square = |grow: f32| {
        let (low, high) = (arena::MIN - Vec2::splat(grow), arena::MAX + Vec2::splat(grow));
        [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)]
    };
    painter.frame(&square(BOUNDARY_THICKNESS), &square(0.0), ink, 255);
}
