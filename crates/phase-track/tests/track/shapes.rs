//! Shapes of any form in pictures that are drawn here.

use phase_event::ObservedEvent;
use phase_model::Vec2;
use phase_track::{Picture, Roles, Shape, Survey, TableOptions, table};

/// Black shapes over a light ground, with a house of lines: frames and the true paths (pixels).
fn film(frames: usize) -> (Vec<Vec<u8>>, [Vec<Vec2>; 3]) {
    const SIZE: (usize, usize) = (320, 240);
    let paths: [Vec<Vec2>; 3] = core::array::from_fn(|k| {
        let place = |frame: usize| {
            let t = frame as f32 / frames as f32;
            match k {
                // The first two meet in the middle and push each other; the third passes through the house.
                0 => Vec2::new(60.0 + 80.0 * (2.0 * t).min(1.0) - 20.0 * (t - 0.7).max(0.0), 60.0),
                1 => Vec2::new(240.0 - 70.0 * (2.0 * t).min(1.0) + 150.0 * (t - 0.7).max(0.0), 60.0),
                _ => Vec2::new(60.0 + 180.0 * t, 170.0 + 20.0 * (9.0 * t).sin()),
            }
        };
        (0..frames).map(place).collect()
    });
    let draw = |frame: usize| {
        let pixel = |k: usize| {
            let point = Vec2::new((k % SIZE.0) as f32 + 0.5, (k / SIZE.0) as f32 + 0.5);
            let off = |k: usize| point - paths[k][frame];
            // A square, a triangle (centred on its middle) and a disc.
            let square = off(0).abs().max_element() < 14.0;
            let triangle = off(1).y < 8.0 && off(1).y > -16.0 + 2.0 * off(1).x.abs();
            let disc = off(2).length() < 10.0;
            let wall = (point.x - 160.0).abs().max((point.y - 170.0).abs());
            let house = (58.0..60.0).contains(&wall) && (point.y - 170.0).abs() > 35.0;
            if square || triangle || disc || house { [20_u8; 3] } else { [226, 224, 219] }
        };
        (0..SIZE.0 * SIZE.1).flat_map(pixel).collect()
    };
    ((0..frames).map(draw).collect(), paths)
}

#[test]
fn shapes_of_one_colour_are_followed_without_an_arena() {
    let (frames, paths) = film(100);
    let watch = |take: &mut dyn FnMut(Picture<'_>, f64)| {
        for (k, bytes) in frames.iter().enumerate() {
            take(Picture::new(320, 240, bytes).expect("a picture"), k as f64 / 25.0);
        }
    };
    let mut survey = Survey::new();
    watch(&mut |picture, _| survey.push(&picture).expect("one size"));
    let mut tracker = survey.finish().expect("shapes");
    watch(&mut |picture, seconds| tracker.push(&picture, seconds).expect("one size"));
    let track = tracker.finish().expect("shapes");
    assert_eq!(track.shapes.len(), 3);
    for path in &paths {
        let off = |shape: &&Shape| -> f32 {
            let each = shape.path.iter().zip(path).map(|(found, truth)| found.distance(*truth));
            each.fold(0.0, f32::max)
        };
        let best = track.shapes.iter().map(|shape| off(&shape)).fold(f32::INFINITY, f32::min);
        assert!(best < 5.0, "{best} pixels");
    }
    let (event, tracking) = track.event(None).expect("an event");
    assert_eq!((event.steps(), event.object_sizes().len()), (15, 1));
    assert!(tracking.missing.walls && tracking.missing.landmarks && event.missing().forms);
    // The disc as the first agent, by its number.
    let disc = track.shapes.iter().position(|shape| (shape.radius - 10.0).abs() < 1.0).expect("a disc");
    let others: Vec<String> = (1..=3).filter(|k| *k != disc + 1).map(|k| k.to_string()).collect();
    let roles = Roles::read(&format!("{},{}", disc + 1, others.join(","))).expect("roles");
    let (mapped, _) = track.event(Some(&roles)).expect("an event");
    let travelled = |event: &ObservedEvent| {
        let rows = event.rows();
        rows[0][0].position.x.total_cmp(&rows[rows.len() - 1][0].position.x)
    };
    assert!(travelled(&mapped).is_lt());
    assert!(track.event(Some(&Roles::read("4,1").expect("roles"))).is_err());
    // Paths as a table come back as the same paths.
    let options = TableOptions { y_down: true, ..TableOptions::default() };
    let (again, _) = table(track.table().as_bytes(), "csv", &options).expect("a table");
    for (a, b) in again.rows().iter().zip(event.rows()) {
        assert!(a[0].position.distance(b[0].position) < 0.01);
    }
}

#[test]
fn without_shapes_over_a_plain_ground_there_is_a_sentence() {
    let survey = |pixel: &dyn Fn(usize, usize) -> [u8; 3]| {
        let mut survey = Survey::new();
        for frame in 0..10 {
            let bytes: Vec<u8> = (0..64 * 64).flat_map(|k| pixel(frame, k)).collect();
            survey.push(&Picture::new(64, 64, &bytes).expect("a picture")).expect("one size");
        }
        survey.finish().map(|_| ()).expect_err("nothing to follow").to_string()
    };
    assert!(survey(&|_, _| [255; 3]).contains("nothing moves"));
    assert!(
        survey(&|_, k| [(k * 37 % 256) as u8, (k * k % 251) as u8, (k % 256) as u8])
            .contains("no plain colour")
    );
}
