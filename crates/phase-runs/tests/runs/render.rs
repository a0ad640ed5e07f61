//! Events as videos and pictures in files.

use core::ops::ControlFlow;
use phase_event::{Recording, to_json};
use phase_model::AgentId;
use phase_runs::{
    effort::{Effort, MindChoice},
    engine,
    event_writer::settings_value,
    gen_dataset::{any_scene, plan},
    listener::Silent,
    picture::Look,
    render::{Rendering, View},
};
use std::{fs, path::Path};

/// A file with two short events, one of which is only measured.
fn events(folder: &Path) -> Rendering {
    let minds = MindChoice { simulations: Some(5), ..MindChoice::default() };
    let effort = Effort { max_steps: Some(2), minds, particles: Some(3), ..Effort::default() };
    let settings = effort.settings().expect("settings");
    let scene = any_scene(&plan::preset("demo").expect("a preset"), 1).expect("a scene");
    let event = engine::simulate("a", &scene, 1, &settings, &mut |_| ControlFlow::Continue(()));
    let event = event.expect("simulated").expect("whole");
    let value = settings_value(&settings).expect("JSON");
    let simulated = Recording::of_event("simulated", event, engine::GENERATOR.into(), value);
    let measured = Recording { id: "measured".into(), simulation: None, ..simulated.clone() };
    let file = folder.join("events.json");
    fs::write(&file, to_json(&[simulated, measured]).expect("JSON")).expect("written");
    Rendering {
        events: file,
        ids: vec!["simulated".into()],
        out: folder.join("out"),
        view: View::World,
        look: Look::default(),
        contact_sheet: None,
        threads: Some(1),
    }
}

/// Width of a PNG (pixels), from its header.
fn width(png: &Path) -> u32 {
    let bytes = fs::read(png).expect("a file");
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    u32::from_be_bytes(bytes[16..20].try_into().expect("four bytes"))
}

#[test]
fn every_view_has_a_file_of_its_own_and_two_beliefs_are_side_by_side() {
    let folder = tempfile::tempdir().expect("a folder");
    let sheet = |view| {
        let rendering = Rendering { view, contact_sheet: Some(2), ..events(folder.path()) };
        let made = rendering.run(&Silent).expect("drawn").files;
        assert_eq!((made.len(), made[0].interpolated), (1, false));
        made[0].file.clone()
    };
    let one = sheet(View::Belief(AgentId::ONE));
    let both = sheet(View::Beliefs);
    let names = [sheet(View::World), one.clone(), both.clone()];
    let names = names.map(|file| file.file_name().expect("a name").to_string_lossy().into_owned());
    assert_eq!(names, ["simulated.png", "simulated.belief1.png", "simulated.belief-both.png"]);
    assert!(width(&both) > width(&one) * 3 / 2, "{} beside {}", width(&both), width(&one));
}

#[test]
fn an_observer_leaves_its_course_beside_the_video() {
    let folder = tempfile::tempdir().expect("a folder");
    let rendering = Rendering { view: View::Observer(1), ..events(folder.path()) };
    let made = rendering.run(&Silent).expect("drawn").files;
    let observer = made[0].observer.as_ref().expect("a course");
    let course: serde_json::Value =
        serde_json::from_slice(&fs::read(&observer.file).expect("a file")).expect("JSON");
    let seconds: Vec<f64> =
        course["course"].as_array().expect("rows").iter().filter_map(|it| it["seconds"].as_f64()).collect();
    assert_eq!(seconds, [0.0, 0.25, 0.5], "the first row, and each of two steps of 0.25 s");
    assert!(observer.slowest_step_seconds >= observer.mean_step_seconds);
    assert!(fs::read(&made[0].file).expect("a video")[4..].starts_with(b"ftyp"));
}

#[test]
fn what_cannot_be_drawn_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = events(folder.path());
    let at = |name: &str| folder.path().join(name);
    let measured = vec!["measured".to_owned()];
    for (rendering, rule) in [
        (Rendering { view: View::Beliefs, ids: measured.clone(), ..base.clone() }, "needs a simulated event"),
        (Rendering { out: at("a.mp4"), ids: Vec::new(), ..base.clone() }, "but there are 2 events"),
        (Rendering { out: at("a.gif"), ..base.clone() }, ".gif cannot be written"),
        (Rendering { out: at("events.json"), ..base.clone() }, "does not end in .mp4"),
        (Rendering { ids: vec!["other".into()], ..base.clone() }, "has no event"),
    ] {
        let told = rendering.run(&Silent).expect_err(rule).to_string();
        assert!(told.contains(rule), "{told}");
    }
    let files = fs::read_dir(folder.path()).expect("a folder").flatten();
    let files: Vec<_> = files.filter(|it| it.path().is_file()).map(|it| it.file_name()).collect();
    assert_eq!(files, ["events.json"]);
    let made = Rendering { ids: measured, ..base }.run(&Silent).expect("drawn").files;
    assert!(made[0].interpolated, "a measured event has rows alone");
}
