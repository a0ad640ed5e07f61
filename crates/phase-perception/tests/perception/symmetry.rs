//! Observations are invariant under reflection.

use crate::{
    common::{any_physique, any_state},
    oracle::least_margin,
};
use phase_model::{AgentId, Body, Flip, PhysicsConfig, Segment, State};
use phase_perception::{Cell, CellSet, field_of_view, footprint, observed_set};
use proptest::prelude::*;

fn mirrored(flip: Flip, physics: &PhysicsConfig, state: &State) -> (PhysicsConfig, State) {
    let mut physics = physics.clone();
    for wall in &mut physics.walls {
        *wall = Segment { a: flip.point(wall.a), b: flip.point(wall.b) };
    }
    let mut state = *state;
    state.bodies = state.bodies.map(|body| Body {
        position: flip.point(body.position),
        velocity: flip.vector(body.velocity),
        angle: flip.angle(body.angle),
        angular_velocity: -body.angular_velocity,
    });
    (physics, state)
}

fn image(flip: Flip, cells: &CellSet) -> CellSet {
    cells.iter().filter_map(|cell| Cell::at(flip.point(cell.centre()))).collect()
}

/// Whether slightly smaller or larger bodies would lie on other cells.
fn is_on_the_line(physics: &PhysicsConfig, state: &State) -> bool {
    let cells = |grown: f32| -> Vec<CellSet> {
        let mut physics = physics.clone();
        physics.agents.iter_mut().for_each(|agent| agent.radius += grown);
        physics.object_radii.iter_mut().for_each(|radius| *radius += grown);
        physics.entities().map(|entity| footprint(&physics, entity, state.body(entity))).collect()
    };
    cells(-1e-4) != cells(1e-4)
}

proptest! {
    #[test]
    fn mirrored_states_show_mirrored_cells_and_the_same_entities(
        physics in any_physique(), state in any_state(), agent in 0_usize..2,
    ) {
        prop_assume!(least_margin(&physics, &state, agent).abs() > 1e-4);
        prop_assume!(!is_on_the_line(&physics, &state));
        let visible = field_of_view(&physics, &state, AgentId::ALL[agent]);
        let observed = observed_set(&physics, &state, AgentId::ALL[agent]);
        for flip in Flip::ALL {
            let (physics, state) = mirrored(flip, &physics, &state);
            let seen = field_of_view(&physics, &state, AgentId::ALL[agent]);
            prop_assert_eq!(seen, image(flip, &visible), "{:?}", flip);
            prop_assert_eq!(observed_set(&physics, &state, AgentId::ALL[agent]), observed, "{:?}", flip);
        }
    }
}
