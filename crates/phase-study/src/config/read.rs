//! Reading a configuration.

use super::{
    Completion, ConfigError, GroupSize, MINUTES, PARAMETERS, STUDY_FORMAT, StudyConfig, raters_needed,
    stimuli::{self, distinct},
};
use crate::{
    forms::{Form, Forms},
    question::{Choice, Kind, Question},
};
use phase_model::json::{Field, FieldError, check_format, parse};

const MEMBERS: [&str; 23] = [
    "format",
    "name",
    "title",
    "form",
    "introduction",
    "consent",
    "instructions",
    "demographics",
    "stimuli",
    "catch_trials",
    "catch_failures_allowed",
    "raters_per_video",
    "raters_per_video_at_most",
    "videos_per_rater",
    "between_sources",
    "one_of_each_set",
    "answer_before_end",
    "raters",
    "completion",
    "parameters",
    "identity_required",
    "minutes",
    "seed",
];

/// Most videos, raters and the like.
const MOST: i64 = 1_000_000;
/// Most letters of a paragraph.
const LONGEST_PARAGRAPH: usize = 20_000;
/// Most letters of a title, question, choice or code.
const LONGEST_LINE: usize = 500;

impl StudyConfig {
    /// Reads a configuration. What its stimuli may be asked is decided by `forms`.
    ///
    /// # Errors
    /// [`ConfigError`], naming the field and the rule.
    pub fn read(bytes: &[u8], forms: &Forms) -> Result<Self, ConfigError> {
        let document = parse(bytes)?;
        check_format(&document, STUDY_FORMAT)?;
        Ok(config(&Field::root(&document), forms)?)
    }
}

fn config(root: &Field<'_>, forms: &Forms) -> Result<StudyConfig, FieldError> {
    root.only(&MEMBERS)?;
    let form = root.required("form")?.one_of(&Form::ALL.map(|form| (form.name(), form)))?;
    let (stimuli, catch_trials) = stimuli::read(root, form, forms)?;
    let count = |name: &str, from: i64, to: i64| Ok(narrow(root.required(name)?.whole(from, to)?));
    let optional = |name: &str, from: i64, to: i64| -> Result<Option<u32>, FieldError> {
        Ok(root.optional(name)?.map(|field| field.whole(from, to)).transpose()?.map(narrow))
    };
    let raters_per_video = count("raters_per_video", 1, MOST)?;
    let at_most = optional("raters_per_video_at_most", raters_per_video.into(), MOST)?;
    let videos_per_rater = count("videos_per_rater", 1, stimuli.len() as i64)?;
    let allowed = optional("catch_failures_allowed", 0, catch_trials.len() as i64)?;
    let mut config = StudyConfig {
        name: name(&root.required("name")?)?,
        title: line(&root.required("title")?)?,
        form,
        introduction: root
            .optional("introduction")?
            .map(|field| paragraphs(&field))
            .transpose()?
            .unwrap_or_default(),
        consent: some(&root.required("consent")?)?,
        instructions: some(&root.required("instructions")?)?,
        demographics: demographics(root)?,
        stimuli,
        catch_trials,
        catch_failures_allowed: allowed.unwrap_or_default(),
        raters_per_video,
        raters_per_video_at_most: at_most.unwrap_or(raters_per_video),
        videos_per_rater,
        between_sources: truth(root, "between_sources")?,
        one_of_each_set: truth(root, "one_of_each_set")?,
        answer_before_end: truth(root, "answer_before_end")?,
        raters: 0,
        completion: completion(root)?,
        parameters: parameters(root)?,
        identity_required: truth(root, "identity_required")?,
        minutes: optional("minutes", 1, MOST)?.unwrap_or(MINUTES),
        seed: root.optional("seed")?.map_or(Ok(1), |field| field.whole(0, i64::MAX))?.unsigned_abs(),
    };
    if config.between_sources && config.sources().len() < 2 {
        return Err(root.required("between_sources")?.error("needs stimuli of at least two sources"));
    }
    if config.identity_required && config.parameters.is_empty() {
        return Err(root.required("identity_required")?.error("needs at least one of `parameters`"));
    }
    if config.one_of_each_set && config.stimuli.iter().all(|stimulus| stimulus.set.is_none()) {
        return Err(root.required("one_of_each_set")?.error("needs stimuli with a `set`"));
    }
    let size =
        |group: &Vec<usize>| GroupSize::of(group.iter().map(|&k| &config.stimuli[k]), config.one_of_each_set);
    let groups: Vec<GroupSize> = config.groups().iter().map(size).collect();
    let most = groups.iter().map(|group| group.for_one).max().unwrap_or_default();
    if config.one_of_each_set && videos_per_rater as usize > most {
        let rule = format!("must be at most {most}: with `one_of_each_set` a rater sees no more");
        return Err(root.required("videos_per_rater")?.error(rule));
    }
    let needed = raters_needed(&groups, raters_per_video, videos_per_rater);
    config.raters = optional("raters", 1, MOST)?.unwrap_or(needed);
    Ok(config)
}

/// A number that was checked to be in a range from 0 to [`MOST`].
fn narrow(number: i64) -> u32 {
    u32::try_from(number).unwrap_or_default()
}

/// The name of a study.
pub(super) fn name(field: &Field<'_>) -> Result<String, FieldError> {
    let name = field.text()?;
    let letters = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
    let fits = (1..=64).contains(&name.len()) && name.bytes().all(letters);
    if !fits || name.starts_with('-') || name.ends_with('-') {
        return Err(field.must_be("1 to 64 small letters, digits and - inside"));
    }
    Ok(name.into())
}

/// A line of text that is not empty.
pub(super) fn line(field: &Field<'_>) -> Result<String, FieldError> {
    let text = field.text()?;
    if text.trim().is_empty() || text.chars().count() > LONGEST_LINE || text.chars().any(char::is_control) {
        return Err(field.error(format!("must be one line of 1 to {LONGEST_LINE} letters")));
    }
    Ok(text.into())
}

fn paragraphs(field: &Field<'_>) -> Result<Vec<String>, FieldError> {
    let read = |item: Field<'_>| {
        let text = item.text()?;
        let fits = !text.trim().is_empty() && text.chars().count() <= LONGEST_PARAGRAPH;
        if fits {
            Ok(text.to_owned())
        } else {
            Err(item.error(format!("must have 1 to {LONGEST_PARAGRAPH} letters")))
        }
    };
    field.items()?.map(read).collect()
}

/// At least one paragraph.
fn some(field: &Field<'_>) -> Result<Vec<String>, FieldError> {
    let paragraphs = paragraphs(field)?;
    if paragraphs.is_empty() { Err(field.error("must have at least one paragraph")) } else { Ok(paragraphs) }
}

/// A truth value, false if it is absent.
fn truth(field: &Field<'_>, name: &str) -> Result<bool, FieldError> {
    let Some(field) = field.optional(name)? else { return Ok(false) };
    field.value().as_bool().ok_or_else(|| field.must_be("true or false"))
}

fn completion(root: &Field<'_>) -> Result<Completion, FieldError> {
    let Some(field) = root.optional("completion")? else { return Ok(Completion::default()) };
    field.only(&["code", "url"])?;
    let code = field.optional("code")?.map(|code| line(&code)).transpose()?;
    let url = field.optional("url")?;
    let url = url.map(|url| {
        let text = url.text()?;
        let plain = text.bytes().all(|byte| byte.is_ascii_graphic() && !b"\"'<>\\^`{|}".contains(&byte));
        let host = text.strip_prefix("https://").and_then(|rest| rest.split(['/', '?', '#']).next());
        let fits =
            plain && text.len() <= 2000 && host.is_some_and(|host| !host.is_empty() && !host.contains('@'));
        if fits { Ok(text.to_owned()) } else { Err(url.must_be("an address that begins with https://")) }
    });
    Ok(Completion { code, url: url.transpose()? })
}

fn parameters(root: &Field<'_>) -> Result<Vec<String>, FieldError> {
    let Some(field) = root.optional("parameters")? else { return Ok(PARAMETERS.map(str::to_owned).into()) };
    let read = |item: Field<'_>| {
        let name = item.text()?;
        let letters = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
        let fits = (1..=64).contains(&name.len()) && name.bytes().all(letters);
        if fits { Ok(name.to_owned()) } else { Err(item.must_be("1 to 64 letters, digits and _")) }
    };
    let names: Vec<String> = field.items()?.map(read).collect::<Result<_, FieldError>>()?;
    distinct(&field, names.iter().map(String::as_str))?;
    Ok(names)
}

fn demographics(root: &Field<'_>) -> Result<Vec<Question>, FieldError> {
    let Some(field) = root.optional("demographics")? else { return Ok(Vec::new()) };
    let questions: Vec<Question> =
        field.items()?.map(|item| demographic(&item)).collect::<Result<_, FieldError>>()?;
    distinct(&field, questions.iter().map(|question| question.name.as_str()))?;
    Ok(questions)
}

fn demographic(field: &Field<'_>) -> Result<Question, FieldError> {
    let name_field = field.required("name")?;
    let name = name_field.text()?;
    let letters = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
    let starts = name.bytes().next().is_some_and(|byte| byte.is_ascii_lowercase());
    if !starts || name.len() > 40 || !name.bytes().all(letters) {
        return Err(name_field.must_be("a small letter and at most 39 small letters, digits and _"));
    }
    let common = ["name", "text", "kind", "required"];
    let only = |more: &[&str]| field.only(&[&common[..], more].concat());
    let kind = match field.required("kind")?.one_of(&["whole", "one", "text"].map(|kind| (kind, kind)))? {
        "whole" => {
            only(&["from", "to"])?;
            let from = field.required("from")?.whole(-MOST, MOST)?;
            Kind::Whole { from, to: field.required("to")?.whole(from, MOST)? }
        }
        "one" => {
            only(&["choices"])?;
            let choices = field.required("choices")?;
            let texts: Vec<String> =
                choices.items()?.map(|choice| line(&choice)).collect::<Result<_, FieldError>>()?;
            if texts.len() < 2 {
                return Err(choices.error("must have at least two choices"));
            }
            distinct(&choices, texts.iter().map(String::as_str))?;
            Kind::One {
                choices: texts.into_iter().map(|text| Choice { value: text.clone(), text }).collect(),
            }
        }
        _ => {
            only(&["longest"])?;
            let longest = field.optional("longest")?.map_or(Ok(200), |field| field.whole(1, 5000))?;
            Kind::Text { longest: usize::try_from(longest).unwrap_or_default() }
        }
    };
    Ok(Question {
        name: name.into(),
        text: line(&field.required("text")?)?,
        kind,
        optional: !truth(field, "required")?,
    })
}
