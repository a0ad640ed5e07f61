//! States as arrays of 32-bit floats.

use phase_model::{AGENT_COUNT, Body, Entity, Grip, MAX_ENTITIES, ObjectId, Side, State, Vec2};

/// Numbers of a body: x, y (u), angle (rad), vx, vy (u/s), angular velocity (rad/s).
pub const BODY: usize = 6;
/// Numbers of a grip: the object, or −1 for none; the index of the side in [`Side::ALL`]; the object's angle
/// minus the agent's (rad).
pub const GRIP: usize = 3;
/// Numbers of a state: four bodies, absent objects included, then the grips of both agents.
pub const STATE: usize = MAX_ENTITIES * BODY + AGENT_COUNT * GRIP;

/// Appends a state, [`STATE`] numbers.
pub fn push(state: &State, out: &mut Vec<f32>) {
    for Body { position, angle, velocity, angular_velocity } in &state.bodies {
        out.extend([position.x, position.y, *angle, velocity.x, velocity.y, *angular_velocity]);
    }
    for grip in &state.grips {
        out.extend(grip.map_or([-1.0, 0.0, 0.0], |Grip { object, side, relative_angle }| {
            let side = Side::ALL.iter().position(|it| *it == side).unwrap_or_default();
            [object.index() as f32, side as f32, relative_angle]
        }));
    }
}

/// The states of an array; what is left over is ignored.
pub fn states(numbers: &[f32]) -> impl Iterator<Item = State> {
    numbers.chunks_exact(STATE).map(|numbers| {
        let (bodies, grips) = numbers.split_at(MAX_ENTITIES * BODY);
        let mut state = State::new([Body::default(); MAX_ENTITIES]);
        for (entity, body) in Entity::ALL.into_iter().zip(bodies.chunks_exact(BODY)) {
            *state.body_mut(entity) = Body {
                position: Vec2::new(body[0], body[1]),
                angle: body[2],
                velocity: Vec2::new(body[3], body[4]),
                angular_velocity: body[5],
            };
        }
        for (grip, numbers) in state.grips.iter_mut().zip(grips.chunks_exact(GRIP)) {
            let index = |number: f32| (number >= 0.0).then_some(number as usize);
            let object = index(numbers[0]).and_then(|index| ObjectId::ALL.get(index)).copied();
            let side = index(numbers[1]).and_then(|index| Side::ALL.get(index)).copied();
            *grip = object.zip(side).map(|(object, side)| Grip { object, side, relative_angle: numbers[2] });
        }
        state
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_come_back() {
        let mut state = State::new([Body::at_rest(Vec2::new(7.0, 9.5), 0.25); MAX_ENTITIES]);
        state.bodies[2].velocity = Vec2::new(-1.0, 2.0);
        state.grips[1] = Some(Grip { object: ObjectId::ALL[1], side: Side::Right, relative_angle: -0.5 });
        let mut numbers = Vec::new();
        push(&state, &mut numbers);
        push(&state, &mut numbers);
        assert_eq!(numbers.len(), 2 * STATE);
        assert!(states(&numbers).all(|read| read == state));
        // Whatever numbers there are, there is a state.
        assert_eq!(states(&[f32::NAN; STATE + 3]).count(), 1);
    }
}
