//! Prints what is in a file of events: `cargo run -p phase-event --example read_events -- events.json`.

use std::{env, error::Error, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args().nth(1).ok_or("name a file of the format phase-events/1")?;
    for recording in phase_event::from_json(&fs::read_to_string(path)?)? {
        let kind = recording.scene.kind.name();
        let relation = recording.relation.name();
        println!("{}: {kind}, {relation}, {} steps", recording.id, recording.trajectory.steps());
    }
    Ok(())
}
