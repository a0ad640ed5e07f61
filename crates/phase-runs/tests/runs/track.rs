//! Videos as files: tracks of what the renderer draws, and whatever else somebody may give.

use phase_event::{ObservedEvent, observed_to_json, parse_observed};
use phase_model::{AgentBody, Body, PhysicsConfig, State, Vec2, arena};
use phase_render::{PaletteName, SceneRenderer, Style, VideoEncoder};
use phase_runs::track::{TrackRun, Tracked};
use phase_track::{Roles, TableOptions};
use std::{fs, path::Path};

/// Bodies at a time (s): agent 0 walks and turns, agent 1 turns, the object rests.
fn bodies(seconds: f32) -> [Body; 4] {
    let mut bodies = [Body::default(); 4];
    bodies[0] = Body::at_rest(Vec2::new(9.0 + 2.0 * seconds, 15.0 + seconds * seconds), 0.5 - seconds);
    bodies[1] = Body::at_rest(Vec2::new(21.0, 8.0), 1.0 + seconds);
    bodies[2] = Body::at_rest(Vec2::new(11.0, 6.0), 0.0);
    bodies
}

fn physics() -> PhysicsConfig {
    let agent = |radius| AgentBody { radius, max_force: 300.0 };
    let walls = phase_model::Layout::new(2, None).expect("a layout").walls();
    PhysicsConfig { walls, agents: [agent(0.8), agent(1.2)], object_radii: [1.01, 0.0], object_count: 1 }
}

/// One second at 20 frames a second.
fn video(palette: PaletteName) -> Vec<u8> {
    let style = Style { palette: palette.palette(), ..Style::default() };
    let renderer = SceneRenderer::new(&physics(), style).expect("a renderer");
    let mut video =
        VideoEncoder::new(Vec::new(), renderer.width(), renderer.height(), 20).expect("an encoder");
    for frame in 0..=20 {
        let state = State::new(bodies(frame as f32 / 20.0));
        video.push(&renderer.frame(&state, None)).expect("a frame");
    }
    video.finish().expect("a video")
}

fn run(input: &Path) -> TrackRun {
    let roles: Option<Roles> = None;
    TrackRun {
        input: input.to_owned(),
        id: None,
        frame_rate: 20.0,
        meaning: None,
        roles,
        table: TableOptions::default(),
    }
}

fn compare(Tracked { id, observed, tracking, .. }: &Tracked) {
    assert_eq!((observed.steps(), observed.object_sizes().len()), (4, 1));
    assert_eq!(observed.layout().walls(), physics().walls);
    for (t, row) in observed.rows().iter().enumerate().skip(1) {
        let truth = |k: usize| {
            let at = |substep: usize| bodies((5 * (t - 1) + substep) as f32 / 20.0)[k].position;
            (1..=5).map(at).sum::<Vec2>() / 5.0
        };
        for (k, body) in row.iter().enumerate().take(3) {
            let off = body.position.distance(truth(k));
            assert!(off < 0.06, "row {t}, body {k}: {off} u");
        }
    }
    let text = observed_to_json(&[(id, observed, Some(tracking))]).expect("JSON");
    let read: Vec<(String, ObservedEvent)> = parse_observed(text.as_bytes()).expect("an event");
    assert_eq!(read, [(id.clone(), observed.clone())]);
    assert!(observed.rows().iter().all(|row| arena::contains(row[0].position)));
}

#[test]
fn videos_of_both_palettes_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for palette in PaletteName::ALL {
        let file = folder.path().join("a video.mp4");
        fs::write(&file, video(palette)).expect("written");
        let tracked = run(&file).read().expect("a track");
        assert_eq!(tracked.id, "a-video");
        compare(&tracked);
    }
}

#[test]
fn pictures_and_animations_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let renderer = SceneRenderer::new(&physics(), Style::default()).expect("a renderer");
    let gif = folder.path().join("film.gif");
    let (width, height) = (renderer.width() as u16, renderer.height() as u16);
    let mut encoder =
        gif::Encoder::new(fs::File::create(&gif).expect("a file"), width, height, &[]).expect("a GIF");
    let pictures = folder.path().join("pictures");
    fs::create_dir(&pictures).expect("a folder");
    for frame in 0..=20 {
        let picture = renderer.frame(&State::new(bodies(frame as f32 / 20.0)), None);
        fs::write(pictures.join(format!("frame{frame}.png")), picture.png().expect("a PNG"))
            .expect("written");
        let mut rgba = picture.rgba().to_vec();
        let mut one = gif::Frame::from_rgba_speed(width, height, &mut rgba, 10);
        one.delay = 5;
        encoder.write_frame(&one).expect("a frame");
    }
    drop(encoder);
    compare(&run(&pictures).read().expect("a track"));
    compare(&run(&gif).read().expect("a track"));
}

/// Bytes of a good video, some of them changed or missing, are refused or read, and nothing panics.
#[test]
fn damaged_videos_are_refused_or_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = video(PaletteName::Paper);
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 16) as usize % below
    };
    let header = good.windows(4).position(|four| four == b"mdat").unwrap_or(good.len());
    let mut refused = 0;
    for round in 0..24 {
        let mut bytes = good.clone();
        if round % 4 == 0 {
            bytes.truncate(random(bytes.len()));
        } else {
            for _ in 0..=random(8) {
                // Mostly in what describes the pictures.
                let place = if round % 2 == 0 { random(header) } else { random(bytes.len()) };
                bytes[place] = random(256) as u8;
            }
        }
        let file = folder.path().join("damaged.mp4");
        fs::write(&file, &bytes).expect("written");
        refused += usize::from(phase_runs::track::read_mp4(fs::File::open(&file).expect("open")).is_err());
    }
    assert!(refused >= 6, "{refused}");
}

#[test]
fn what_is_no_video_is_refused_by_a_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let refusal = |name: &str, bytes: &[u8]| {
        let file = folder.path().join(name);
        fs::write(&file, bytes).expect("written");
        run(&file).read().expect_err("no video").to_string()
    };
    let text = refusal("text.mp4", b"hello");
    assert!(text.contains("text.mp4: is no video that can be read"), "{text}");
    assert!(refusal("empty.gif", b"").contains("as GIF"));
    assert!(refusal("photo.png", b"\x89PNG").contains("it is one picture"));
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).expect("a folder");
    assert!(run(&empty).read().expect_err("empty").to_string().contains("has no .png files"));
    assert!(run(&folder.path().join("absent.mp4")).read().is_err());
}
