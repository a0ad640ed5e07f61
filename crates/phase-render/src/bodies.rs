//! Agents and objects, solid or as a faint belief.

use crate::{Colour, Palette, Style, painter::Painter};
use phase_model::{AgentId, Body, Entity, PhysicsConfig, State, Vec2, geometry};

/// Width of the outline of a body, all of it inside the body's shape (u).
const OUTLINE: f32 = 0.09;
/// Opacity of one believed body's inside and edge; many on top of one another become solid.
const BELIEF_FILL: u8 = 26;
const BELIEF_EDGE: u8 = 90;

/// Eyes in the agent's frame as multiples of its radius: sideways and forward of the origin.
const EYE: Vec2 = Vec2::new(0.5, 0.5);
const EYE_RIM: f32 = 0.335;
const EYE_WHITE: f32 = 0.291;
/// The pupil lies ahead of the eye's centre, which makes the agent look where it goes.
const PUPIL: Vec2 = Vec2::new(0.5, 0.7);
const PUPIL_RADIUS: f32 = 0.224;

/// Half length and half depth of a grip's bar and of the rim around it, as multiples of the agent's radius.
pub(crate) const GRIP_BAR: Vec2 = Vec2::new(0.40, 0.09);
pub(crate) const GRIP_RIM: Vec2 = Vec2::new(0.48, 0.16);

/// The entities of a physique in the order in which they are drawn, at most what a state can hold.
pub(crate) fn entities(physics: &PhysicsConfig) -> impl Iterator<Item = Entity> + use<> {
    physics.entities()
}

/// Draws all bodies of a state: agents, objects on top, and, unless the style is without, a mark at each
/// grip.
pub(crate) fn draw(painter: &mut Painter, style: &Style, physics: &PhysicsConfig, state: &State) {
    let palette = &style.palette;
    for entity in entities(physics) {
        let body = state.body(entity);
        let radius = physics.radius(entity);
        match entity {
            Entity::Agent(agent) => draw_agent(painter, palette, agent, radius, body),
            Entity::Object(object) => {
                let colour = palette.objects[object];
                draw_disc(painter, palette, body.position, radius, colour);
            }
        }
    }
    for agent in AgentId::ALL.into_iter().filter(|_| style.grips) {
        draw_grip(painter, palette, physics, state, agent);
    }
}

/// Draws one body faintly, as believed rather than known.
pub(crate) fn draw_believed(
    painter: &mut Painter,
    palette: &Palette,
    physics: &PhysicsConfig,
    entity: Entity,
    body: &Body,
) {
    let radius = physics.radius(entity);
    match entity {
        Entity::Agent(agent) => {
            let colour = palette.agents[agent];
            let outer = corners(body, radius, 0.0);
            let inner = corners(body, radius, OUTLINE);
            painter.polygon(&inner, colour, BELIEF_FILL);
            painter.frame(&outer, &inner, colour, BELIEF_EDGE);
        }
        Entity::Object(object) => {
            let colour = palette.objects[object];
            draw_believed_disc(painter, body.position, radius, colour);
        }
    }
}

/// A disc with an outline, as objects are drawn.
pub(crate) fn draw_disc(painter: &mut Painter, palette: &Palette, centre: Vec2, radius: f32, colour: Colour) {
    painter.disc(centre, radius, palette.outline, 255);
    painter.disc(centre, radius - OUTLINE, colour, 255);
}

/// A faint disc, as believed objects are drawn.
pub(crate) fn draw_believed_disc(painter: &mut Painter, centre: Vec2, radius: f32, colour: Colour) {
    painter.disc(centre, radius - OUTLINE, colour, BELIEF_FILL);
    painter.ring(centre, radius, radius - OUTLINE, colour, BELIEF_EDGE);
}

fn draw_agent(painter: &mut Painter, palette: &Palette, agent: AgentId, radius: f32, body: &Body) {
    painter.polygon(&corners(body, radius, 0.0), palette.outline, 255);
    painter.polygon(&corners(body, radius, OUTLINE), palette.agents[agent], 255);
    let place = placement(body, radius);
    for side in [Vec2::new(-1.0, 1.0), Vec2::ONE] {
        painter.disc(place(EYE * side), EYE_RIM * radius, [0, 0, 0], 255);
        painter.disc(place(EYE * side), EYE_WHITE * radius, [255, 255, 255], 255);
        painter.disc(place(PUPIL * side), PUPIL_RADIUS * radius, [0, 0, 0], 255);
    }
}

/// A dark bar with a rim in the agent's colour, where the agent's side meets the object it holds.
fn draw_grip(
    painter: &mut Painter,
    palette: &Palette,
    physics: &PhysicsConfig,
    state: &State,
    agent: AgentId,
) {
    let Some(grip) = state.grips[agent] else { return };
    if grip.object.index() >= physics.object_count {
        return;
    }
    let along = grip.side.direction();
    let place = placement(state.body(Entity::Agent(agent)), physics.agents[agent].radius);
    let bar = |length: f32, depth: f32| {
        [(-length, -depth), (length, -depth), (length, depth), (-length, depth)]
            .map(|(across, deep)| place(along * (1.0 + deep) + along.perp() * across))
    };
    painter.polygon(&bar(GRIP_RIM.x, GRIP_RIM.y), palette.agents[agent], 255);
    painter.polygon(&bar(GRIP_BAR.x, GRIP_BAR.y), palette.outline, 255);
}

/// From the agent's frame in multiples of its radius to the world.
fn placement(body: &Body, radius: f32) -> impl Fn(Vec2) -> Vec2 {
    let origin = body.position;
    let rotation = Vec2::from_angle(body.angle);
    move |point| origin + rotation.rotate(point * radius)
}

/// An agent's corners in the world, each edge moved inwards by `inset` (u).
fn corners(body: &Body, radius: f32, inset: f32) -> [Vec2; 4] {
    // A flank leans by 1 in 2, so moving it in by `inset` moves it sideways by √5/2 times that, and each
    // corner also slides along its flank as the base rises and the top sinks.
    let sideways = 0.5 * 5.0_f32.sqrt() * inset;
    let rotation = Vec2::from_angle(body.angle);
    geometry::trapezoid(radius).map(|corner| {
        let inward = Vec2::new(
            -corner.x.signum() * (sideways - 0.5 * corner.y.signum() * inset),
            -corner.y.signum() * inset,
        );
        body.position + rotation.rotate(corner + inward)
    })
}
