//! Draws and encodes a synthetic event of 500 frames, and prints time per frame and the size of the video.
//!
//! With a directory as argument it leaves `plain.mp4`, `belief.mp4`, `plain.png`, `belief.png`, `both.png`
//! (accessible palette) and `sheet.png` there, to look at.

use phase_model::{
    AgentBody, AgentId, Body, Grip, Layout, ObjectId, PhysicsConfig, Side, State, Vec2, arena,
};
use phase_perception::{Cell, CellSet};
use phase_render::{
    Caption, Frame, Overlay, Palette, SceneRenderer, Style, VideoEncoder, contact_sheet, side_by_side,
};
use std::{error::Error, f32::consts::PI, path::Path, time::Instant};

const FRAMES: usize = 500;

fn main() -> Result<(), Box<dyn Error>> {
    let physics = PhysicsConfig {
        walls: Layout::new(20, None)?.walls(),
        agents: [AgentBody { radius: 1.01, max_force: 300.0 }, AgentBody { radius: 1.2, max_force: 300.0 }],
        object_radii: [0.8, 1.2],
        object_count: 2,
    };
    let plain = SceneRenderer::new(&physics, Style::default())?;
    let annotated = Style { title: true, legend: true, caption_lines: 3, ..Style::default() };
    let captioned = SceneRenderer::new(&physics, annotated)?;
    let accessible = SceneRenderer::new(&physics, Style { palette: Palette::ACCESSIBLE, ..annotated })?;

    let (frames, mp4) = run("plain", &plain, |renderer, k| renderer.frame(&event(k), None))?;
    let (beliefs, belief_mp4) = run("belief", &captioned, |renderer, k| belief(renderer, k, AgentId::ZERO))?;

    if let Some(directory) = std::env::args().nth(1) {
        let directory = Path::new(&directory);
        std::fs::write(directory.join("plain.mp4"), mp4)?;
        std::fs::write(directory.join("belief.mp4"), belief_mp4)?;
        std::fs::write(directory.join("plain.png"), frames[320].png()?)?;
        std::fs::write(directory.join("belief.png"), beliefs[320].png()?)?;
        let both = AgentId::ALL.map(|agent| belief(&accessible, 320, agent));
        std::fs::write(directory.join("both.png"), side_by_side(&both)?.png()?)?;
        let keys: Vec<Frame> = frames.iter().step_by(63).cloned().collect();
        std::fs::write(directory.join("sheet.png"), contact_sheet(&keys, 4)?.png()?)?;
    }
    Ok(())
}

/// One frame with what an agent might see and believe.
fn belief(renderer: &SceneRenderer, frame: usize, agent: AgentId) -> Frame {
    let state = event(frame);
    let visible = cone(&state.bodies[agent.index()]);
    let subgoal = if frame < 250 { "get object 1" } else { "put object 1 on landmark 2" };
    let line = |cells: [&str; 2], text: &str, bar| Caption {
        cells: cells.map(str::to_owned).to_vec(),
        text: text.into(),
        bar,
    };
    let captions = [
        line(["V", "particles"], "subgoal (bar: share of particles)", 0.0),
        line(["0.90", "38"], subgoal, 0.76),
        line(["−0.25", "12"], &format!("look around ({} of 400 cells seen)", visible.len()), 0.24),
    ];
    let particles: Vec<State> = (0..50).map(|particle| guess(&state, particle, agent)).collect();
    let title = format!("Agent {agent}, step {}", frame / arena::SUBSTEPS);
    let overlay =
        Overlay { agent, visible: &visible, particles: &particles, title: &title, captions: &captions };
    renderer.frame(&state, Some(&overlay))
}

/// Draws all frames, then encodes them, and prints how long each took.
fn run(
    name: &str,
    renderer: &SceneRenderer,
    draw: impl Fn(&SceneRenderer, usize) -> Frame,
) -> Result<(Vec<Frame>, Vec<u8>), Box<dyn Error>> {
    let start = Instant::now();
    let frames: Vec<Frame> = (0..FRAMES).map(|k| draw(renderer, k)).collect();
    let drawing = start.elapsed();
    let start = Instant::now();
    let mut video =
        VideoEncoder::new(Vec::new(), renderer.width(), renderer.height(), arena::FRAMES_PER_SECOND)?;
    for frame in &frames {
        video.push(frame)?;
    }
    let mp4 = video.finish()?;
    let encoding = start.elapsed();
    println!(
        "{name}: {} x {}, {FRAMES} frames, drawing {:.2} ms and encoding {:.2} ms a frame, {:.1} kB",
        renderer.width(),
        renderer.height(),
        drawing.as_secs_f64() * 1000.0 / FRAMES as f64,
        encoding.as_secs_f64() * 1000.0 / FRAMES as f64,
        mp4.len() as f64 / 1000.0
    );
    Ok((frames, mp4))
}

/// Agent 0 fetches object 1 from the bottom right; agent 1 wanders back and forth; object 0 is pushed a bit.
fn event(frame: usize) -> State {
    let time = frame as f32 / FRAMES as f32;
    let swing = |rate: f32| libm::sinf(2.0 * PI * rate * time);
    let mut bodies = [Body::default(); 4];
    bodies[1] = Body::at_rest(Vec2::new(9.5 + swing(2.0), 17.0 + 2.5 * swing(5.0)), 4.0 * swing(1.0));
    bodies[2] = Body::at_rest(Vec2::new(13.5, 19.0 + 2.0 * (time - 0.4).clamp(0.0, 0.3)), 0.0);
    let angle = -0.4 * PI + 1.4 * swing(1.5);
    bodies[0] = Body::at_rest(Vec2::new(19.5 + 2.5 * swing(1.0), 7.0 + 2.5 * swing(2.0)), angle);
    bodies[3] = Body::at_rest(Vec2::new(23.4, 4.4), 0.0);
    let mut state = State::new(bodies);
    if frame >= 250 {
        let heading = state.bodies[0].forward();
        state.bodies[3].position = state.bodies[0].position + heading * (1.01 + 1.2);
        state.grips[0] = Some(Grip { object: ObjectId::ONE, side: Side::Head, relative_angle: 0.0 });
    }
    state
}

/// A cone in front of a body, without occlusion: this is a picture, not perception.
fn cone(body: &Body) -> CellSet {
    let heading = body.forward();
    Cell::all()
        .filter(|cell| {
            let to = cell.centre() - body.position;
            to.dot(heading) > 0.58 * to.length()
        })
        .collect()
}

/// A synthetic particle: the other agent and object 0 lie somewhere else.
fn guess(state: &State, particle: usize, agent: AgentId) -> State {
    let mut guess = *state;
    let spread = particle as f32 * 2.399;
    let ring = 0.35 * (particle as f32).sqrt();
    guess.bodies[agent.other().index()].position += Vec2::from_angle(spread) * ring;
    guess.bodies[agent.other().index()].angle += particle as f32;
    guess.bodies[2].position += Vec2::from_angle(-spread) * ring;
    guess
}
