//! `index.html`: a page that opens offline and shows every video of a dataset with its labels, and the
//! subgoals of its agents at every moment. A large dataset has a page for every thousand events, and
//! `index.html` lists them.

mod timeline;

pub use timeline::Timeline;

use phase_dataset::{
    event_set::set_video_path,
    manifest::{AgentEntry, EventEntry, PAGE_FILE},
};
use phase_document::markup::{escape, escape_script};
use phase_model::{
    AgentId, Attitude, Entity, ObjectId, Sign, Size, Strength,
    arena::STEP_VIDEO_SECONDS,
    words::{self, Fragment, Names},
};
use std::{collections::BTreeMap, fmt::Write as _};

const PAGE: &str = include_str!("../../assets/page.html");
const INDEX: &str = include_str!("../../assets/pages.html");
const STYLE: &str = include_str!("../../assets/style.css");
const OVERLAY_STYLE: &str = include_str!("../../assets/overlay.css");
const SCRIPT: &str = include_str!("../../assets/script.js");

/// Maximum number of events on a page; with more, browsers get slow.
pub const EVENTS_PER_PAGE: usize = 1000;
/// Folder of the pages of a large dataset.
pub const PAGES_FOLDER: &str = "pages";

/// Facts that all pages of a dataset show.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Gallery<'a> {
    /// Name of the preset.
    pub preset: &'a str,
    /// Name and version of the program.
    pub generator: &'a str,
    /// Seed of the dataset.
    pub seed: u64,
    /// Number of events of the dataset.
    pub events: usize,
    /// A sentence about what the videos show beside the bodies. With it the page is not in the dataset's
    /// folder, and links none of its files.
    pub overlay: Option<&'a str>,
}

/// One of several pages, in the list of all.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PageSummary {
    /// Names of its first and its last event.
    pub range: [String; 2],
    /// Number of events of each relation, by name.
    pub relations: BTreeMap<&'static str, usize>,
}

impl PageSummary {
    /// The summary of a page; `None` without events.
    #[must_use]
    pub fn of(events: &[EventEntry]) -> Option<Self> {
        let mut relations = BTreeMap::new();
        for event in events {
            *relations.entry(event.relation.name()).or_default() += 1;
        }
        Some(Self { range: [events.first()?.id.clone(), events.last()?.id.clone()], relations })
    }
}

impl Gallery<'_> {
    /// Whether all events are on one page.
    #[must_use]
    pub const fn is_one_page(&self) -> bool {
        self.events <= EVENTS_PER_PAGE
    }

    /// The file of a page, by its number from 0.
    #[must_use]
    pub fn file(&self, number: usize) -> String {
        if self.is_one_page() { PAGE_FILE.into() } else { format!("{PAGES_FOLDER}/{number:05}.html") }
    }

    /// A page of some events; one timeline for each.
    #[must_use]
    pub fn page(&self, number: usize, events: &[EventEntry], timelines: &[Timeline]) -> String {
        let (count, base) = if self.is_one_page() {
            (if self.events == 1 { "1 event".into() } else { format!("{} events", self.events) }, "")
        } else {
            let from = number * EVENTS_PER_PAGE + 1;
            let to = number * EVENTS_PER_PAGE + events.len();
            (format!("Events {from} to {to} of {}", self.events), "<base href=\"../\">\n")
        };
        let back = if self.is_one_page() {
            String::new()
        } else {
            format!(" <a href=\"{PAGE_FILE}\">All pages</a>.")
        };
        let intro = format!(
            "{count} by {}, seed {}. Two agents see, believe, plan and act; what they want of each other shows in \
             how they move.{}",
            self.generator,
            self.seed,
            self.overlay.map_or_else(String::new, |overlay| format!(" {overlay}")),
        );
        let parts = [
            ("title", escape(&format!("PHASE: {}", self.preset))),
            ("base", base.into()),
            ("intro", escape(&intro) + &back),
            ("style", STYLE.to_owned() + self.overlay.map_or("", |_| OVERLAY_STYLE)),
            ("filters", filters(events)),
            ("cards", self.cards(events, timelines)),
            ("timelines", escape_script(&timeline::table(events, timelines).to_string())),
            ("script", SCRIPT.to_owned()),
        ];
        fill(PAGE, &parts)
    }

    fn cards(&self, events: &[EventEntry], timelines: &[Timeline]) -> String {
        let links = |event: &EventEntry| {
            if self.overlay.is_some() {
                return String::new();
            }
            let beside = event.set.as_ref().filter(|_| event.video.is_some()).map(|place| {
                format!(" · <a href=\"{}\">its set side by side</a>", escape(&set_video_path(&place.set)))
            });
            format!(
                " · <a href=\"{}\">data</a>{}",
                escape(event.event.path.as_str()),
                beside.unwrap_or_default()
            )
        };
        let cards = events.iter().zip(timelines);
        cards.map(|(event, timeline)| card(event, timeline, &links(event))).collect()
    }

    /// The list of all pages.
    #[must_use]
    pub fn index(&self, pages: &[PageSummary]) -> String {
        let mut rows = String::new();
        for (number, PageSummary { range: [first, last], relations }) in pages.iter().enumerate() {
            let counts: Vec<String> =
                relations.iter().map(|(relation, count)| format!("{count} {relation}")).collect();
            let _ = writeln!(
                rows,
                "<li><a href=\"{}\">{} to {}</a>: {}</li>",
                self.file(number),
                escape(first),
                escape(last),
                counts.join(", ")
            );
        }
        let intro = format!(
            "{} events by {}, seed {}, on {} pages.",
            self.events,
            self.generator,
            self.seed,
            pages.len()
        );
        let parts = [
            ("title", escape(&format!("PHASE: {}", self.preset))),
            ("intro", escape(&intro)),
            ("style", STYLE.to_owned()),
            ("pages", rows),
        ];
        fill(INDEX, &parts)
    }
}

/// Inserts parts into a template's `{{name}}` places in one pass, so that inserted text which looks like a
/// place is left unchanged.
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

/// A filter for each property of events, with the number of events for each value.
fn filters(events: &[EventEntry]) -> String {
    type Values = fn(&EventEntry) -> Vec<String>;
    let stance: Values = |event| event.set.iter().map(|place| place.stance.name().to_owned()).collect();
    let keys: [(&str, Values); 6] = [
        ("kind", |event| vec![event.kind.name().into()]),
        ("manner", |event| manners(event).map(Into::into).collect()),
        ("relation", |event| vec![event.relation.name().into()]),
        ("goal", goals),
        ("stance", stance),
        ("split", |event| vec![event.split().name().into()]),
    ];
    let mut selects = String::new();
    for (name, of) in keys {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for value in events.iter().flat_map(of) {
            *counts.entry(value).or_default() += 1;
        }
        if counts.is_empty() {
            continue;
        }
        let _ =
            write!(selects, "<label>{name} <select data-filter=\"{name}\"><option value=\"\">all</option>");
        for (value, count) in counts {
            let _ = write!(selects, "<option value=\"{0}\">{0} ({count})</option>", escape(&value));
        }
        selects.push_str("</select></label>\n");
    }
    selects
}

/// The names of the manners of helping, hindering and meeting that are seen.
fn manners(event: &EventEntry) -> impl Iterator<Item = &'static str> {
    event.manners.iter().map(|manner| manner.name())
}

/// The distinct goals of an event's agents, in few words.
fn goals(event: &EventEntry) -> Vec<String> {
    let mut texts = AgentId::ALL.map(|who| Names::PAPER.wants_briefly(event.agents[who].goal, who)).to_vec();
    texts.dedup();
    texts
}

fn card(event: &EventEntry, timeline: &Timeline, links: &str) -> String {
    let id = escape(&event.id);
    let kind = event.kind.name();
    let agents: String = AgentId::ALL.into_iter().map(|who| agent(who, &event.agents[who])).collect();
    let mut things = String::new();
    for (object, &level) in ObjectId::ALL.into_iter().zip(&event.object_size_levels) {
        let size = Size::from_level(level).map_or("", Size::name);
        let _ = write!(things, "{} {size} · ", chip(Fragment::Entity(Entity::Object(object))));
    }
    let flip = event.layout.flip.map_or_else(String::new, |flip| format!(", flip {flip}"));
    let button = |class: &str, label: &str, sign: &str| {
        format!(
            "<button type=\"button\" class=\"{class}\" aria-label=\"{label}\" title=\"{label}\">{sign}</button>"
        )
    };
    let buttons = [
        button("toggle", "play", "▶"),
        button("step-back", "previous step", "«"),
        button("back", "previous frame", "‹"),
        button("next", "next frame", "›"),
        button("step-next", "next step", "»"),
    ];
    format!(
        "<article class=\"card\" tabindex=\"0\" data-id=\"{id}\" data-kind=\"{kind}\" \
         data-relation=\"{relation}\" data-split=\"{split}\" data-goal=\"{goals}\" data-manner=\"{manners}\" data-stance=\"{stance}\" data-steps=\"{steps}\" \
         aria-label=\"{kind}, {id}\">\n\
         <header><h2>{kind}</h2><span class=\"tag {relation}\">{relation}</span><span class=\"tag\">{split}</span>\
         <code>{id}</code></header>\n\
         <video muted playsinline preload=\"none\" data-src=\"{video}\" title=\"{what}\"></video>\n\
         <div class=\"player\">{buttons}<output>0.0 s</output></div>\n\
         <canvas class=\"timeline\" title=\"subgoals over time; the height is the share of belief particles \
         behind them\"></canvas>\n\
         <details><summary>{story}</summary><ol>{happenings}</ol></details>\n\
         <ul class=\"agents\">\n{agents}</ul>\n\
         <p class=\"meta\">{things}layout {base}{flip} · {steps} steps, {seconds:.1} s\
         {links}</p>\n</article>\n",
        relation = event.relation.name(),
        split = event.split().name(),
        goals = escape(&goals(event).join("|")),
        manners = manners(event).collect::<Vec<_>>().join("|"),
        stance = event.set.as_ref().map_or("", |place| place.stance.name()),
        what = escape(words::kind(event.kind)),
        story = escape(&timeline.narrative.short),
        happenings = timeline
            .narrative
            .seen
            .lines()
            .map(|line| format!("<li>{}</li>", escape(line)))
            .collect::<String>(),
        video = event.video.as_ref().map_or_else(String::new, |video| escape(video.path.as_str())),
        buttons = buttons.concat(),
        base = event.layout.base,
        steps = event.steps,
        seconds = event.steps as f64 * STEP_VIDEO_SECONDS,
    )
}

fn agent(who: AgentId, agent: &AgentEntry) -> String {
    let size = Size::from_level(agent.size_level).map_or("", Size::name);
    let strength = Strength::from_level(agent.strength_level).map_or("", Strength::name);
    let other = chip(Fragment::Entity(Entity::Agent(who.other())));
    let attitude = Attitude::try_from(agent.alpha).unwrap_or_default();
    let stance = match attitude {
        Attitude::Neutral => String::new(),
        social => format!(" <strong>{}</strong> {other}:", words::attitude(social)),
    };
    let knowledge = agent.level.map_or_else(String::new, |level| {
        format!(", does not know the other's goal, level {}", u8::from(level))
    });
    let goal: String = words::wants_to(agent.goal, who).into_iter().map(chip).collect();
    let outcome = match (agent.reached, agent.steps_to_goal) {
        (true, Some(steps)) => {
            format!("<span class=\"yes\">done after {:.1} s</span>", steps as f64 * STEP_VIDEO_SECONDS)
        }
        (true, None) => "<span class=\"yes\">so at the end</span>".into(),
        (false, _) if agent.goal.sign() == Sign::Negative => {
            "<span class=\"no\">not so at the end</span>".into()
        }
        (false, _) => "<span class=\"no\">not done</span>".into(),
    };
    format!(
        "<li>{me} <span class=\"body\">{size}, {strength}{knowledge}</span>{stance} wants to {goal} {outcome}\
         <div class=\"now\" data-agent=\"{who}\"{done}><span class=\"label\">now</span> \
         <span class=\"subgoal\">–</span> <span class=\"share\"></span></div></li>\n",
        done = agent.steps_to_goal.map_or_else(String::new, |steps| format!(" data-done=\"{steps}\"")),
        me = chip(Fragment::Entity(Entity::Agent(who))),
    )
}

/// A piece of a sentence as HTML; things that have a colour in the video have it here.
fn chip(piece: Fragment) -> String {
    let class = match piece {
        Fragment::Text(text) => return escape(text),
        Fragment::Entity(Entity::Agent(agent)) => format!("agent agent{agent}"),
        Fragment::Entity(Entity::Object(object)) => format!("object object{object}"),
        Fragment::Landmark(landmark) => format!("landmark landmark{landmark}"),
    };
    format!("<span class=\"chip {class}\">{}</span>", escape(&Names::PAPER.plain(&[piece])))
}
