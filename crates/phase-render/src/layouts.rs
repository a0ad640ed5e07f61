//! The chart of all layouts.

use crate::{
    Frame, Palette, RenderError,
    painter::{Painter, View, fill},
    renderer::{draw_landmarks, draw_walls},
    text::{Align, SizedFont},
};
use phase_model::{Flip, Layout, Vec2, arena};
use tiny_skia::{Color, Pixmap};

/// Base layouts in one row of the chart, each as it is and in all mirrors.
const BLOCKS: u32 = 2;
/// Base layouts in all.
const BASES: u32 = 22;
/// Pictures of one base layout.
const VARIANTS: u32 = 1 + Flip::ALL.len() as u32;
/// Side of the arena in a small picture, and the distance from one picture to the next (pixels).
const SIDE: u32 = 100;
const ACROSS: u32 = SIDE + 22;
const DOWN: u32 = SIDE + 26;
/// Room for the number of the layout and the axis on the left of a block (pixels).
const LEFT: u32 = 78;
const BLOCK: u32 = LEFT + VARIANTS * ACROSS;
/// Side of the arena in the large picture, its distance from the left, and the height of the part with it
/// (pixels).
const LARGE_SIDE: u32 = 360;
const LARGE_LEFT: u32 = 60;
const HEADER: u32 = LARGE_SIDE + 90;
/// Top of the first row of small pictures, below its headings (pixels).
const TOP: u32 = HEADER + 28;
const BOTTOM: u32 = 8;
/// Sizes of text (pixels per em).
const TEXT: u32 = 13;
const LABEL: u32 = 11;

/// Headings above the pictures of a block: the layout as it is, then its mirrors in the order of
/// [`Flip::ALL`].
const HEADINGS: [&str; VARIANTS as usize] =
    ["no flip", "flip 0: ↕", "flip 1: ↔", "flip 2: diagonal", "flip 3: antidiagonal"];

/// Lines of text beside the large picture.
const NOTES: [&str; 12] = [
    "The 22 base layouts and their mirrors",
    "",
    "Axes in world units (u): x from 6 to 26 to the right, y from 2 to 22 upwards; grid every 5 u.",
    "Landmarks 0 to 3 are squares of 5 u; each is in the room of the same number.",
    "Walls (black) begin at the centre (16, 12) or at the boundary and are 5, 7.5 or 10 u long.",
    "Layouts 1, 3, 5 and 11 are used by no published event.",
    "",
    "flip 0   mirrored up and down",
    "flip 1   mirrored left and right",
    "flip 2   mirrored about the diagonal y = x − 4",
    "flip 3   mirrored about the antidiagonal y = 28 − x",
    "Landmarks keep their numbers and places; only walls are mirrored.",
];

/// A picture of the 22 base layouts, each as it is and in its four mirrors, with axes (u) and landmark
/// numbers, below a larger one with the landmarks' coordinates.
///
/// # Errors
/// [`RenderError::Font`] if the embedded font cannot be parsed, which a test excludes;
/// [`RenderError::Layout`] if there are fewer than 22 base layouts.
pub fn layout_chart(palette: &Palette) -> Result<Frame, RenderError> {
    let width = BLOCKS * BLOCK;
    let height = TOP + BASES.div_ceil(BLOCKS) * DOWN + BOTTOM;
    let mut pixmap = Pixmap::new(width, height).ok_or(RenderError::Sheet { frames: 110, columns: 10 })?;
    let [red, green, blue] = palette.background;
    pixmap.fill(Color::from_rgba8(red, green, blue, 255));
    let painter = Painter { pixmap, view: View { scale: 1.0, corner: Vec2::ZERO } };
    let text = SizedFont::new(TEXT)?;
    let label = SizedFont::new(LABEL)?;
    let mut chart = Chart { painter, palette: *palette, text, label };
    chart.header()?;
    for base in 0..BASES {
        chart.block(base)?;
    }
    Ok(Frame::of(chart.painter.pixmap))
}

struct Chart {
    painter: Painter,
    palette: Palette,
    text: SizedFont,
    label: SizedFont,
}

impl Chart {
    /// The large picture, the notes beside it and the headings of the columns.
    fn header(&mut self) -> Result<(), RenderError> {
        self.arena(Layout::new(20, None)?, (LARGE_LEFT, 40), LARGE_SIDE, &[6, 11, 16, 21, 26], true);
        self.write("Layout 20", (LARGE_LEFT as f32, 24), Align::Left);
        for (landmark, centre) in arena::LANDMARKS.into_iter().enumerate() {
            let pixel = self.painter.view.pixel(centre);
            let lines = [format!("{landmark}"), format!("({}, {})", centre.x, centre.y)];
            for (line, text) in (0..).zip(&lines) {
                self.write(text, (pixel.x, pixel.y as i32 - 4 + 18 * line), Align::Centre);
            }
        }
        for (line, note) in (0..).zip(NOTES) {
            self.write(note, ((LARGE_LEFT + LARGE_SIDE + 60) as f32, 60 + 24 * line), Align::Left);
        }
        for (block, (variant, heading)) in
            (0..BLOCKS).flat_map(|block| (0..).zip(HEADINGS).map(move |column| (block, column)))
        {
            let x = block * BLOCK + LEFT + variant * ACROSS + SIDE / 2;
            self.label(heading, (x as f32, TOP as i32 - 10), Align::Centre);
        }
        Ok(())
    }

    /// One base layout as it is and in its mirrors.
    fn block(&mut self, base: u32) -> Result<(), RenderError> {
        let left = base % BLOCKS * BLOCK;
        let top = TOP + base / BLOCKS * DOWN;
        let variants = core::iter::once(None).chain(Flip::ALL.map(Some));
        for (variant, flip) in (0..).zip(variants) {
            let corner = (left + LEFT + variant * ACROSS, top);
            self.arena(Layout::new(base as u8, flip)?, corner, SIDE, &[6, 16, 26], variant == 0);
            for (landmark, centre) in arena::LANDMARKS.into_iter().enumerate() {
                let pixel = self.painter.view.pixel(centre);
                self.label(&landmark.to_string(), (pixel.x, pixel.y as i32 + 4), Align::Centre);
            }
        }
        let middle = self.text.baseline(top, SIDE);
        self.write(&base.to_string(), ((left + LEFT - 30) as f32, middle), Align::Right);
        Ok(())
    }

    /// An arena with its grid and axes; `marks` are the numbers along x, and those along y are 4 less.
    fn arena(&mut self, layout: Layout, (left, top): (u32, u32), side: u32, marks: &[i32], y_axis: bool) {
        self.painter.view =
            View { scale: side as f32 / arena::SIDE, corner: Vec2::new(left as f32, top as f32) };
        draw_landmarks(&mut self.painter, &self.palette);
        for step in 1..4 {
            let at = step * side / 4;
            fill(&mut self.painter.pixmap, (left + at, top), (1, side), self.palette.grid);
            fill(&mut self.painter.pixmap, (left, top + at), (side, 1), self.palette.grid);
        }
        draw_walls(&mut self.painter, &layout.walls(), &self.palette);
        for &mark in marks {
            let x = mark as f32;
            let y = (mark - 4) as f32;
            let pixel = self.painter.view.pixel(Vec2::new(x, y));
            self.label(&mark.to_string(), (pixel.x, (top + side) as i32 + 13), Align::Centre);
            if y_axis {
                let place = ((left - 5) as f32, pixel.y as i32 + 4);
                self.label(&(mark - 4).to_string(), place, Align::Right);
            }
        }
    }

    fn write(&mut self, text: &str, place: (f32, i32), align: Align) {
        self.text.draw(&mut self.painter.pixmap, text, place, align, self.palette.ink);
    }

    fn label(&mut self, text: &str, place: (f32, i32), align: Align) {
        self.label.draw(&mut self.painter.pixmap, text, place, align, self.palette.ink);
    }
}
