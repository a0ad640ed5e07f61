//! From rows, which are means over steps, back to the states between steps, with what nobody sees in rows: who
//! holds what and who touches whom.

use phase_evidence::contact;
use phase_model::{
    AGENT_COUNT, Body, Contacts, Entity, Grip, MAX_ENTITIES, ObservedEvent, Physique, Side, State, Vec2,
    arena,
};

/// How far the end of a step lies on the way from its mean to the mean of the next: the mean stands for the third of
/// five substeps, the end is the fifth.
const END_OF_STEP: f32 = 0.4;
/// Substeps from the mean of a step to its end.
const SUBSTEPS_TO_END: f32 = 2.0;
/// An object that is held sits this near to its place on the holder's side (u).
const AT_SIDE: f32 = 0.15;
/// As long as it is held it shifts in the holder's frame by less than this from row to row (u).
const SHIFT: f32 = 0.06;
/// And turns in it by less than this (rad).
const TWIST: f32 = 0.05;
/// Rows for which it must sit like that.
const HELD_ROWS: usize = 3;

/// The state at the end of every step, state 0 being row 0: one for each row. Forces play no part in it.
#[must_use]
pub fn states(observed: &ObservedEvent) -> Vec<State> {
    let physique = observed.physique([0.0; AGENT_COUNT]);
    let rows = observed.rows();
    let grips: [Vec<Option<Grip>>; AGENT_COUNT] = core::array::from_fn(|agent| grips(&physique, rows, agent));
    (0..rows.len())
        .map(|t| {
            let mut state = State::new(bodies(rows, t));
            state.grips = core::array::from_fn(|agent| grips[agent][t]);
            state.contacts = contacts(&physique, &state);
            state
        })
        .collect()
}

fn bodies(rows: &[[Body; MAX_ENTITIES]], t: usize) -> [Body; MAX_ENTITIES] {
    let (mean, next) = (&rows[t], rows.get(t + 1));
    core::array::from_fn(|entity| {
        let body = mean[entity];
        match next {
            _ if t == 0 => body,
            Some(next) => between(&body, &next[entity]),
            None => {
                let seconds = SUBSTEPS_TO_END * arena::SUBSTEP_SECONDS;
                Body { position: body.position + body.velocity * seconds, angular_velocity: 0.0, ..body }
            }
        }
    })
}

fn between(a: &Body, b: &Body) -> Body {
    Body {
        position: a.position.lerp(b.position, END_OF_STEP),
        velocity: a.velocity.lerp(b.velocity, END_OF_STEP),
        angle: a.angle + (b.angle - a.angle) * END_OF_STEP,
        angular_velocity: 0.0,
    }
}

/// Where an object is in an agent's frame, and by how much it is turned in it.
fn relative(row: &[Body; MAX_ENTITIES], agent: usize, object: usize) -> (Vec2, f32) {
    let (holder, held) = (&row[agent], &row[Entity::object(object).index()]);
    let back = Vec2::from_angle(-holder.angle);
    (back.rotate(held.position - holder.position), held.angle - holder.angle)
}

/// What an agent holds at every row. Somebody holds what sits at one of the four places where grabbing puts it and
/// stays there for some rows as though it were nailed on; an object that is only pushed slips.
fn grips(physique: &Physique, rows: &[[Body; MAX_ENTITIES]], agent: usize) -> Vec<Option<Grip>> {
    let mut grips = vec![None; rows.len()];
    for object in physique.objects() {
        let reach = physique.agents[agent].radius + physique.object_radii[object];
        let places: Vec<_> = rows.iter().map(|row| relative(row, agent, object)).collect();
        let side = |(offset, _): &(Vec2, f32)| {
            Side::ALL.into_iter().find(|side| offset.distance(side.direction() * reach) < AT_SIDE)
        };
        let mut from = 0;
        while from < rows.len() {
            let Some(held_by) = side(&places[from]) else {
                from += 1;
                continue;
            };
            let stays = |pair: &[(Vec2, f32)]| {
                side(&pair[1]) == Some(held_by)
                    && pair[0].0.distance(pair[1].0) < SHIFT
                    && libm::remainderf(pair[1].1 - pair[0].1, core::f32::consts::TAU).abs() < TWIST
            };
            let length = 1 + places[from..].windows(2).take_while(|pair| stays(pair)).count();
            if length >= HELD_ROWS {
                let grip = Grip { object: object as u8, side: held_by, relative_angle: places[from].1 };
                grips[from..from + length].fill(Some(grip));
            }
            from += length;
        }
    }
    grips
}

fn contacts(physique: &Physique, state: &State) -> Contacts {
    let mut contacts = Contacts::NONE;
    for b in physique.entities() {
        for a in (0..b.index()).map(Entity::from_index) {
            if contact::near(physique, state, a, b) {
                contacts.insert(a, b);
            }
        }
    }
    contacts
}
