//! The videos of a configuration.

use super::{CatchTrial, Labels, Stimulus};
use crate::{
    forms::{Form, Forms, GOALS, MOST_OBJECTS, RELATION},
    question::Question,
};
use phase_model::{
    EventKind, Relation,
    json::{Field, FieldError},
    path::RelativePath,
};
use std::collections::{BTreeMap, BTreeSet};

/// The stimuli and the catch trials.
pub(super) fn read(
    root: &Field<'_>,
    form: Form,
    forms: &Forms,
) -> Result<(Vec<Stimulus>, Vec<CatchTrial>), FieldError> {
    let field = root.required("stimuli")?;
    let stimuli: Vec<Stimulus> =
        field.items()?.map(|item| stimulus(&item, forms)).collect::<Result<_, FieldError>>()?;
    if stimuli.is_empty() {
        return Err(field.error("must hold at least one video"));
    }
    let trials = match root.optional("catch_trials")? {
        Some(field) => {
            field.items()?.map(|item| catch_trial(&item, form, forms)).collect::<Result<_, FieldError>>()?
        }
        None => Vec::<CatchTrial>::new(),
    };
    let ids = stimuli.iter().map(|it| it.id.as_str()).chain(trials.iter().map(|it| it.id.as_str()));
    let videos = stimuli.iter().map(|it| it.video.as_str()).chain(trials.iter().map(|it| it.video.as_str()));
    distinct(&field, ids)?;
    distinct(&field, videos)?;
    Ok((stimuli, trials))
}

/// Checks that no name occurs twice.
pub(super) fn distinct<'a>(
    field: &Field<'_>,
    names: impl Iterator<Item = &'a str>,
) -> Result<(), FieldError> {
    let mut seen = BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(field.error(format!("must not have {name:?} twice")));
        }
    }
    Ok(())
}

fn stimulus(field: &Field<'_>, forms: &Forms) -> Result<Stimulus, FieldError> {
    field.only(&["id", "video", "source", "objects", "set", "condition", "goals", "relation", "kind"])?;
    let objects = objects(field)?;
    let name = |name: &str| field.optional(name)?.map(|field| id(&field)).transpose();
    let (source, set, condition) = (name("source")?, name("set")?, name("condition")?);
    let relations = [Relation::Friendly, Relation::Neutral, Relation::Adversarial]
        .map(|relation| (relation.name(), relation.name()));
    let kinds = EventKind::ALL.map(|kind| (kind.name(), kind.name()));
    let word = |name: &str, words: &[(&str, &'static str)]| -> Result<Option<String>, FieldError> {
        Ok(field.optional(name)?.map(|field| field.one_of(words)).transpose()?.map(str::to_owned))
    };
    let labels = Labels {
        goals: field.optional("goals")?.map(|goals| known_goals(&goals, objects, forms)).transpose()?,
        relation: word(RELATION, &relations)?,
        kind: word("kind", &kinds)?,
    };
    Ok(Stimulus {
        id: id(&field.required("id")?)?,
        video: video(&field.required("video")?)?,
        source: source.unwrap_or_else(|| "phase".into()),
        objects,
        set,
        condition,
        labels,
    })
}

fn catch_trial(field: &Field<'_>, form: Form, forms: &Forms) -> Result<CatchTrial, FieldError> {
    field.only(&["id", "video", "objects", "expected"])?;
    let objects = objects(field)?;
    let questions = forms.questions(form, objects);
    let expected = field.required("expected")?;
    let names: Vec<&str> = questions.iter().map(|question| question.name.as_str()).collect();
    expected.only(&names)?;
    let mut wanted = BTreeMap::new();
    for question in &questions {
        if let Some(answers) = expected.optional(&question.name)? {
            wanted.insert(question.name.clone(), choices(&answers, question)?);
        }
    }
    if wanted.is_empty() {
        return Err(expected.error(format!("must have at least one of {}", names.join(", "))));
    }
    Ok(CatchTrial {
        id: id(&field.required("id")?)?,
        video: video(&field.required("video")?)?,
        objects,
        expected: wanted,
    })
}

/// One choice of a question, or a list of some.
fn choices(field: &Field<'_>, question: &Question) -> Result<BTreeSet<String>, FieldError> {
    let known: Vec<(&str, &str)> =
        question.kind.choices().iter().map(|choice| (choice.value.as_str(), choice.value.as_str())).collect();
    if !field.value().is_array() {
        return Ok(BTreeSet::from([field.one_of(&known)?.to_owned()]));
    }
    let chosen: BTreeSet<String> = field
        .items()?
        .map(|item| item.one_of(&known).map(str::to_owned))
        .collect::<Result<_, FieldError>>()?;
    if chosen.is_empty() { Err(field.error("must have at least one choice")) } else { Ok(chosen) }
}

fn known_goals(field: &Field<'_>, objects: u8, forms: &Forms) -> Result<[BTreeSet<String>; 2], FieldError> {
    let questions = forms.questions(Form::Goals, objects);
    let agents: Vec<Field<'_>> = field.items()?.collect();
    let [first, second] = &agents[..] else { return Err(field.must_be("a list for each of two agents")) };
    let of = |agent: &Field<'_>, name: &str| {
        let question = questions.iter().find(|question| question.name == name);
        question.map_or_else(|| Err(agent.error("is not asked about")), |question| choices(agent, question))
    };
    Ok([of(first, GOALS[0])?, of(second, GOALS[1])?])
}

fn objects(field: &Field<'_>) -> Result<u8, FieldError> {
    let number = field
        .optional("objects")?
        .map_or(Ok(i64::from(MOST_OBJECTS)), |it| it.whole(0, MOST_OBJECTS.into()))?;
    Ok(u8::try_from(number).unwrap_or_default())
}

fn id(field: &Field<'_>) -> Result<String, FieldError> {
    let id = field.text()?;
    let letters = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte);
    let fits = (1..=100).contains(&id.len()) && id.bytes().all(letters);
    if fits { Ok(id.into()) } else { Err(field.must_be("1 to 100 letters, digits, -, _ and .")) }
}

/// A path below the folder of the configuration.
fn video(field: &Field<'_>) -> Result<String, FieldError> {
    let path = field.text()?;
    if path.ends_with(".mp4") && RelativePath::new(path).is_ok() {
        Ok(path.into())
    } else {
        Err(field.must_be("the path of an .mp4 file, relative to the configuration and below its folder"))
    }
}
