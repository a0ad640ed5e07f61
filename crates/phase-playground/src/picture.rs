//! Pictures of a scene, as the videos have them.

use crate::{packed, scenes, sentence};
use phase_model::AgentId;
use phase_perception::{Cell, CellSet};
use phase_render::{Overlay, PaletteName, SceneRenderer, Style};

/// Draws states of one scene.
#[derive(Debug)]
pub struct Picture {
    stage: SceneRenderer,
    /// The stage with what an agent sees and believes.
    backdrop: Option<SceneRenderer>,
}

impl Picture {
    /// Pictures of so many pixels a side, in the colours of a palette (`paper` or `accessible`).
    ///
    /// # Errors
    /// A sentence for an invalid scene, an unknown palette, or a side that is out of range.
    pub fn new(scene: &str, side: u32, palette: &str) -> Result<Self, String> {
        let physics = scenes::read(scene)?.physics();
        let named = PaletteName::ALL.into_iter().find(|it| it.name() == palette);
        let palette = named.ok_or("there is no such palette")?.palette();
        let style = Style { palette, ..Style::with_side(side) };
        Ok(Self { stage: SceneRenderer::new(&physics, style).map_err(sentence)?, backdrop: None })
    }

    /// Width and height (pixels).
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        [self.stage.width(), self.stage.height()]
    }

    /// Draws an agent's view (`view`, as of [`PageSimulation::view`](crate::PageSimulation::view)) and belief
    /// (`belief`, packed states) over the states to come.
    pub fn show_mind(&mut self, agent: AgentId, view: &[u8], belief: &[f32]) {
        let particles: Vec<_> = packed::states(belief).collect();
        let mut visible = CellSet::EMPTY;
        for (cell, _) in Cell::all().zip(view).filter(|(_, seen)| **seen != 0) {
            visible.insert(cell);
        }
        let overlay = Overlay { agent, visible: &visible, particles: &particles, title: "", captions: &[] };
        self.backdrop = Some(self.stage.with_backdrop(&overlay));
    }

    /// Shows nobody's mind from now on.
    pub fn hide_mind(&mut self) {
        self.backdrop = None;
    }

    /// Draws a packed state: red, green, blue and opacity of each pixel, row by row from the top.
    ///
    /// # Errors
    /// If the state is missing.
    pub fn draw(&self, state: &[f32]) -> Result<Vec<u8>, String> {
        let state = packed::states(state).next().ok_or("the state is missing")?;
        let stage = self.backdrop.as_ref().unwrap_or(&self.stage);
        Ok(stage.frame(&state, None).rgba().to_vec())
    }

    /// The place of a world point in the pictures (pixels from the upper left corner, y down).
    #[must_use]
    pub fn pixel(&self, x: f32, y: f32) -> [f32; 2] {
        self.stage.pixel(phase_model::Vec2::new(x, y)).to_array()
    }
}
