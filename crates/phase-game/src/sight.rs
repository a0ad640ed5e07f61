//! Pictures for players, with nothing in them that the player's agent does not observe.

use crate::{
    Instructions, View,
    message::{Colours, SeenGrip, Sight, Stage},
};
use phase_event::pairs_in_contact;
use phase_model::{AgentId, Entity, PhysicsConfig, Scene, State, arena};
use phase_perception::{
    CellSet,
    cells::{CELL_COUNT, Cell},
    observe,
};
use phase_render::{Colour, Palette};

/// The message of everything that an agent's player sees of the frames since the last one. `states` are the
/// states of these frames, at least one.
#[must_use]
pub(crate) fn sight(
    physics: &PhysicsConfig,
    states: &[State],
    step: usize,
    agent: AgentId,
    view: View,
) -> Sight {
    let last = states.last().copied().unwrap_or_else(|| State::new(Default::default()));
    let observation = observe(physics, &last, agent);
    let seen = |entity: Entity| view == View::All || observation.observed.contains(entity);
    let frames = states.iter().map(|state| {
        let now = observe(physics, state, agent).observed;
        let shown = physics.entities().map(|entity| {
            let body = state.body(entity);
            let shown = view == View::All || now.contains(entity);
            shown.then(|| [body.position.x, body.position.y, body.angle].map(rounded))
        });
        shown.collect()
    });
    let bodies = physics.entities().map(|entity| {
        let body = last.body(entity);
        let numbers = [
            body.position.x,
            body.position.y,
            body.angle,
            body.velocity.x,
            body.velocity.y,
            body.angular_velocity,
        ];
        seen(entity).then(|| numbers.map(rounded))
    });
    let grip = |who: AgentId| {
        // Whoever sees a holder sees what it holds.
        let grip = last.grips[who].filter(|_| seen(Entity::Agent(who)))?;
        let side = grip.side.direction().to_array();
        Some(SeenGrip { object: grip.object.index(), side, angle: grip.relative_angle })
    };
    let touching = |pair: &[usize; 2]| pair.iter().all(|&index| seen(Entity::ALL[index]));
    Sight {
        step,
        frames: frames.collect(),
        bodies: bodies.collect(),
        grips: AgentId::ALL.map(grip),
        contacts: pairs_in_contact(&last).into_iter().filter(touching).collect(),
        visible: (view == View::Own).then(|| digits(&observation.visible)),
    }
}

/// The message that opens a round: everything that does not change while it is played.
#[must_use]
pub(crate) fn stage(
    scene: &Scene,
    round: usize,
    rounds: usize,
    steps: usize,
    instructions: Option<Instructions>,
) -> Stage {
    let physics = scene.physics();
    let palette = Palette::PAPER;
    let hex = |[red, green, blue]: Colour| format!("#{red:02x}{green:02x}{blue:02x}");
    Stage {
        round,
        rounds,
        steps,
        instructions,
        walls: physics.walls.iter().map(|wall| [wall.a.to_array(), wall.b.to_array()]).collect(),
        landmarks: arena::LANDMARKS.iter().map(|centre| centre.to_array()).collect(),
        radii: physics.entities().map(|entity| physics.radius(entity)).collect(),
        colours: Colours {
            agents: palette.agents.map(hex).to_vec(),
            objects: palette.objects.map(hex).to_vec(),
            landmarks: palette.landmarks.map(hex).to_vec(),
        },
    }
}

/// Thousandths are finer than a pixel.
fn rounded(number: f32) -> f64 {
    (f64::from(number) * 1e3).round_ties_even() / 1e3
}

/// A set of cells as hexadecimal digits, four cells a digit.
fn digits(cells: &CellSet) -> String {
    let bit = |index: usize| u32::from(Cell::from_index(index).is_some_and(|cell| cells.contains(cell)));
    let digit = |k: usize| (0..4).map(|b| bit(4 * k + b) << b).sum::<u32>();
    (0..CELL_COUNT / 4).filter_map(|k| char::from_digit(digit(k), 16)).collect()
}
