//! Questions and answers to them.

use phase_model::json::{Field, FieldError};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// One of the answers that a question offers.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Choice {
    /// The text that is stored.
    pub value: String,
    /// The text that is shown.
    pub text: String,
}

/// The kind of answer that a question wants.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Kind {
    /// At least one of several choices.
    Many {
        /// The choices.
        choices: Vec<Choice>,
    },
    /// One of a few choices, all in sight.
    One {
        /// The choices.
        choices: Vec<Choice>,
    },
    /// One of many choices, in a list.
    List {
        /// The choices.
        choices: Vec<Choice>,
    },
    /// A whole number in a range, both ends included.
    Whole {
        /// The least number.
        from: i64,
        /// The greatest.
        to: i64,
    },
    /// A line of text.
    Text {
        /// Most letters (Unicode scalar values).
        longest: usize,
    },
}

impl Kind {
    /// The choices, of the kinds that have some.
    #[must_use]
    pub fn choices(&self) -> &[Choice] {
        match self {
            Self::Many { choices } | Self::One { choices } | Self::List { choices } => choices,
            Self::Whole { .. } | Self::Text { .. } => &[],
        }
    }

    /// The name in files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Many { .. } => "many",
            Self::One { .. } => "one",
            Self::List { .. } => "list",
            Self::Whole { .. } => "whole",
            Self::Text { .. } => "text",
        }
    }
}

/// A question. As JSON it is what the page shows: `name`, `text`, `kind` with its members, and `optional`.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Question {
    /// The member of the answer.
    pub name: String,
    /// The question, as it is shown.
    pub text: String,
    /// The kind of answer that it wants.
    #[serde(flatten)]
    pub kind: Kind,
    /// Whether it may be left out.
    pub optional: bool,
}

/// The answer to one question.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Given {
    /// A whole number.
    Number(i64),
    /// A choice or a line of text.
    Text(String),
    /// Several choices.
    Many(BTreeSet<String>),
}

impl Given {
    /// The choice or text; `None` of the other kinds.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            Self::Number(_) | Self::Many(_) => None,
        }
    }

    /// Whether a choice is what was chosen, or among it.
    #[must_use]
    pub fn has(&self, choice: &str) -> bool {
        match self {
            Self::Text(text) => text == choice,
            Self::Many(several) => several.contains(choice),
            Self::Number(_) => false,
        }
    }
}

/// Answers to questions by their names. Those to optional questions may be absent.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Responses(pub BTreeMap<String, Given>);

impl Responses {
    /// Reads the answer to some questions, a JSON object with a member for each.
    ///
    /// # Errors
    /// If a member is missing or unknown, is of another kind, or is not among the choices.
    pub fn read(field: &Field<'_>, questions: &[Question]) -> Result<Self, FieldError> {
        let names: Vec<&str> = questions.iter().map(|question| question.name.as_str()).collect();
        field.only(&names)?;
        let mut answers = BTreeMap::new();
        for question in questions {
            let answered = match field.optional(&question.name)? {
                Some(answered) => given(&answered, &question.kind)?,
                None if question.optional => continue,
                None => return Err(field.required(&question.name)?.must_be("an answer")),
            };
            answers.insert(question.name.clone(), answered);
        }
        Ok(Self(answers))
    }

    /// Checks that everything answered is asked by some questions, and offered by them. Answers to questions
    /// that were added later are missing.
    #[cfg(feature = "store")]
    pub(crate) fn check(&self, questions: &[Question]) -> Result<(), FieldError> {
        let answers = self.to_json();
        let root = Field::root(&answers);
        let names: Vec<&str> = questions.iter().map(|question| question.name.as_str()).collect();
        root.only(&names)?;
        for question in questions {
            if let Some(answered) = root.optional(&question.name)? {
                given(&answered, &question.kind)?;
            }
        }
        Ok(())
    }

    /// The answer to one question.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Given> {
        self.0.get(name)
    }

    /// The answer as JSON, the same text for the same answer.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let given = |given: &Given| match given {
            Given::Number(number) => Value::from(*number),
            Given::Text(text) => Value::from(text.as_str()),
            Given::Many(several) => several.iter().map(String::as_str).collect(),
        };
        self.0.iter().map(|(name, answer)| (name.clone(), given(answer))).collect()
    }
}

fn given(field: &Field<'_>, kind: &Kind) -> Result<Given, FieldError> {
    match kind {
        Kind::Many { choices } => {
            let chosen: BTreeSet<String> =
                field.items()?.map(|item| choice(&item, choices)).collect::<Result<_, _>>()?;
            if chosen.is_empty() {
                return Err(field.error("must have at least one choice"));
            }
            Ok(Given::Many(chosen))
        }
        Kind::One { choices } | Kind::List { choices } => choice(field, choices).map(Given::Text),
        Kind::Whole { from, to } => field.whole(*from, *to).map(Given::Number),
        Kind::Text { longest } => {
            let text = field.text()?;
            if text.is_empty() || text.chars().count() > *longest || text.chars().any(char::is_control) {
                return Err(field.error(format!("must be one line of 1 to {longest} letters")));
            }
            Ok(Given::Text(text.into()))
        }
    }
}

fn choice(field: &Field<'_>, choices: &[Choice]) -> Result<String, FieldError> {
    let named: Vec<(&str, &str)> =
        choices.iter().map(|choice| (choice.value.as_str(), choice.value.as_str())).collect();
    field.one_of(&named).map(str::to_owned)
}
