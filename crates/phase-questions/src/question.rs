//! Questions and their parts.

use crate::Query;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// One question with its options, its answer and the proof of it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// Its name, unique in a benchmark.
    pub id: String,
    /// The subject; its `type` is the question's type.
    pub query: Query,
    /// The events that are shown: one, or two side by side.
    pub events: Vec<String>,
    /// The name of the video; several questions share one.
    pub video: String,
    /// The set of the events, if they are in one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub set: Option<String>,
    /// The last step of the event that the video shows, where it does not show all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<usize>,
    /// The question.
    pub text: String,
    /// Its options, at least two.
    pub options: Vec<Choice>,
    /// The right option, by its index.
    pub answer: usize,
    /// The least number of frames, uniformly spaced from the first to the last, from which and from all
    /// greater numbers of [`BUDGETS`](crate::BUDGETS) it was answered right; none if it never was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<FrameBudget>,
    /// The share of people for each option, where people were asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p_human: Option<Vec<f64>>,
    /// A group of questions among which all answers are equally frequent: those that are alike in whatever of
    /// the words and of the first frame could give the answer away.
    pub stratum: String,
    /// Why the answer is right: fields, simulations, probabilities.
    pub proof: Value,
}

/// An option.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Its value, see [`Query`].
    pub value: String,
    /// Its text.
    pub text: String,
}

/// A number of frames of a video.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FrameBudget {
    /// All.
    All,
    /// So many.
    #[serde(untagged)]
    Frames(usize),
}

impl FrameBudget {
    /// The number for tables: 0 stands for all.
    #[must_use]
    pub const fn number(self) -> usize {
        match self {
            Self::Frames(frames) => frames,
            Self::All => 0,
        }
    }
}

/// Material that is shown with a question.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Control {
    /// The video: no control.
    Video,
    /// Nothing.
    NoVideo,
    /// The first frame.
    FirstFrame,
    /// All frames in random order.
    Shuffled,
    /// All frames from the last to the first.
    Reversed,
    /// The event in words, and a table of positions.
    Text,
    /// The video; one option is "none of these", and right where the right one is missing.
    NoneOfThese,
    /// The video, and no options: the answer is in words, see [`parse_free`](crate::parse_free).
    FreeForm,
}

impl Control {
    /// All, the video first.
    pub const ALL: [Self; 8] = [
        Self::Video,
        Self::NoVideo,
        Self::FirstFrame,
        Self::Shuffled,
        Self::Reversed,
        Self::Text,
        Self::NoneOfThese,
        Self::FreeForm,
    ];

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Video => "video",
            Self::NoVideo => "no-video",
            Self::FirstFrame => "first-frame",
            Self::Shuffled => "shuffled",
            Self::Reversed => "reversed",
            Self::Text => "text",
            Self::NoneOfThese => "none-of-these",
            Self::FreeForm => "free-form",
        }
    }

    /// The control of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|control| control.name() == name)
    }
}

/// The text of the option that no other is right.
pub const NONE: &str = "none of these";

impl Question {
    /// The letter of an option: `A`, `B` …
    #[must_use]
    pub fn letter(option: usize) -> char {
        char::from(b'A' + u8::try_from(option % 26).unwrap_or_default())
    }

    /// The options and the right one as a control shows them.
    ///
    /// Under [`Control::NoneOfThese`] one option of n is replaced by [`NONE`]: the right one in one of n
    /// questions, so that it is right as often as any other.
    #[must_use]
    pub fn shown(&self, control: Control) -> (Vec<&str>, usize) {
        let mut texts: Vec<&str> = self.options.iter().map(|option| option.text.as_str()).collect();
        if control == Control::NoneOfThese && !texts.is_empty() {
            let hash = self.id.bytes().fold(7usize, |hash, byte| hash.wrapping_mul(31) ^ usize::from(byte));
            texts[hash % self.options.len()] = NONE;
        }
        (texts, self.answer)
    }

    /// The question with its options, as a model reads it.
    #[must_use]
    pub fn prompt(&self, control: Control) -> String {
        if control == Control::FreeForm {
            return self.text.clone();
        }
        let (texts, _) = self.shown(control);
        let options = texts.iter().enumerate().map(|(k, text)| format!("\n{}. {text}", Self::letter(k)));
        format!("{}{}", self.text, options.collect::<String>())
    }
}

/// The option that a free answer names: a letter alone or first, or the text of one option alone; `None` if
/// it names none or several.
#[must_use]
pub fn parse_answer(answer: &str, options: &[&str]) -> Option<usize> {
    let plain = answer.trim().trim_start_matches(['(', '[', '*', '"', '\'', ' ']);
    let mut letters = plain.chars();
    let first = letters.next()?;
    let next = letters.next();
    let index = (first.to_ascii_uppercase() as usize).wrapping_sub('A' as usize);
    let ends = next.is_none_or(|next| matches!(next, '.' | ')' | ']' | ':' | ',' | '*' | '"' | '\'' | '\n'));
    if first.is_ascii_uppercase() && (ends || next == Some(' ') && options.len() > index && first != 'A')
        || first.is_ascii_lowercase() && ends
    {
        return (index < options.len()).then_some(index);
    }
    let lower = answer.to_lowercase();
    if let Some((_, rest)) = lower.rsplit_once("answer") {
        let rest = rest.trim_start_matches([' ', ':', '*', '(', '"']).trim_start_matches("is ");
        let rest = rest.trim_start_matches([' ', ':', '*', '(', '"']);
        let mut letters = rest.chars();
        if let (Some(letter), next) = (letters.next(), letters.next()) {
            let index = (letter as usize).wrapping_sub('a' as usize);
            if index < options.len() && next.is_none_or(|next| !next.is_alphanumeric()) {
                return Some(index);
            }
        }
    }
    let named = (0..options.len()).filter(|&k| is_named(&lower, &options[k].to_lowercase()));
    let named: Vec<usize> = named.collect();
    match named[..] {
        [one] => Some(one),
        _ => None,
    }
}

/// Whether a text has these words, and not only as a part of longer ones.
pub(crate) fn is_named(text: &str, words: &str) -> bool {
    text.match_indices(words).any(|(at, found)| {
        let before = text[..at].chars().next_back();
        let after = text[at + found.len()..].chars().next();
        !before.is_some_and(char::is_alphanumeric) && !after.is_some_and(char::is_alphanumeric)
    })
}
