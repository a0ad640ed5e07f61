//! The data that a simulated event stores in addition to its trajectory.

use crate::{
    ActionEvaluation, BelievedIntent, Event, Row, SUBSTEP_COLUMNS, SimulationRecord, Step, SubgoalValue,
    Thought, Trajectory,
    read::{columns, rows},
    subgoals::subgoal_of,
};
use phase_model::{
    AGENT_COUNT, Action, Body, Contacts, Entity, Grip, Intent, MAX_ENTITIES, MAX_OBJECTS, ObjectId, Scene,
    Side, State, Subgoal, Vec2,
    arena::SUBSTEPS,
    json::{Field, FieldError, shown},
    scene_json::{attitude, goal as goal_of},
};
use serde_json::Value;

/// Tolerance of a mean row with respect to the mean of its substeps.
const TOLERANCE: f32 = 1e-3;

/// Reads the simulation of an event that has one (`substeps` is present).
pub(crate) fn simulation_of(
    event: &Field<'_>,
    scene: &mut Scene,
    trajectory: &Trajectory,
) -> Result<Option<SimulationRecord>, FieldError> {
    let Some(substeps) = event.optional("substeps")? else { return Ok(None) };
    Ok(Some(SimulationRecord {
        event: event_of(event, &substeps, scene, trajectory)?,
        generator: event.required("generator")?.text()?.into(),
        settings: event.required("settings")?.value().clone(),
    }))
}

/// The whole event. Its first substep completes the scene's start, since a row does not contain the angular
/// velocity.
pub(crate) fn event_of(
    event: &Field<'_>,
    substeps: &Field<'_>,
    scene: &mut Scene,
    trajectory: &Trajectory,
) -> Result<Event, FieldError> {
    let steps = trajectory.steps();
    let states = states(substeps, scene.objects.len(), 1 + steps * SUBSTEPS)?;
    let actions = actions_of(&of_length(event, "actions", steps)?)?;
    let subgoals = of_length(event, "subgoals", steps)?;
    let thoughts = of_length(event, "thoughts", steps)?.items()?;
    let mut recorded = Vec::with_capacity(steps);
    for (t, ((actions, subgoals), thoughts)) in
        actions.into_iter().zip(subgoals.items()?).zip(thoughts).enumerate()
    {
        let of_step = 1 + t * SUBSTEPS;
        recorded.push(Step {
            actions,
            thoughts: pair(&subgoals, &thoughts)?,
            substeps: core::array::from_fn(|k| states[of_step + k]),
        });
    }
    check_values(&of_length(event, "values", steps)?, &recorded)?;
    for (agent, start) in scene.agents.iter_mut().zip(states[0].bodies) {
        agent.start = start;
    }
    for (object, start) in scene.objects.iter_mut().zip(&states[0].bodies[AGENT_COUNT..]) {
        object.start = *start;
    }
    let event_read = Event {
        scene: scene.clone(),
        seed: seed_of(&event.required("seed")?)?,
        initial: states[0],
        steps: recorded,
    };
    check_means(&event_read, trajectory)?;
    Ok(event_read)
}

/// A seed.
pub(crate) fn seed_of(field: &Field<'_>) -> Result<u64, FieldError> {
    field.value().as_u64().ok_or_else(|| field.must_be("a whole number from 0 to 2^64 - 1"))
}

/// Pairs of actions, by step.
pub(crate) fn actions_of(field: &Field<'_>) -> Result<Vec<[Action; AGENT_COUNT]>, FieldError> {
    let names = Action::ALL.map(|action| (action.name(), action));
    let pair = |field: Field<'_>| {
        let pair = field.items()?.map(|action| action.one_of(&names)).collect::<Result<Vec<_>, _>>()?;
        <[Action; AGENT_COUNT]>::try_from(pair).map_err(|_| field.must_be("two actions"))
    };
    field.items()?.map(pair).collect()
}

fn of_length<'a>(event: &Field<'a>, key: &str, length: usize) -> Result<Field<'a>, FieldError> {
    let field = event.required(key)?;
    let found = field.array()?.len();
    if found == length {
        Ok(field)
    } else {
        let rule = format!("must hold one entry for each of the {length} steps of `trajectory`, not {found}");
        Err(field.error(rule))
    }
}

/// Each agent's `values` repeat what its `thoughts` say of the subgoal that it pursues.
fn check_values(values: &Field<'_>, steps: &[Step]) -> Result<(), FieldError> {
    for (field, step) in values.items()?.zip(steps) {
        let found = field.array()?;
        let expected = step.thoughts.each_ref().map(Thought::pursued);
        let same = |(found, expected): (&Value, &Option<&SubgoalValue>)| match expected {
            Some(proposed) => found.as_f64() == Some(proposed.value),
            None => found.is_null(),
        };
        if found.len() != AGENT_COUNT || !found.iter().zip(&expected).all(same) {
            return Err(field.must_be("what `thoughts` say of the subgoals of both agents"));
        }
    }
    Ok(())
}

fn check_means(event: &Event, trajectory: &Trajectory) -> Result<(), FieldError> {
    let means = Trajectory::means(event);
    let close = |a: &Row, b: &Row| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= TOLERANCE * (1.0 + b.abs()));
    for (expected, found) in means.entities().zip(trajectory.entities()) {
        if let Some(t) = expected.iter().zip(found).position(|(a, b)| !close(a, b)) {
            let rule = format!("must be the means of `substeps`, but row {t} is not");
            return Err(FieldError { field: "trajectory".into(), rule });
        }
    }
    Ok(())
}

/// The state of every frame: the initial one and all substeps.
fn states(field: &Field<'_>, objects: usize, frames: usize) -> Result<Vec<State>, FieldError> {
    field.only(&["columns", "agents", "objects", "grips", "contacts"])?;
    columns(field, &SUBSTEP_COLUMNS)?;
    let mut states = vec![State::new([Body::default(); MAX_ENTITIES]); frames];
    for (group, first, count) in [("agents", 0, AGENT_COUNT), ("objects", AGENT_COUNT, objects)] {
        let tracks = field.required(group)?;
        let items = tracks.items()?;
        if items.len() != count {
            return Err(tracks.error(format!("must hold {count} tracks, not {}", items.len())));
        }
        for (k, track) in items.enumerate() {
            let rows = rows::<{ SUBSTEP_COLUMNS.len() }>(&track)?;
            if rows.len() != frames {
                let found = rows.len();
                let rule = format!("must hold {frames} rows, one and five for each step, not {found}");
                return Err(track.error(rule));
            }
            for (state, [x, y, vx, vy, angle, angular_velocity]) in states.iter_mut().zip(rows) {
                let position = Vec2::new(x, y);
                let velocity = Vec2::new(vx, vy);
                state.bodies[first + k] = Body { position, velocity, angle, angular_velocity };
            }
        }
    }
    let grips = changes(&field.required("grips")?, frames, |value| grips(value, objects))?;
    let contacts = changes(&field.required("contacts")?, frames, |value| contacts(value, objects))?;
    for ((state, grips), contacts) in states.iter_mut().zip(grips).zip(contacts) {
        state.grips = grips;
        state.contacts = contacts;
    }
    Ok(states)
}

/// Expands a list of `[frame, value]`, each of which holds until the next.
fn changes<T: Copy>(
    field: &Field<'_>,
    frames: usize,
    read: impl Fn(&Field<'_>) -> Result<T, FieldError>,
) -> Result<Vec<T>, FieldError> {
    let mut values: Vec<T> = Vec::with_capacity(frames);
    for change in field.items()? {
        let parts: Vec<Field<'_>> = change.items()?.collect();
        let [frame, value] = &parts[..] else { return Err(change.must_be("a frame and what holds from it")) };
        let from = frame.whole(0, frames as i64 - 1)? as usize;
        match values.last().copied() {
            None if from != 0 => return Err(frame.must_be("0 in the first entry")),
            Some(_) if from < values.len() => return Err(frame.must_be("later than the frame before it")),
            None => {}
            Some(last) => values.resize(from, last),
        }
        values.push(read(value)?);
    }
    let last = values.last().copied().ok_or_else(|| field.error("must hold at least one entry"))?;
    values.resize(frames, last);
    Ok(values)
}

fn grips(field: &Field<'_>, objects: usize) -> Result<[Option<Grip>; AGENT_COUNT], FieldError> {
    const SIDES: [(&str, Side); 4] =
        [("head", Side::Head), ("tail", Side::Tail), ("right", Side::Right), ("left", Side::Left)];
    let grip = |field: Field<'_>| {
        if field.value().is_null() {
            return Ok(None);
        }
        field.only(&["object", "side", "relative_angle"])?;
        let object = field.required("object")?;
        Ok(Some(Grip {
            object: object.id(&ObjectId::ALL[..objects.min(MAX_OBJECTS)])?,
            side: field.required("side")?.one_of(&SIDES)?,
            relative_angle: field.required("relative_angle")?.number()?,
        }))
    };
    let pair = field.items()?.map(grip).collect::<Result<Vec<_>, _>>()?;
    <[Option<Grip>; AGENT_COUNT]>::try_from(pair).map_err(|_| field.must_be("two grips"))
}

fn contacts(field: &Field<'_>, objects: usize) -> Result<Contacts, FieldError> {
    let mut contacts = Contacts::NONE;
    for pair in field.items()? {
        let entities = pair
            .items()?
            .map(|entity| entity.id(&Entity::ALL[..AGENT_COUNT + objects.min(MAX_OBJECTS)]))
            .collect::<Result<Vec<_>, _>>()?;
        match entities[..] {
            [a, b] if a != b => {
                contacts.insert(a, b);
            }
            _ => return Err(pair.must_be("two different entities")),
        }
    }
    Ok(contacts)
}

fn pair(subgoals: &Field<'_>, thoughts: &Field<'_>) -> Result<[Thought; AGENT_COUNT], FieldError> {
    let pairs = subgoals.items()?.zip(thoughts.items()?);
    let pair = pairs.map(|(goal, field)| thought(&goal, &field)).collect::<Result<Vec<_>, _>>()?;
    <[Thought; AGENT_COUNT]>::try_from(pair)
        .map_err(|_| thoughts.error("must hold one thought for each agent"))
}

fn thought(subgoal: &Field<'_>, field: &Field<'_>) -> Result<Thought, FieldError> {
    field.only(&["subgoals", "plan", "actions", "intents", "suspicion"])?;
    let names = Action::ALL.map(|action| (action.name(), action));
    let proposed = |field: Field<'_>| {
        let parts: Vec<Field<'_>> = field.items()?.collect();
        let [text, value, particles] = &parts[..] else {
            return Err(field.must_be("a subgoal, its value and its particles"));
        };
        let particles = particles.whole(0, i64::from(u32::MAX))? as usize;
        Ok(SubgoalValue { subgoal: named(text)?, value: double(value)?, particles })
    };
    let searched = |field: Field<'_>| {
        let parts: Vec<Field<'_>> = field.items()?.collect();
        let [name, visits, value] = &parts[..] else {
            return Err(field.must_be("an action, its visits and its value"));
        };
        let visits = visits.whole(0, u32::MAX.into())? as u32;
        Ok(ActionEvaluation { action: name.one_of(&names)?, visits, value: double(value)? })
    };
    let believed = |field: Field<'_>| {
        let parts: Vec<Field<'_>> = field.items()?.collect();
        let [alpha, goal, particles] = &parts[..] else {
            return Err(field.must_be("an alpha, a goal and its particles"));
        };
        let intent = Intent { attitude: attitude(alpha)?, goal: goal_of(goal)? };
        let particles = particles.whole(0, i64::from(u32::MAX))? as usize;
        Ok(BelievedIntent { intent, particles })
    };
    Ok(Thought {
        subgoal: named(subgoal)?,
        subgoals: field.required("subgoals")?.items()?.map(proposed).collect::<Result<_, _>>()?,
        plan: field.required("plan")?.items()?.map(|text| named(&text)).collect::<Result<_, _>>()?,
        actions: field.required("actions")?.items()?.map(searched).collect::<Result<_, _>>()?,
        intents: match field.optional("intents")? {
            Some(intents) => intents.items()?.map(believed).collect::<Result<_, _>>()?,
            None => Vec::new(),
        },
        suspicion: field.optional("suspicion")?.map(|field| probability(&field)).transpose()?,
    })
}

fn named(field: &Field<'_>) -> Result<Subgoal, FieldError> {
    subgoal_of(field.text()?).ok_or_else(|| {
        field.error(format!(
            "must be a subgoal such as \"Attach(agent 0, object 1)\", not {}",
            shown(field.value())
        ))
    })
}

fn probability(field: &Field<'_>) -> Result<f64, FieldError> {
    let number = double(field)?;
    if (0.0..=1.0).contains(&number) { Ok(number) } else { Err(field.must_be("a probability, 0 to 1")) }
}

fn double(field: &Field<'_>) -> Result<f64, FieldError> {
    let number: Option<f64> = Value::as_f64(field.value());
    number.ok_or_else(|| field.must_be("a number"))
}
