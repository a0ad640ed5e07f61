//! The renderer of an event: a background that stays, and frames of the bodies that move.

use crate::{
    Annotation, Frame, Overlay, Palette, RenderError, Style,
    annotation::draw_course,
    bodies, caption, legend, overlay,
    painter::{Painter, View},
    text::{Align, SizedFont},
};
use phase_model::{PhysicsConfig, Segment, State, Vec2, arena};
use tiny_skia::{Color, Pixmap};

/// Thickness of an inner wall (u); physically walls have none.
const WALL_THICKNESS: f32 = 0.25;
/// Thickness of the boundary, drawn outside the arena so that bodies touch it and do not cover it (u).
const BOUNDARY_THICKNESS: f32 = 2.0 / 22.0;

/// Draws states of one event as frames of one size.
#[derive(Clone, Debug)]
pub struct SceneRenderer {
    physics: PhysicsConfig,
    style: Style,
    font: SizedFont,
    /// Landmarks, walls, boundary and legend: drawn once, copied for each frame.
    background: Pixmap,
}

impl SceneRenderer {
    /// A renderer for the events of one physique.
    ///
    /// # Errors
    /// [`RenderError::Style`] if the style's sizes are out of range; [`Style::default`] never is.
    /// [`RenderError::Font`] if the embedded font cannot be parsed, which a test excludes.
    pub fn new(physics: &PhysicsConfig, style: Style) -> Result<Self, RenderError> {
        style.validate()?;
        let mut pixmap = Pixmap::new(style.width(), style.height()).ok_or_else(|| RenderError::Style {
            field: "side",
            rule: "a size that fits in memory".into(),
            found: style.side,
        })?;
        let [red, green, blue] = style.palette.background;
        pixmap.fill(Color::from_rgba8(red, green, blue, 255));
        let mut painter = Painter { pixmap, view: View::of(&style) };
        draw_landmarks(&mut painter, &style.palette);
        draw_walls(&mut painter, &physics.walls, &style.palette);
        let font = SizedFont::new(style.text_size())?;
        if style.legend {
            legend::draw(&mut painter, &style, &font);
        }
        Ok(Self { physics: physics.clone(), style, font, background: painter.pixmap })
    }

    /// Draws a state; with an overlay also an agent's view and beliefs, the title and captions.
    ///
    /// Bodies whose pose is not finite, or which lie outside the picture, are left out.
    #[must_use]
    pub fn frame(&self, state: &State, overlay: Option<&Overlay<'_>>) -> Frame {
        let mut painter = Painter { pixmap: self.background.clone(), view: View::of(&self.style) };
        if let Some(overlay) = overlay {
            self.draw_overlay(&mut painter, overlay);
        }
        bodies::draw(&mut painter, &self.style, &self.physics, state);
        if let Some(overlay) = overlay {
            self.draw_title(&mut painter.pixmap, overlay.title);
            caption::draw(&mut painter.pixmap, &self.style, &self.font, overlay.captions);
        }
        Frame::of(painter.pixmap)
    }

    /// A renderer with an agent's view and beliefs, but no title and captions, drawn into its background. Its
    /// frames are those that [`frame`](Self::frame) draws with the overlay, at the cost of frames without.
    /// Useful for the frames of one step, in which view and beliefs do not change.
    #[must_use]
    pub fn with_backdrop(&self, overlay: &Overlay<'_>) -> Self {
        let mut painter = Painter { pixmap: self.background.clone(), view: View::of(&self.style) };
        self.draw_overlay(&mut painter, overlay);
        Self { background: painter.pixmap, ..self.clone() }
    }

    fn draw_overlay(&self, painter: &mut Painter, overlay: &Overlay<'_>) {
        let palette = &self.style.palette;
        overlay::shade(painter, palette, overlay.visible);
        draw_walls(painter, &self.physics.walls, palette);
        overlay::draw_particles(painter, palette, &self.physics, overlay);
    }

    /// Draws a state with a title, captions and a course around it.
    #[must_use]
    pub fn annotated(&self, state: &State, annotation: &Annotation<'_>) -> Frame {
        let mut painter = Painter { pixmap: self.background.clone(), view: View::of(&self.style) };
        bodies::draw(&mut painter, &self.style, &self.physics, state);
        self.draw_title(&mut painter.pixmap, annotation.title);
        caption::draw(&mut painter.pixmap, &self.style, &self.font, annotation.captions);
        if let Some(course) = &annotation.course {
            draw_course(&mut painter.pixmap, &self.style, course);
        }
        Frame::of(painter.pixmap)
    }

    /// Width of the frames (pixels).
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.style.width()
    }

    /// Height of the frames, title, legend and captions included (pixels).
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.style.height()
    }

    /// The place of a world point in the frames (pixels from the upper left corner, y down).
    #[must_use]
    pub fn pixel(&self, point: Vec2) -> Vec2 {
        View::of(&self.style).pixel(point)
    }

    fn draw_title(&self, pixmap: &mut Pixmap, title: &str) {
        let style = &self.style;
        if style.title {
            let title = self.font.clip(title, style.text_width() as f32);
            // The margin above the arena is room enough below the title.
            let baseline = self.font.baseline(style.margin / 2, style.title_height());
            let place = (style.margin as f32, baseline);
            self.font.draw(pixmap, &title, place, Align::Left, style.palette.ink);
        }
    }
}

/// Draws the landmarks.
pub(crate) fn draw_landmarks(painter: &mut Painter, palette: &Palette) {
    for (centre, colour) in arena::LANDMARKS.into_iter().zip(palette.landmarks) {
        let half = Vec2::splat(arena::LANDMARK_HALF_SIDE);
        painter.rectangle(centre - half, centre + half, colour, 255);
    }
}

/// Draws the inner walls and the boundary.
pub(crate) fn draw_walls(painter: &mut Painter, walls: &[Segment], palette: &Palette) {
    let ink = palette.ink;
    for (k, &wall) in walls.iter().enumerate() {
        // Where walls meet, each reaches over the other's half, so that the corner is filled; a free end
        // stops where the wall stops, so that doors are as wide as they look.
        let meets = |end: Vec2| {
            let others = walls.iter().enumerate().filter(|(other, _)| *other != k);
            others.into_iter().any(|(_, other)| other.distance(end) == 0.0)
        };
        let along = (wall.b - wall.a).normalize_or_zero() * (0.5 * WALL_THICKNESS);
        let a = if meets(wall.a) { wall.a - along } else { wall.a };
        let b = if meets(wall.b) { wall.b + along } else { wall.b };
        let across = along.perp();
        painter.polygon(&[a - across, b - across, b + across, a + across], ink, 255);
    }
    let square = |grow: f32| {
        let low = arena::MIN - Vec2::splat(grow);
        let high = arena::MAX + Vec2::splat(grow);
        [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)]
    };
    painter.frame(&square(BOUNDARY_THICKNESS), &square(0.0), ink, 255);
}
