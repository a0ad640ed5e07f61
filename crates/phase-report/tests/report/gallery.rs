//! The page for people.

use crate::support::plain_event;
use phase_dataset::{
    manifest::{EventEntry, Manifest},
    splits::Split,
};
use phase_document::markup::{escape, escape_script};
use phase_model::path::RelativePath;
use phase_report::gallery::{EVENTS_PER_PAGE, Gallery, PageSummary, Timeline};
use serde_json::{Value, json};

fn example(id: &str) -> (Manifest, Vec<Timeline>) {
    let folder = tempfile::tempdir().expect("a folder");
    let manifest = crate::support::dataset(folder.path(), id);
    (manifest, vec![Timeline::of(&plain_event(4))])
}

/// The JSON that the page's script reads.
fn embedded(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"timelines\">").expect("the data");
    let (json, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(json).expect("JSON")
}

#[test]
fn a_card_says_what_the_event_is() {
    let (manifest, timelines) = example("demo-0000");
    let page = page(&manifest, &timelines);
    for part in [
        "data-src=\"videos/demo-0000.mp4\"",
        "href=\"events/demo-0000.json\"",
        "data-kind=\"helping\"",
        "data-relation=\"friendly\"",
        "data-split=\"train\"",
        "data-goal=\"light blue object on green\"",
        "friendly",
        "red agent",
        "green agent",
        "light blue object",
        "<strong>helps</strong>",
        "<summary>The red agent helps the green agent, which wants to put the light blue object on the green \
         landmark (top right) and does not succeed.</summary>",
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
    let (mut manifest, mut timelines) = example("demo-0000");
    let mut other = manifest.events[0].clone();
    other.id = "demo-0001".into();
    other.split = Some(Split::Test);
    manifest.events.push(other);
    timelines.push(timelines[0].clone());
    let page = page(&manifest, &timelines);
    for (filter, option) in [
        ("kind", "helping (2)"),
        ("relation", "friendly (2)"),
        ("goal", "light blue object on green (2)"),
        ("split", "train (1)"),
        ("split", "test (1)"),
    ] {
        let (_, select) = page.split_once(&format!("data-filter=\"{filter}\"")).expect(filter);
        let (select, _) = select.split_once("</select>").expect("its end");
        assert!(select.contains(option), "{filter}: {select}");
    }
    assert!(!page.contains("chasing ("), "no event is of this kind");
}

#[test]
fn subgoals_and_shares_change_with_the_steps() {
    let timeline = Timeline::of(&plain_event(4));
    let attach = "Attach(agent 0, object 1)".to_owned();
    let avoid = "not Touch(agent 0, agent 1)".to_owned();
    let expected = vec![(0, attach.clone()), (1, avoid.clone()), (2, attach), (3, avoid)];
    assert_eq!(timeline.tracks[0].subgoals, expected);
    assert_eq!(timeline.tracks[1].subgoals, [(0, "Stay".to_owned())]);
    // 40 of 50 particles; no particle proposed the idle agent's subgoal.
    assert_eq!(timeline.tracks[0].shares, [0.8; 4]);
    assert_eq!(timeline.tracks[1].shares, [0.0; 4]);
    let (manifest, timelines) = example("demo-0000");
    let value = embedded(&page(&manifest, &timelines));
    assert_eq!(value["texts"], json!(["Attach(agent 0, object 1)", "not Touch(agent 0, agent 1)", "Stay"]));
    assert_eq!(value["names"]["agent 0"], "red agent");
    assert_eq!(value["names"]["object 0"], "light blue object");
    assert_eq!(value["names"]["landmark 3"], "yellow landmark");
    let tracks = &value["events"]["demo-0000"];
    assert_eq!(*tracks, json!([[[0, 0, 1, 1, 2, 0, 3, 1], "ssss"], [[0, 2], "0000"]]));
}

#[test]
fn nothing_breaks_out_of_its_place() {
    let nasty = "</script><script>alert('x')</script>\"&{{cards}}<!--";
    let path = RelativePath::new(nasty).expect("a path, though an odd one");
    let (mut manifest, mut timelines) = example("demo-0000");
    manifest.preset = nasty.into();
    manifest.generator = nasty.into();
    manifest.events[0].id = nasty.into();
    manifest.events[0].video.as_mut().expect("a video").path = path.clone();
    manifest.events[0].event.path = path;
    timelines[0].tracks[0].subgoals[0].1 = nasty.into();
    let page = page(&manifest, &timelines);
    assert!(!page.contains("alert('x')</script>"));
    assert!(!page.contains(nasty));
    assert_eq!(page.matches("</script>").count(), 2, "the data's and the script's own");
    let value = embedded(&page);
    assert_eq!(value["texts"][0], nasty, "and yet the text arrives");
    assert!(value["events"][nasty].is_array());
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

/// Long events whose subgoals change every step are the worst case.
#[test]
fn five_hundred_events_make_a_page_of_reasonable_size() {
    let (mut manifest, _) = example("demo-0000");
    let event = manifest.events[0].clone();
    let numbered = |k| EventEntry { id: format!("demo-{k:04}"), ..event.clone() };
    manifest.events = (0..500).map(numbered).collect();
    let timelines = vec![Timeline::of(&plain_event(100)); EVENTS_PER_PAGE];
    let text = page(&manifest, &timelines);
    assert_eq!(text.matches("<video").count(), 500);
    assert_eq!(text.matches(" src=").count(), 0, "no video is loaded at once");
    assert!(text.len() < 2_500_000, "{} bytes", text.len());

    let all: Vec<EventEntry> = (0..=EVENTS_PER_PAGE).map(numbered).collect();
    manifest.events = all.clone();
    let gallery = gallery(&manifest);
    let (first, second) = all.split_at(EVENTS_PER_PAGE);
    let text = gallery.page(0, first, &timelines);
    assert_eq!(text.matches("<video").count(), EVENTS_PER_PAGE);
    assert!(text.contains("Events 1 to 1000 of 1001 by"));
    let text = gallery.page(1, second, &timelines);
    assert!(text.contains("Events 1001 to 1001 of 1001 by") && text.contains("<base href=\"../\">"));
    let index = gallery.index(&[first, second].map(|events| PageSummary::of(events).expect("events")));
    assert!(index.contains("<a href=\"pages/00001.html\">demo-1000 to demo-1000</a>: 1 friendly"), "{index}");
}

fn gallery(manifest: &Manifest) -> Gallery<'_> {
    let Manifest { preset, generator, seed, .. } = manifest;
    Gallery { preset, generator, seed: *seed, events: manifest.events.len(), overlay: None }
}

fn page(manifest: &Manifest, timelines: &[Timeline]) -> String {
    gallery(manifest).page(0, &manifest.events, timelines)
}
