//! Conversion between subgoals and their texts.

use phase_model::{AgentId, Entity, LandmarkId, Literal, ObjectId, Predicate, PredicateTarget, Subgoal};
use std::{collections::BTreeMap, sync::LazyLock};

/// The subgoal that is displayed as a text, such as `not Attach(agent 0, object 1)`; `None` for other texts.
///
/// ```
/// use phase_event::subgoal_of;
///
/// let text = "not Attach(agent 0, object 1)";
/// assert_eq!(subgoal_of(text).map(|subgoal| subgoal.to_string()).as_deref(), Some(text));
/// assert_eq!(subgoal_of("Attach(agent 7, object 1)"), None);
/// ```
#[must_use]
pub fn subgoal_of(text: &str) -> Option<Subgoal> {
    // There are so few subgoals that a lookup in the full list is simpler than parsing, and always agrees
    // with the display.
    static BY_TEXT: LazyLock<BTreeMap<String, Subgoal>> =
        LazyLock::new(|| all_subgoals().map(|subgoal| (subgoal.to_string(), subgoal)).collect());
    BY_TEXT.get(text).copied()
}

fn all_subgoals() -> impl Iterator<Item = Subgoal> {
    let entities = || Entity::ALL.into_iter();
    let landmarks = || LandmarkId::ALL.into_iter();
    let agents = || AgentId::ALL.into_iter();
    let on = entities().flat_map(move |entity| landmarks().map(move |to| Predicate::On(entity, to)));
    let touch = agents().flat_map(move |agent| entities().map(move |entity| Predicate::Touch(agent, entity)));
    let attach = agents()
        .flat_map(|agent| ObjectId::ALL.into_iter().map(move |object| Predicate::Attach(agent, object)));
    let close = entities().flat_map(move |entity| {
        let places =
            entities().map(PredicateTarget::Entity).chain(landmarks().map(PredicateTarget::Landmark));
        places.map(move |place| Predicate::Close(entity, place))
    });
    let literals = on
        .chain(touch)
        .chain(attach)
        .chain(close)
        .flat_map(|predicate| [Literal::is(predicate), Literal::not(predicate)]);
    literals.map(Subgoal::Achieve).chain([Subgoal::Stay])
}
