//! Answers in words to questions whose options are not shown.

use crate::{Query, question::is_named};
use phase_model::{
    AgentId, Entity, LandmarkId, Relation,
    words::{Names, corner},
};

/// Words that name a value.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Accepted {
    /// The value, see [`Query`].
    pub value: String,
    /// Words that name it anywhere in an answer.
    pub anywhere: Vec<String>,
    /// Words that name it if the answer has no others.
    pub alone: Vec<String>,
}

/// All values of a question's type and the words that name them; empty for types that are asked with options
/// only (`kind`, `without`).
#[must_use]
pub fn accepted(query: &Query, names: &Names) -> Vec<Accepted> {
    let owned = |words: &[&str]| words.iter().map(|&word| word.to_owned()).collect::<Vec<_>>();
    let plain = |value: &str, words: &[&str]| Accepted {
        value: value.to_owned(),
        anywhere: owned(words),
        alone: Vec::new(),
    };
    let agents = || {
        AgentId::ALL.into_iter().map(|agent| {
            let name = names.entity(Entity::Agent(agent));
            let colour = name.split(' ').next().unwrap_or_default().to_owned();
            Accepted { value: agent.to_string(), anywhere: vec![name], alone: vec![colour] }
        })
    };
    let neither = || plain("neither", &["neither", "none", "nobody", "no one"]);
    let corners = |landmark: LandmarkId| {
        let corner = corner(landmark);
        vec![corner.to_owned(), corner.replace("top", "upper").replace("bottom", "lower")]
    };
    match query {
        Query::Relation => vec![
            plain(Relation::Friendly.name(), &["friendly", "cooperative"]),
            plain(Relation::Adversarial.name(), &["adversarial", "hostile"]),
            plain(Relation::Neutral.name(), &["neutral", "independent"]),
        ],
        Query::Goal { .. } => {
            let of = |landmark: LandmarkId| {
                let name = names.landmark(landmark);
                let colour = name.split(' ').next().unwrap_or_default().to_owned();
                let mut anywhere = corners(landmark);
                anywhere.extend([format!("{colour} square"), name]);
                Accepted { value: landmark.to_string(), anywhere, alone: vec![colour] }
            };
            LandmarkId::ALL.map(of).to_vec()
        }
        Query::EndRoom { .. }
        | Query::RoomAt { .. }
        | Query::EntersFirst { .. }
        | Query::Believes { .. }
        | Query::Expects { .. }
        | Query::LooksNext { .. }
        | Query::Ahead { .. } => {
            let of = |landmark: LandmarkId| Accepted {
                value: landmark.to_string(),
                anywhere: corners(landmark),
                alone: Vec::new(),
            };
            LandmarkId::ALL.map(of).to_vec()
        }
        Query::Stronger | Query::FirstTouch { .. } => agents().collect(),
        Query::Carrier { .. } => agents().chain([plain("both", &["both"]), neither()]).collect(),
        Query::Role => agents().chain([neither()]).collect(),
        Query::Seen { .. } | Query::IsRight { .. } => vec![plain("yes", &["yes"]), plain("no", &["no"])],
        Query::PairHelp | Query::PairHinder | Query::PairTogether => {
            vec![plain("0", &["left"]), plain("1", &["right"])]
        }
        Query::Kind | Query::Without { .. } => Vec::new(),
    }
}

/// The value that an answer in words names; `None` if it names none or several.
///
/// Case, hyphens, punctuation and the articles at the beginning make no difference. Words count as a whole
/// only.
///
/// ```
/// use phase_model::{AgentId, Entity, words::Names};
/// use phase_questions::{Query, parse_free};
///
/// let goal = Query::Goal { agent: AgentId::ZERO, subject: Entity::Agent(AgentId::ZERO) };
/// let parse = |answer| parse_free(answer, &goal, &Names::PAPER);
/// assert_eq!(parse("Blue."), Some("0".to_owned()));
/// assert_eq!(parse("The red agent goes to the upper-left corner."), Some("0".to_owned()));
/// assert_eq!(parse("The blue landmark or the red landmark."), None);
/// ```
#[must_use]
pub fn parse_free(answer: &str, query: &Query, names: &Names) -> Option<String> {
    let letters = answer.to_lowercase().replace(|letter: char| !letter.is_alphanumeric(), " ");
    let words: Vec<&str> = letters.split_whitespace().collect();
    let text = words.join(" ");
    let bare = text.strip_prefix("the ").unwrap_or(&text);
    let names_it = |it: &Accepted| {
        it.alone.iter().any(|word| word == bare) || it.anywhere.iter().any(|words| is_named(&text, words))
    };
    let mut named = accepted(query, names).into_iter().filter(names_it);
    let first = named.next()?;
    named.next().is_none().then_some(first.value)
}
