//! Tables as events.

use phase_model::{Size, Vec2};
use phase_track::{TableOptions, TrackError, table};

fn csv(text: &str, options: &TableOptions) -> Result<phase_event::ObservedEvent, TrackError> {
    table(text.as_bytes(), "csv", options).map(|(event, _)| event)
}

#[test]
fn positions_at_any_rate_and_scale_become_rows() {
    // 25 pictures a second, in pixels with y down: a moves right by 2 pixels a picture, b rests.
    let mut text = String::from("frame,who,px,py\n");
    for frame in 0..=50 {
        text += &format!("{frame},a,{},100\n{frame},b,300,400\n", 100 + 2 * frame);
    }
    let options = TableOptions {
        columns: ["frame", "who", "px", "py", ""].map(String::from),
        rate: 25.0,
        bounds: Some([0.0, 0.0, 400.0, 400.0]),
        y_down: true,
        ..TableOptions::default()
    };
    let event = csv(&text, &options).expect("an event");
    assert_eq!(event.steps(), 8);
    // 20 u are 400 pixels; 0.25 s are 6.25 pictures.
    let places = |t: usize| [0, 1].map(|body| event.rows()[t][body].position);
    assert_eq!(places(0), [Vec2::new(11.0, 17.0), Vec2::new(21.0, 2.0)]);
    assert!((places(4)[0].x - (11.0 + 2.5)).abs() < 1e-5);
    let moving = event.rows()[4][0];
    // 0.625 u in 1/12 s of physics, to the right.
    assert!((moving.velocity.x - 7.5).abs() < 1e-4, "{moving:?}");
    assert!((moving.angle + core::f32::consts::FRAC_PI_2).abs() < 1e-5, "{moving:?}");
}

#[test]
fn lines_of_json_are_read_by_paths() {
    let mut text = String::from("{\"scene\": {\"id\": 1}}\n");
    for frame in 0..10 {
        for body in 0..2 {
            text += &format!(
                "{{\"track\": {{\"f\": {frame}, \"p\": {body}, \"x\": {}, \"y\": {}}}}}\n",
                8 + frame,
                5 + body
            );
        }
    }
    let columns = ["track.f", "track.p", "track.x", "track.y", ""].map(String::from);
    let options = TableOptions { columns, rate: 4.0, ..TableOptions::default() };
    let (event, tracking) = table(text.as_bytes(), "jsonl", &options).expect("an event");
    assert_eq!((event.steps(), tracking.frames), (9, 10));
    assert_eq!(event.rows()[9][1].position, Vec2::new(17.0, 6.0));
}

#[test]
fn what_is_no_table_is_refused_by_a_sentence() {
    let refused = |text: &str| csv(text, &TableOptions::default()).expect_err("no table").to_string();
    let needed = refused("t,x\n1,2\n");
    assert!(needed.contains("has no column \"time\", only [\"t\", \"x\"]"), "{needed}");
    assert_eq!(refused("time,body,x,y\n0,a,one,2\n"), "line 2: x must be a number, not \"one\"");
    assert!(refused("time,body,x,y\n0,a,8,8\n1,a,8,8\n").contains("not 1 bodies"));
    assert!(refused("time,body,x,y\n0,a,8,8\n0,b,9,9\n").contains("at one time only"));
    assert!(refused("time,body,x,y\n0,a,8,8\n0,a,9,8\n0,b,9,9\n1,b,9,9\n").contains("two places"));
    assert!(refused("time,body,x,y\n0,a,8,8\n0.1,a,9,8\n0,b,9,9\n0.1,b,9,9\n").contains("at least 0.25 s"));
    assert!(refused("").contains("has no column"));
    let columns = ["time", "body", "x", "y", "q"].map(String::from);
    let named = TableOptions { columns, ..TableOptions::default() };
    let lines = "0,a,8,8\n1,a,9,8\n0,b,9,9\n1,b,9,9\n";
    let without = csv(&format!("time,body,x,y\n{lines}"), &named).expect_err("no angle").to_string();
    assert!(without.contains("has no column \"q\", only"), "{without}");
    let line = b"{\"time\": 0, \"body\": 0, \"x\": 5, \"y\": 6}";
    let without = table(line, "jsonl", &named).expect_err("no angle").to_string();
    assert!(without.contains("has no column \"q\" in any line"), "{without}");
    assert!(table(b"{\"x\": 1", "jsonl", &TableOptions::default()).is_err());
}

#[test]
fn nothing_in_a_table_is_left_out_without_a_word() {
    let lines = "0,a,8,8\n1,a,9,8\n0,b,9,9\n1,b,9,9\n";
    let refused = |text: &str, options: &TableOptions| csv(text, options).expect_err("refused").to_string();
    let usual = TableOptions::default();
    let twice = refused("time,body,x,x,y\n0,a,8,9,8\n", &usual);
    assert!(twice.contains("has 2 columns \"x\""), "{twice}");
    let sizes = TableOptions { sizes: vec![Size::Small; 3], ..TableOptions::default() };
    let text = format!("time,body,x,y\n{lines}");
    assert!(csv(&text, &usual).is_ok());
    assert!(refused(&text, &sizes).contains("fewer than the 3 sizes"));
    let bodies = TableOptions { bodies: vec!["a".into(), "a".into()], ..TableOptions::default() };
    assert!(refused(&text, &bodies).contains("in two roles"));
    let member = "{\"time\": 0, \"body\": 0, \"x\": 5, \"x\": 25, \"y\": 6}";
    let again = table(format!("\n{member}").as_bytes(), "jsonl", &usual).expect_err("refused").to_string();
    assert!(again.contains("has the member `x` twice, again in line 2"), "{again}");
}

#[test]
fn frames_are_counted_while_all_bodies_are_there() {
    let mut text = String::from("time,body,x,y\n");
    for t in 0..5 {
        text += &format!("{t},a,8,{}\n{t},b,9,9\n", 8 + t);
    }
    text += "1000000,a,8,8\n";
    let (_, tracking) = table(text.as_bytes(), "csv", &TableOptions::default()).expect("an event");
    assert_eq!((tracking.frames, tracking.frame_rate), (5, 1.0));
}

#[test]
fn gaps_are_told() {
    // Two lines a step for 4 s; body a is not there for 2 s of them.
    let line = |k: u32, body: &str, x: u32| format!("{},{body},{x},5\n", f64::from(k) * 0.125);
    let mut text = String::from("time,body,x,y\n");
    for k in 0..=32 {
        if !(9..=23).contains(&k) {
            text += &line(k, "a", k);
        }
        text += &line(k, "b", 40 - k);
    }
    let (event, tracking) = table(text.as_bytes(), "csv", &TableOptions::default()).expect("an event");
    assert_eq!(event.steps(), 16);
    // Lines of a at 1 s and 3 s are within 0.25 s of the poses at 1.25 s and 2.75 s: five of 34 are hidden.
    assert!((tracking.hidden - 5.0 / 34.0).abs() < 1e-9, "{}", tracking.hidden);
    let whole: String = (0..=32).flat_map(|k| [line(k, "a", k), line(k, "b", 40 - k)]).collect();
    let (_, tracking) =
        table(format!("time,body,x,y\n{whole}").as_bytes(), "csv", &TableOptions::default()).expect("whole");
    assert!(tracking.hidden.abs() < 1e-9);
}

#[test]
fn a_place_far_from_all_others_is_refused() {
    let lines = |last: f64| {
        let line = |k: u32| {
            let x = if k == 100 { last } else { f64::from(k) };
            format!("{k},a,{x},5\n{k},b,{},9\n", 200 - k)
        };
        (0..=200).map(line).collect::<String>()
    };
    let read = |last: f64| csv(&format!("time,body,x,y\n{}", lines(last)), &TableOptions::default());
    assert!(read(100.0).is_ok());
    let refused = read(1e308).expect_err("far away").to_string();
    assert!(refused.contains("98 of 100 places lie within a hundredth of the whole area"), "{refused}");
}
