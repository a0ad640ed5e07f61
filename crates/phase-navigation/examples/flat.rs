//! A flat with rooms and doors of one's own: which rooms a wheelchair reaches, and how far it has to go.
//!
//! `cargo run --package phase-navigation --example flat`

use phase_model::{Segment, Vec2};
use phase_navigation::{Area, Floor, FloorError, FloorField, Mover};

/// Rooms, by their lower left and upper right corners (m).
const ROOMS: [(&str, [f32; 4]); 4] = [
    ("hall", [0.0, 3.0, 10.0, 5.0]),
    ("kitchen", [0.0, 0.0, 4.0, 3.0]),
    ("bathroom", [4.0, 0.0, 10.0, 3.0]),
    ("bedroom", [0.0, 5.0, 10.0, 9.0]),
];

/// Walls, from end to end; what they leave open are doors (m).
const WALLS: [[f32; 4]; 6] = [
    // Doors of 0.9 m to the kitchen and of 0.7 m to the bathroom.
    [0.0, 3.0, 2.0, 3.0],
    [2.9, 3.0, 8.0, 3.0],
    [8.7, 3.0, 10.0, 3.0],
    [4.0, 0.0, 4.0, 3.0],
    // The bedroom is open for 2 m, and has a screen behind that.
    [0.0, 5.0, 8.0, 5.0],
    [6.0, 6.5, 10.0, 6.5],
];

fn main() -> Result<(), FloorError> {
    let wall = |[ax, ay, bx, by]: [f32; 4]| Segment { a: Vec2::new(ax, ay), b: Vec2::new(bx, by) };
    let floor = Floor::new(Vec2::ZERO, Vec2::new(10.0, 9.0), WALLS.map(wall).to_vec())?;
    let bed = Vec2::new(9.0, 8.0);
    for (body, width) in [("a person", 0.5), ("a wheelchair", 0.8)] {
        for (name, [min_x, min_y, max_x, max_y]) in ROOMS {
            let room = Area { min: Vec2::new(min_x, min_y), max: Vec2::new(max_x, max_y) };
            let field = FloorField::new(&floor, room, Mover { half_width: 0.5 * width });
            match field.distance(bed) {
                Some(distance) => println!("{body}, from the bed to the {name}: {distance:.1} m"),
                None => println!("{body}, from the bed to the {name}: no way"),
            }
            assert_eq!(field.distance(bed).is_none(), name == "bathroom" && width > 0.7);
        }
    }
    Ok(())
}

#[test]
fn it_runs() {
    main().expect("a floor");
}
