//! Shapes in world units on a picture in pixels.

use crate::{Colour, Style};
use phase_model::{Vec2, arena};
use tiny_skia::{Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, Transform};

/// Where the world lies in the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct View {
    /// Pixels per world unit.
    pub(crate) scale: f32,
    /// The arena's upper left corner (pixels).
    pub(crate) corner: f32,
}

impl View {
    pub(crate) fn of(style: &Style) -> Self {
        let inner = style.side.saturating_sub(2 * style.margin);
        Self { scale: inner as f32 / arena::SIDE, corner: style.margin as f32 }
    }

    /// The place of a world point in the picture (pixels, y down).
    pub(crate) fn pixel(self, point: Vec2) -> Vec2 {
        let offset = Vec2::new(point.x - arena::MIN.x, arena::MAX.y - point.y);
        Vec2::splat(self.corner) + offset * self.scale
    }
}

/// A picture being drawn. Shapes with a number that is not finite leave no trace.
pub(crate) struct Painter {
    pub(crate) pixmap: Pixmap,
    pub(crate) view: View,
}

impl Painter {
    /// Fills an axis-aligned rectangle between two corners (u).
    pub(crate) fn rectangle(&mut self, a: Vec2, b: Vec2, colour: Colour, alpha: u8) {
        let (a, b) = (self.view.pixel(a), self.view.pixel(b));
        let (low, high) = (a.min(b), a.max(b));
        if let Some(rectangle) = Rect::from_ltrb(low.x, low.y, high.x, high.y) {
            let path = PathBuilder::from_rect(rectangle);
            self.fill(&path, colour, alpha);
        }
    }

    /// Fills a polygon (u).
    pub(crate) fn polygon(&mut self, corners: &[Vec2], colour: Colour, alpha: u8) {
        if let Some(path) = self.polygon_path(corners) {
            self.fill(&path, colour, alpha);
        }
    }

    /// Draws the edge of a polygon, `width` (u) wide with the edge in the middle.
    pub(crate) fn polygon_edge(&mut self, corners: &[Vec2], width: f32, colour: Colour, alpha: u8) {
        if let Some(path) = self.polygon_path(corners) {
            self.stroke(&path, width, colour, alpha);
        }
    }

    /// Fills a disc (u).
    pub(crate) fn disc(&mut self, centre: Vec2, radius: f32, colour: Colour, alpha: u8) {
        if let Some(path) = self.disc_path(centre, radius) {
            self.fill(&path, colour, alpha);
        }
    }

    /// Draws a circle, `width` (u) wide with the radius in the middle.
    pub(crate) fn circle(&mut self, centre: Vec2, radius: f32, width: f32, colour: Colour, alpha: u8) {
        if let Some(path) = self.disc_path(centre, radius) {
            self.stroke(&path, width, colour, alpha);
        }
    }

    fn polygon_path(&self, corners: &[Vec2]) -> Option<Path> {
        let mut builder = PathBuilder::new();
        for (k, &corner) in corners.iter().enumerate() {
            let Vec2 { x, y } = self.view.pixel(corner);
            if k == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
        }
        builder.close();
        builder.finish()
    }

    fn disc_path(&self, centre: Vec2, radius: f32) -> Option<Path> {
        let Vec2 { x, y } = self.view.pixel(centre);
        PathBuilder::from_circle(x, y, radius * self.view.scale)
    }

    fn fill(&mut self, path: &Path, colour: Colour, alpha: u8) {
        self.pixmap.fill_path(path, &paint(colour, alpha), FillRule::Winding, Transform::identity(), None);
    }

    fn stroke(&mut self, path: &Path, width: f32, colour: Colour, alpha: u8) {
        let stroke =
            Stroke { width: width * self.view.scale, line_join: LineJoin::Miter, ..Stroke::default() };
        self.pixmap.stroke_path(path, &paint(colour, alpha), &stroke, Transform::identity(), None);
    }
}

/// A plain antialiased colour.
fn paint([red, green, blue]: Colour, alpha: u8) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba8(red, green, blue, alpha));
    paint.anti_alias = true;
    paint
}
