//! `index.html`: a page that opens offline and shows every video of a dataset with its labels.

use crate::{
    manifest::{AgentEntry, EventEntry, Manifest},
    words::{self, Piece},
};
use phase_model::{
    AGENT_COUNT, Attitude, Entity, EventKind, Sign, Size, Strength,
    arena::{FRAMES_PER_SECOND, SUBSTEPS},
};
use phase_sim::Event;
use serde_json::json;
use std::fmt::Write as _;

/// The page's file name.
pub const PAGE_FILE: &str = "index.html";
/// How long a step is shown (s).
const SECONDS_PER_STEP: f64 = SUBSTEPS as f64 / FRAMES_PER_SECOND as f64;
const PAGE: &str = include_str!("../assets/page.html");
const STYLE: &str = include_str!("../assets/style.css");
const SCRIPT: &str = include_str!("../assets/script.js");

/// What both agents were after, as it changed: steps (from 0) and the subgoal's text from then on.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Timeline(pub [Vec<(usize, String)>; AGENT_COUNT]);

impl Timeline {
    /// The timeline of an event.
    #[must_use]
    pub fn of(event: &Event) -> Self {
        Self(core::array::from_fn(|agent| {
            let mut changes: Vec<(usize, String)> = Vec::new();
            for (t, step) in event.steps.iter().enumerate() {
                let text = step.thoughts[agent].subgoal.to_string();
                if changes.last().is_none_or(|(_, last)| *last != text) {
                    changes.push((t, text));
                }
            }
            changes
        }))
    }
}

/// The page for a dataset; one timeline for each of the manifest's events.
#[must_use]
pub fn page(manifest: &Manifest, timelines: &[Timeline]) -> String {
    let cards: String = manifest.events.iter().map(card).collect();
    let subgoals: serde_json::Map<String, serde_json::Value> = manifest
        .events
        .iter()
        .zip(timelines)
        .map(|(event, timeline)| (event.id.clone(), json!(timeline.0)))
        .collect();
    let heading = format!("PHASE: {}", manifest.preset);
    let intro = format!(
        "{} events by {}, seed {}. Two agents see, believe, plan and act; what they want of each other shows \
         in how they move.",
        manifest.events.len(),
        manifest.generator,
        manifest.seed
    );
    let parts = [
        ("title", escape(&heading)),
        ("intro", escape(&intro)),
        ("style", STYLE.to_owned()),
        ("filters", filters(manifest)),
        ("cards", cards),
        ("subgoals", escape_script(&serde_json::Value::Object(subgoals).to_string())),
        ("script", SCRIPT.to_owned()),
    ];
    fill(PAGE, &parts)
}

/// Puts parts into a template's `{{name}}` places in one pass, so that text which looks like a place and came
/// in with a part is left alone.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let Some((name, after)) = after.split_once("}}") else { break };
        if let Some((_, text)) = parts.iter().find(|(part, _)| *part == name) {
            page.push_str(text);
        }
        rest = after;
    }
    page + rest
}

/// Text made safe between tags and inside quoted attributes.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            letter => safe.push(letter),
        }
    }
    safe
}

/// JSON made safe inside a script element: `<` occurs only within strings, where it may be spelled otherwise.
#[must_use]
pub fn escape_script(json: &str) -> String {
    json.replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

fn filters(manifest: &Manifest) -> String {
    let button = |kind: &str, count: usize, pressed: bool| {
        format!(
            "<button type=\"button\" data-filter=\"{kind}\" aria-pressed=\"{pressed}\">{kind} \
             <span class=\"count\">{count}</span></button>\n"
        )
    };
    let mut buttons = button("all", manifest.events.len(), true);
    for kind in EventKind::ALL {
        let count = manifest.events.iter().filter(|event| event.kind == kind).count();
        if count > 0 {
            buttons.push_str(&button(kind.name(), count, false));
        }
    }
    buttons
}

fn card(event: &EventEntry) -> String {
    let (id, kind) = (escape(&event.id), event.kind.name());
    let agents: String = (0..AGENT_COUNT).map(|k| agent(k, &event.agents[k])).collect();
    let mut things = String::new();
    for (k, &level) in event.object_size_levels.iter().enumerate() {
        let size = Size::from_level(level).map_or("", words::size);
        let _ = write!(things, "{} {size} · ", chip(Piece::Entity(Entity::object(k))));
    }
    let flip = event.layout.flip.map_or_else(String::new, |flip| format!(", flip {flip}"));
    format!(
        "<article class=\"card\" data-kind=\"{kind}\" data-id=\"{id}\" aria-label=\"{kind}, {id}\">\n\
         <header><h2>{kind}</h2><span class=\"tag {relation}\">{relation}</span><code>{id}</code></header>\n\
         <video controls muted playsinline preload=\"none\" src=\"{video}\" title=\"{what}\"></video>\n\
         <div class=\"player\" hidden><button type=\"button\" class=\"toggle\" aria-label=\"play\">▶</button>\
         <button type=\"button\" class=\"back\" aria-label=\"one step back\">‹</button>\
         <button type=\"button\" class=\"next\" aria-label=\"one step on\">›</button>\
         <input type=\"range\" min=\"0\" max=\"{seconds}\" step=\"0.05\" value=\"0\" aria-label=\"time\">\
         <output>0.0 s</output></div>\n\
         <ul class=\"agents\">\n{agents}</ul>\n\
         <p class=\"meta\">{things}layout {base}{flip} · {steps} steps, {seconds:.1} s · \
         <a href=\"{json}\">data</a></p>\n</article>\n",
        relation = words::relation(event.relation),
        what = escape(words::kind(event.kind)),
        video = escape(&event.video.path),
        json = escape(&event.event.path),
        base = event.layout.base,
        steps = event.steps,
        seconds = event.steps as f64 * SECONDS_PER_STEP,
    )
}

fn agent(k: usize, agent: &AgentEntry) -> String {
    let size = Size::from_level(agent.size_level).map_or("", words::size);
    let strength = Strength::from_level(agent.strength_level).map_or("", words::strength);
    let other = chip(Piece::Entity(Entity::agent(1 - k)));
    let attitude = Attitude::try_from(agent.alpha).unwrap_or_default();
    let stance = match attitude {
        Attitude::Neutral => String::new(),
        social => format!(" <strong>{}</strong> {other}:", words::attitude(social)),
    };
    let goal: String = words::goal(k, agent.goal).into_iter().map(chip).collect();
    let outcome = match (agent.reached, agent.steps_to_goal) {
        (true, Some(steps)) => {
            format!("<span class=\"yes\">done after {:.1} s</span>", steps as f64 * SECONDS_PER_STEP)
        }
        (true, None) => "<span class=\"yes\">so at the end</span>".into(),
        (false, _) if agent.goal.sign() == Sign::Negative => {
            "<span class=\"no\">not so at the end</span>".into()
        }
        (false, _) => "<span class=\"no\">not done</span>".into(),
    };
    format!(
        "<li>{me} <span class=\"body\">{size}, {strength}</span>{stance} wants to {goal} {outcome}\
         <div class=\"now\" data-agent=\"{k}\"><span class=\"label\">now</span> <span class=\"subgoal\">–</span>\
         </div></li>\n",
        me = chip(Piece::Entity(Entity::agent(k))),
    )
}

/// A piece of a sentence as HTML; what has a colour in the video has it here.
fn chip(piece: Piece) -> String {
    let (class, text) = match piece {
        Piece::Text(text) => return escape(text),
        Piece::Entity(Entity::Agent(agent)) => {
            (format!("agent agent{agent}"), words::entity(Entity::Agent(agent)))
        }
        Piece::Entity(Entity::Object(object)) => {
            (format!("object object{object}"), words::entity(Entity::Object(object)))
        }
        Piece::Landmark(landmark) => (format!("landmark landmark{landmark}"), words::landmark(landmark)),
    };
    format!("<span class=\"chip {class}\">{}</span>", escape(text))
}
