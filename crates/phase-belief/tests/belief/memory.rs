//! The memory of cells.

use phase_belief::{AGENT_DECAY_STEPS, CellMemory, OBJECT_DECAY_STEPS, occupancy_weight};
use phase_model::{AgentId, Entity, ObjectId, Vec2};
use phase_perception::{Cell, CellSet};

fn cell(index: usize) -> Cell {
    Cell::from_index(index).expect("a cell of the arena")
}

#[test]
fn weights_are_those_stated() {
    let cases = [
        (Some(0), 20.0, 0.0),
        (None, 20.0, 1.0),
        (None, 200.0, 1.0),
        (Some(5), 20.0, 0.221_199_2),
        (Some(5), 200.0, 0.024_690_09),
        (Some(20), 20.0, 0.632_120_56),
        (Some(u32::MAX), 20.0, 1.0),
    ];
    for (age, decay_steps, expected) in cases {
        let weight = occupancy_weight(age, decay_steps);
        assert!((weight - expected).abs() < 1e-6, "{age:?} {decay_steps}: {weight}");
    }
    assert_eq!(occupancy_weight(Some(0), 20.0), 0.0);
    assert_eq!((AGENT_DECAY_STEPS, OBJECT_DECAY_STEPS), (20.0, 200.0));
}

#[test]
fn cells_age_from_when_they_were_last_seen() {
    let set = |indices: &[usize]| indices.iter().map(|&index| cell(index)).collect::<CellSet>();
    let mut memory = CellMemory::new();
    let steps: [(&[usize], [Option<u32>; 3]); 5] = [
        (&[], [None, None, None]),
        (&[0, 1], [Some(0), Some(0), None]),
        (&[1], [Some(1), Some(0), None]),
        (&[], [Some(2), Some(1), None]),
        (&[0, 399], [Some(0), Some(2), Some(0)]),
    ];
    for (seen, expected) in steps {
        memory.record_seen(&set(seen));
        assert_eq!([0, 1, 399].map(|index| memory.age(cell(index))), expected);
    }
    let agent = Entity::Agent(AgentId::ONE);
    let object = Entity::Object(ObjectId::ZERO);
    assert_eq!(memory.weight(agent, cell(0)), 0.0);
    assert!(memory.weight(agent, cell(1)) > memory.weight(object, cell(1)));
    assert_eq!(memory.weight(object, Cell::at(Vec2::new(16.0, 12.0)).unwrap()), 1.0);
}
