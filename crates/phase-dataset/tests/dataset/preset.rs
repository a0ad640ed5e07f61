//! Presets.

use phase_dataset::preset::Preset;
use phase_model::EventKind;

const DEMO: &str = include_str!("../../../../data/presets/demo.json");

#[test]
fn the_demo_has_two_of_each_kind() {
    let preset = Preset::parse("demo", DEMO).expect("a preset");
    assert_eq!((preset.name.as_str(), preset.events), ("demo", 12));
    for kind in EventKind::ALL {
        assert_eq!((0..preset.events).filter(|&index| preset.kind(index) == kind).count(), 2, "{kind:?}");
    }
    assert_eq!(preset.id(7), "demo-0007");
    assert_eq!(preset.kind(12), preset.kind(0));
}

#[test]
fn what_is_no_preset_is_refused() {
    let cases = [
        ("{}", "missing field"),
        ("", "EOF"),
        (&DEMO.replace("phase-preset/1", "phase-preset/9"), "format"),
        (&DEMO.replace("12", "0"), "events"),
        (&DEMO.replace("helping", "dancing"), "dancing"),
        (&DEMO.replace("\"seed\"", "\"sead\""), "sead"),
    ];
    for (text, part) in cases {
        let sentence = Preset::parse("demo", text).expect_err(part).to_string();
        assert!(sentence.starts_with("demo: ") && sentence.contains(part), "{sentence}");
    }
}
