//! An agent's view and beliefs, drawn over the true state.

use crate::{Caption, Palette, bodies, painter::Painter};
use phase_model::{AgentId, Entity, PhysicsConfig, State, Vec2};
use phase_perception::{Cell, CellSet};

/// One agent's view of the world at the moment of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Overlay<'a> {
    /// The agent whose view is drawn. The agent knows its own state, so its own body is not drawn as a
    /// belief.
    pub agent: AgentId,
    /// The cells in the agent's field of view; the others are dimmed.
    pub visible: &'a CellSet,
    /// The agent's belief particles, each drawn translucent; where many agree the picture becomes opaque.
    pub particles: &'a [State],
    /// A line above the arena, drawn if [`crate::Style::title`] is set.
    pub title: &'a str,
    /// Lines below the arena, such as the subgoal and its value. Lines past [`crate::Style::caption_lines`]
    /// are left out.
    pub captions: &'a [Caption],
}

/// Opacity of the cover over cells out of sight, and of the tint of cells in sight.
pub(crate) const UNSEEN: u8 = 120;
pub(crate) const SEEN: u8 = 45;

/// Covers the cells out of sight and tints those in sight.
pub(crate) fn shade(painter: &mut Painter, palette: &Palette, visible: &CellSet) {
    for cell in Cell::all() {
        let (colour, alpha) =
            if visible.contains(cell) { (palette.seen, SEEN) } else { (palette.unseen, UNSEEN) };
        let corner = cell.min();
        painter.rectangle(corner, corner + Vec2::ONE, colour, alpha);
    }
}

/// Draws the particles' bodies, except the agent's own.
pub(crate) fn draw_particles(
    painter: &mut Painter,
    palette: &Palette,
    physics: &PhysicsConfig,
    overlay: &Overlay<'_>,
) {
    let own = |entity| entity == Entity::Agent(overlay.agent);
    for particle in overlay.particles {
        for entity in bodies::entities(physics).filter(|&entity| !own(entity)) {
            bodies::draw_believed(painter, palette, physics, entity, particle.body(entity));
        }
    }
}
