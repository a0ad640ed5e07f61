//! Shapes in world units on a picture in pixels.

use crate::{Colour, Style};
use phase_model::{Vec2, arena};
use tiny_skia::{Color, FillRule, Paint, Path, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Transform};

/// Placement of the world in the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct View {
    /// Pixels per world unit.
    pub(crate) scale: f32,
    /// The arena's upper left corner (pixels).
    pub(crate) corner: Vec2,
}

impl View {
    pub(crate) fn of(style: &Style) -> Self {
        let inner = style.side.saturating_sub(2 * style.margin);
        let corner = Vec2::new(style.margin as f32, (style.title_height() + style.margin) as f32);
        Self { scale: inner as f32 / arena::SIDE, corner }
    }

    /// The place of a world point in the picture (pixels, y down).
    pub(crate) fn pixel(self, point: Vec2) -> Vec2 {
        let offset = Vec2::new(point.x - arena::MIN.x, arena::MAX.y - point.y);
        self.corner + offset * self.scale
    }

    /// The world point at a place in the picture (pixels, y down).
    pub(crate) fn point(self, pixel: Vec2) -> Vec2 {
        let offset = (pixel - self.corner) / self.scale;
        Vec2::new(arena::MIN.x + offset.x, arena::MAX.y - offset.y)
    }
}

/// A picture being drawn. Shapes with a value that is not finite are not drawn.
pub(crate) struct Painter {
    pub(crate) pixmap: Pixmap,
    pub(crate) view: View,
}

impl Painter {
    /// Fills an axis-aligned rectangle between two corners (u), its edges moved to the nearest pixels, so
    /// that neighbours meet without a seam even where they are translucent.
    pub(crate) fn rectangle(&mut self, a: Vec2, b: Vec2, colour: Colour, alpha: u8) {
        let a = self.view.pixel(a).round();
        let b = self.view.pixel(b).round();
        let low = a.min(b);
        let high = a.max(b);
        if let Some(rectangle) = Rect::from_ltrb(low.x, low.y, high.x, high.y) {
            let mut paint = paint(colour, alpha);
            paint.anti_alias = false;
            self.pixmap.fill_rect(rectangle, &paint, Transform::identity(), None);
        }
    }

    /// Fills a polygon (u).
    pub(crate) fn polygon(&mut self, corners: &[Vec2], colour: Colour, alpha: u8) {
        if let Some(path) = self.polygon_path(corners) {
            self.fill(&path, colour, alpha);
        }
    }

    /// Fills the area between a polygon and a smaller one inside it (u).
    pub(crate) fn frame(&mut self, outer: &[Vec2], inner: &[Vec2], colour: Colour, alpha: u8) {
        if let (Some(outer), Some(inner)) = (self.polygon_path(outer), self.polygon_path(inner)) {
            self.fill_between(&outer, &inner, colour, alpha);
        }
    }

    /// Fills a disc (u).
    pub(crate) fn disc(&mut self, centre: Vec2, radius: f32, colour: Colour, alpha: u8) {
        if let Some(path) = self.disc_path(centre, radius) {
            self.fill(&path, colour, alpha);
        }
    }

    /// Fills the area between two circles around one centre (u).
    pub(crate) fn ring(&mut self, centre: Vec2, outer: f32, inner: f32, colour: Colour, alpha: u8) {
        if let (Some(outer), Some(inner)) = (self.disc_path(centre, outer), self.disc_path(centre, inner)) {
            self.fill_between(&outer, &inner, colour, alpha);
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

    fn fill_between(&mut self, outer: &Path, inner: &Path, colour: Colour, alpha: u8) {
        let mut builder = PathBuilder::new();
        builder.push_path(outer);
        builder.push_path(inner);
        if let Some(path) = builder.finish() {
            let paint = paint(colour, alpha);
            self.pixmap.fill_path(&path, &paint, FillRule::EvenOdd, Transform::identity(), None);
        }
    }
}

/// Fills a rectangle with its upper left corner at a pixel and the given width and height in pixels, as far
/// as it lies in the picture.
pub(crate) fn fill(
    pixmap: &mut Pixmap,
    (left, top): (u32, u32),
    (across, down): (u32, u32),
    [red, green, blue]: Colour,
) {
    let width = pixmap.width();
    let height = pixmap.height();
    let Some(colour) = PremultipliedColorU8::from_rgba(red, green, blue, 255) else { return };
    for y in top..(top + down).min(height) {
        for x in left..(left + across).min(width) {
            pixmap.pixels_mut()[(y * width + x) as usize] = colour;
        }
    }
}

/// A plain antialiased colour.
fn paint([red, green, blue]: Colour, alpha: u8) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba8(red, green, blue, alpha));
    paint.anti_alias = true;
    paint
}
