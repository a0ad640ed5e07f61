//! The three forms, each a list of questions about a video, from the data that all pages share
//! (`data/forms.json`).

use crate::question::{Choice, Kind, Question};
use phase_model::json::{Field, FieldError, JsonError, check_format, parse_text};
use std::collections::BTreeMap;
use thiserror::Error;

/// The value of the field `format` of forms.
pub const FORMS_FORMAT: &str = "phase-forms/1";
/// Most objects that a video shows.
pub(crate) const MOST_OBJECTS: u8 = 2;

/// Name of the question about types of interaction.
pub const INTERACTIONS: &str = "interactions";
/// Names of the questions about the goals of agents 0 and 1.
pub const GOALS: [&str; 2] = ["goal_0", "goal_1"];
/// Name of the question about the relation.
pub const RELATION: &str = "relation";
/// Name of the question about human-likeness.
pub(crate) const HUMAN_LIKENESS: &str = "human_likeness";

/// A form.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Form {
    /// The types of interaction that the video shows (the paper's Experiment 1).
    Interactions,
    /// The goals of both agents, their relation, and how likely people would behave like this (its Experiment
    /// 2).
    Goals,
    /// Whether the two are friendly, neutral or adversarial (Malik and Isik 2023).
    Relation,
}

impl Form {
    /// All forms.
    pub const ALL: [Self; 3] = [Self::Interactions, Self::Goals, Self::Relation];

    /// The name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interactions => "interactions",
            Self::Goals => "goals",
            Self::Relation => "relation",
        }
    }
}

/// Why the data of the forms cannot be used.
#[derive(Debug, Error)]
pub enum FormsError {
    /// It is not JSON of the format.
    #[error("forms: {0}")]
    Json(#[from] JsonError),
    /// A field breaks a rule.
    #[error("forms: {0}")]
    Field(#[from] FieldError),
}

/// A choice and the fewest objects in the video for which it is offered.
#[derive(Clone, Debug)]
struct Offer {
    choice: Choice,
    objects: u8,
}

/// Makes the kind of a question of its choices.
type MakeKind = fn(Vec<Choice>) -> Kind;

/// A question as the data has it.
#[derive(Clone, Debug)]
struct Entry {
    name: String,
    text: String,
    kind: MakeKind,
    choices: Vec<Offer>,
}

/// The questions of all forms.
#[derive(Clone, Debug)]
pub struct Forms {
    entries: BTreeMap<Form, Vec<Entry>>,
}

impl Forms {
    /// The forms that come with PHASE.
    ///
    /// # Errors
    /// As [`Forms::read`]; a test makes sure that there are none.
    pub fn included() -> Result<Self, FormsError> {
        Self::read(phase_data::FORMS)
    }

    /// Reads forms (`phase-forms/1`, `docs/reference/formats/studies.md`).
    ///
    /// # Errors
    /// [`FormsError`].
    pub fn read(text: &str) -> Result<Self, FormsError> {
        let document = parse_text(text)?;
        check_format(&document, FORMS_FORMAT)?;
        let root = Field::root(&document);
        root.only(&["format", "choices", "forms"])?;
        let choices = root.required("choices")?;
        let forms = root.required("forms")?;
        forms.only(&Form::ALL.map(Form::name))?;
        let mut entries = BTreeMap::new();
        for form in Form::ALL {
            let questions = forms.required(form.name())?;
            let read = questions.items()?.map(|question| entry(&question, &choices));
            entries.insert(form, read.collect::<Result<_, FieldError>>()?);
        }
        Ok(Self { entries })
    }

    /// The questions of a form about a video with so many objects, 0 to 2, in order.
    #[must_use]
    pub fn questions(&self, form: Form, objects: u8) -> Vec<Question> {
        let ask = |entry: &Entry| {
            let offered = entry.choices.iter().filter(|offer| offer.objects <= objects);
            let kind = (entry.kind)(offered.map(|offer| offer.choice.clone()).collect());
            Question { name: entry.name.clone(), text: entry.text.clone(), kind, optional: false }
        };
        self.entries.get(&form).into_iter().flatten().map(ask).collect()
    }
}

fn entry(question: &Field<'_>, choices: &Field<'_>) -> Result<Entry, FieldError> {
    question.only(&["name", "text", "kind", "choices"])?;
    let kinds: [(&str, MakeKind); 3] = [
        ("many", |choices| Kind::Many { choices }),
        ("one", |choices| Kind::One { choices }),
        ("list", |choices| Kind::List { choices }),
    ];
    let offers = choices.required(question.required("choices")?.text()?)?;
    Ok(Entry {
        name: question.required("name")?.text()?.into(),
        text: question.required("text")?.text()?.into(),
        kind: question.required("kind")?.one_of(&kinds)?,
        choices: offers.items()?.map(|offer| read_offer(&offer)).collect::<Result<_, _>>()?,
    })
}

fn read_offer(offer: &Field<'_>) -> Result<Offer, FieldError> {
    offer.only(&["value", "text", "objects"])?;
    let objects = offer.optional("objects")?.map(|field| field.whole(0, MOST_OBJECTS.into())).transpose()?;
    let choice = Choice {
        value: offer.required("value")?.text()?.into(),
        text: offer.required("text")?.text()?.into(),
    };
    Ok(Offer { choice, objects: objects.and_then(|number| u8::try_from(number).ok()).unwrap_or_default() })
}
