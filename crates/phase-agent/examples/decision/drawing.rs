//! Three panels side by side, as SVG.

use core::fmt::Write;
use phase_model::{AgentId, Entity, PhysicsConfig, State, Vec2, arena, geometry::trapezoid};

/// Pixels to the unit.
const SCALE: f32 = 15.0;
/// Width of a panel, with the gap after it, and its top (px).
const PANEL: f32 = 325.0;
const TOP: f32 = 34.0;
/// Height of the picture (px).
const HEIGHT: f32 = 405.0;
/// Spacing of the points at which a distance is evaluated (u), and of contours (u).
const GRID: f32 = 0.25;
const CONTOUR: f32 = 2.0;
/// A cell with a greater difference has a wall in it (u).
const JUMP: f32 = 2.5;
/// Spacing of bars, their thickness and their length for a share of 1 (px).
const ROW: f32 = 24.0;
const BAR: f32 = 8.0;
const FULL: f64 = 220.0;
const AGENTS: [&str; 2] = ["#2e8b57", "#c0392b"];

/// A picture in the making.
pub(crate) struct Drawing<'a> {
    physics: &'a PhysicsConfig,
    svg: String,
    left: f32,
}

impl<'a> Drawing<'a> {
    pub(crate) fn new(physics: &'a PhysicsConfig) -> Self {
        let width = 3.0 * PANEL;
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {HEIGHT}\" \
             font-family=\"DejaVu Sans, sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{HEIGHT}\" fill=\"white\"/>\n"
        );
        Self { physics, svg, left: 0.0 }
    }

    pub(crate) fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }

    /// Begins a panel.
    pub(crate) fn panel(&mut self, index: usize, title: &str) {
        self.left = 12.0 + PANEL * index as f32;
        self.text(self.left, 22.0, "#000", &format!("<tspan font-weight=\"bold\">{title}</tspan>"));
    }

    /// A line of text below the panel.
    pub(crate) fn line(&mut self, index: usize, colour: &str, text: &str) {
        self.text(self.left, TOP + arena::SIDE * SCALE + 20.0 + 18.0 * index as f32, colour, text);
    }

    pub(crate) fn walls(&mut self) {
        let x = self.left;
        let y = TOP;
        let side = arena::SIDE * SCALE;
        self.add(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{side}\" height=\"{side}\" fill=\"none\" stroke=\"#000\"/>"
        ));
        for wall in self.physics.walls.clone() {
            self.polyline(&[wall.a, wall.b], "stroke=\"#000\" stroke-width=\"4\"");
        }
    }

    pub(crate) fn body(&mut self, state: &State, entity: Entity, colour: &str, opacity: f32) {
        let centre = self.pixel(state.position(entity));
        let radius = self.physics.radius(entity) * SCALE;
        self.add(&format!(
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius:.1}\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>",
            centre.x, centre.y
        ));
    }

    pub(crate) fn agents(&mut self, state: &State) {
        for agent in AgentId::ALL {
            let body = state.body(Entity::Agent(agent));
            let turn = Vec2::from_angle(body.angle);
            let corners = trapezoid(self.physics.agents[agent].radius);
            let points = self.points(&corners.map(|corner| body.position + turn.rotate(corner)));
            self.add(&format!("<polygon points=\"{points}\" fill=\"{}\"/>", AGENTS[agent.index()]));
        }
    }

    pub(crate) fn way(&mut self, points: &[Vec2]) {
        self.polyline(points, "stroke=\"#d55e00\" stroke-width=\"3\" stroke-dasharray=\"6 3\"");
    }

    /// Contours of a function on the arena, by marching squares.
    pub(crate) fn contours(&mut self, function: impl Fn(Vec2) -> f32) {
        let count = (arena::SIDE / GRID) as usize;
        let point = |i: usize, k: usize| arena::MIN + (Vec2::new(i as f32, k as f32) + 0.5) * GRID;
        let values: Vec<f32> =
            (0..count * count).map(|cell| function(point(cell % count, cell / count))).collect();
        let mut path = String::new();
        for (i, k) in (0..count - 1).flat_map(|k| (0..count - 1).map(move |i| (i, k))) {
            let corners = [(i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1)];
            let value = corners.map(|(i, k)| values[k * count + i]);
            let low = value.into_iter().fold(f32::INFINITY, f32::min);
            let high = value.into_iter().fold(f32::NEG_INFINITY, f32::max);
            let level = (low / CONTOUR).floor() * CONTOUR + CONTOUR;
            if high - low > JUMP || level > high {
                continue;
            }
            let crossing = |edge: usize| {
                let a = value[edge];
                let b = value[(edge + 1) % 4];
                let [from, to] =
                    [edge, (edge + 1) % 4].map(|corner| point(corners[corner].0, corners[corner].1));
                ((a < level) != (b < level)).then(|| from + (to - from) * ((level - a) / (b - a)))
            };
            let ends: Vec<Vec2> = (0..4).filter_map(crossing).map(|end| self.pixel(end)).collect();
            for pair in ends.chunks_exact(2) {
                // Writing to a string cannot fail.
                let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", pair[0].x, pair[0].y, pair[1].x, pair[1].y);
            }
        }
        self.add(&format!("<path d=\"{path}\" stroke=\"#6b8fb5\" fill=\"none\"/>"));
    }

    /// The prior and the share of visits of an action.
    pub(crate) fn bars(&mut self, row: usize, name: &str, prior: f64, visits: f64) {
        let x = self.left + 75.0;
        let y = TOP + 6.0 + ROW * row as f32;
        self.text(self.left, y + 12.0, "#000", name);
        for (offset, share, colour) in [(0.0, prior, "#b0b0b0"), (BAR, visits, "#0072b2")] {
            let top = y + offset;
            let length = share * FULL;
            self.add(&format!(
                "<rect x=\"{x}\" y=\"{top}\" width=\"{length:.1}\" height=\"{BAR}\" fill=\"{colour}\"/>"
            ));
        }
    }

    fn polyline(&mut self, points: &[Vec2], style: &str) {
        let points = self.points(points);
        self.add(&format!("<polyline points=\"{points}\" fill=\"none\" {style}/>"));
    }

    fn points(&self, points: &[Vec2]) -> String {
        let texts: Vec<String> = points
            .iter()
            .map(|&point| self.pixel(point))
            .map(|pixel| format!("{:.1},{:.1}", pixel.x, pixel.y))
            .collect();
        texts.join(" ")
    }

    fn text(&mut self, x: f32, y: f32, colour: &str, text: &str) {
        self.add(&format!("<text x=\"{x}\" y=\"{y}\" fill=\"{colour}\">{text}</text>"));
    }

    fn pixel(&self, point: Vec2) -> Vec2 {
        let offset = point - arena::MIN;
        Vec2::new(self.left + offset.x * SCALE, TOP + (arena::SIDE - offset.y) * SCALE)
    }

    fn add(&mut self, element: &str) {
        self.svg.push_str(element);
        self.svg.push('\n');
    }
}
