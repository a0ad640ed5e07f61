//! Place and scale of an arena in a picture.

use phase_model::{Vec2, arena};

/// Place and scale of the arena in the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct View {
    /// Pixels of a world unit.
    pub scale: f32,
    /// The arena's upper left corner (pixels from the upper left corner of the picture).
    pub corner: Vec2,
}

impl View {
    /// The world point at the centre of a pixel.
    pub(crate) fn point(self, x: usize, y: usize) -> Vec2 {
        self.world(Vec2::new(x as f32 + 0.5, y as f32 + 0.5))
    }

    /// The world point at a place in the picture (pixels).
    pub(crate) fn world(self, pixel: Vec2) -> Vec2 {
        let offset = (pixel - self.corner) / self.scale;
        Vec2::new(arena::MIN.x + offset.x, arena::MAX.y - offset.y)
    }

    /// An arena with the same middle, `by` times as large.
    pub(crate) fn scaled(self, by: f32) -> Self {
        let shrunk = 0.5 * arena::SIDE * self.scale * (1.0 - by);
        Self { scale: self.scale * by, corner: self.corner + Vec2::splat(shrunk) }
    }

    /// The place of a world point (pixels).
    #[must_use]
    pub fn pixel(self, point: Vec2) -> Vec2 {
        self.corner + Vec2::new(point.x - arena::MIN.x, arena::MAX.y - point.y) * self.scale
    }

    /// The pixels of a picture within a distance (u) of a world point, every `stride`-th in both directions.
    pub(crate) fn pixels_within(
        self,
        (width, height): (usize, usize),
        centre: Vec2,
        reach: f32,
        stride: usize,
    ) -> impl Iterator<Item = (usize, usize)> {
        let centre = self.pixel(centre);
        let reach = reach * self.scale;
        let range = |centre: f32, end: usize| {
            let low = (centre - reach).floor().clamp(0.0, end as f32) as usize;
            low..((centre + reach).ceil().clamp(0.0, end as f32) as usize).max(low)
        };
        let columns = range(centre.x, width);
        let near = move |x: usize, y: usize| {
            centre.distance_squared(Vec2::new(x as f32 + 0.5, y as f32 + 0.5)) <= reach * reach
        };
        range(centre.y, height)
            .step_by(stride)
            .flat_map(move |y| columns.clone().step_by(stride).map(move |x| (x, y)))
            .filter(move |&(x, y)| near(x, y))
    }
}
