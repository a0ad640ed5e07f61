//! The page for people.

use crate::support::plain_event;
use phase_dataset::{
    card::card,
    gallery::{Timeline, escape, escape_script, page},
};
use serde_json::Value;

fn example(id: &str) -> (phase_dataset::manifest::Manifest, Vec<Timeline>) {
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = crate::manifest::dataset(folder.path(), id);
    (manifest, vec![Timeline::of(&plain_event(4))])
}

/// The JSON that the page's script reads.
fn embedded(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"subgoals\">").expect("the data");
    let (json, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(json).expect("JSON")
}

#[test]
fn a_card_says_what_the_event_is() {
    let (manifest, timelines) = example("demo-0000");
    let page = page(&manifest, &timelines);
    for part in [
        "src=\"videos/demo-0000.mp4\"",
        "href=\"events/demo-0000.json\"",
        "data-kind=\"helping\"",
        "friendly",
        "red agent",
        "green agent",
        "blue object",
        "<strong>helps</strong>",
        "green landmark (top right)",
        "layout 20, flip 3",
        "2 steps, 0.5 s",
        "medium, strong",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("{{"), "a place was left empty");
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let (manifest, timelines) = example("demo-0000");
    let page = page(&manifest, &timelines);
    for part in ["http:", "https:", "//cdn", "@import", "<link", "fetch("] {
        assert!(!page.contains(part), "{part}");
    }
}

#[test]
fn the_filters_count() {
    let (manifest, timelines) = example("demo-0000");
    let page = page(&manifest, &timelines);
    assert!(page.contains("data-filter=\"helping\""));
    assert!(!page.contains("data-filter=\"chasing\""), "no event is of this kind");
}

#[test]
fn subgoals_change_with_the_steps() {
    let timeline = Timeline::of(&plain_event(4));
    let attach = "Attach(agent 0, object 1)".to_owned();
    let avoid = "not Touch(agent 0, agent 1)".to_owned();
    let expected = vec![(0, attach.clone()), (1, avoid.clone()), (2, attach), (3, avoid)];
    assert_eq!(timeline.0, [expected, vec![(0, "Stay".to_owned())]]);
    let (manifest, timelines) = example("demo-0000");
    let value = embedded(&page(&manifest, &timelines));
    assert_eq!(value["demo-0000"][1][0][1], "Stay");
}

#[test]
fn nothing_breaks_out_of_its_place() {
    let nasty = "</script><script>alert('x')</script>\"&{{cards}}<!--";
    let (mut manifest, mut timelines) = example("demo-0000");
    manifest.preset = nasty.into();
    manifest.generator = nasty.into();
    manifest.events[0].id = nasty.into();
    manifest.events[0].video.path = nasty.into();
    manifest.events[0].event.path = nasty.into();
    timelines[0].0[0][0].1 = nasty.into();
    let page = page(&manifest, &timelines);
    assert!(!page.contains("alert('x')</script>"));
    assert!(!page.contains(nasty));
    assert_eq!(page.matches("</script>").count(), 2, "the data's and the script's own");
    assert_eq!(embedded(&page)[nasty][0][0][1], nasty, "and yet the text arrives");
    assert_eq!(page.matches("<article").count(), 1);
}

#[test]
fn escapes_are_those_of_html_and_json() {
    assert_eq!(escape("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
    let text = "</script>\u{2028}";
    let json = Value::from(text).to_string();
    let escaped = escape_script(&json);
    assert!(!escaped.contains('<'));
    assert_eq!(serde_json::from_str::<String>(&escaped).expect("JSON"), text);
}

#[test]
fn five_hundred_events_make_a_page_of_reasonable_size() {
    let (mut manifest, timelines) = example("demo-0000");
    let event = manifest.events[0].clone();
    manifest.events = (0..500)
        .map(|k| phase_dataset::manifest::EventEntry { id: format!("demo-{k:04}"), ..event.clone() })
        .collect();
    let timelines = vec![timelines[0].clone(); 500];
    let page = page(&manifest, &timelines);
    assert_eq!(page.matches("<video").count(), 500);
    assert_eq!(page.matches("preload=\"none\"").count(), 500, "none is loaded at once");
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
}

#[test]
fn the_card_names_command_kinds_and_licence() {
    let (manifest, _) = example("demo-0000");
    let card = card(&manifest, "cargo xtask gen-dataset --seed 3");
    for part in ["cargo xtask gen-dataset --seed 3", "| helping | 1 |", "MIT OR Apache-2.0", "manifest.json"]
    {
        assert!(card.contains(part), "{part}");
    }
}
