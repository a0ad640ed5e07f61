//! From JSON to a scene; every level is checked against the redundant members that repeat it.

use super::{LayoutAndSizes, Starts};
use crate::{
    AGENT_COUNT, AgentId, AgentSpec, Attitude, Awareness, Body, EventKind, Flip, Goal, Knowledge, LandmarkId,
    Layout, Level, MAX_OBJECTS, MOST_WAITING, ObjectId, ObjectSpec, Scene, Segment, Sight, Sign, Size,
    Strength, Vec2, arena,
    json::{Field, FieldError},
};

/// Tolerance of a redundant number.
const TOLERANCE: f32 = 1e-3;
/// The members of an agent, and of an object, beside its start.
const AGENT: &[&str] = &[
    "radius",
    "size_level",
    "max_force",
    "strength_level",
    "goal",
    "alpha",
    "knows",
    "level",
    "sees",
    "waits",
];
const OBJECT: &[&str] = &["radius", "size_level"];

pub(super) fn scene(event: &Field<'_>, starts: Starts) -> Result<Scene, FieldError> {
    let layout = layout(event)?;
    let (agents, objects) = bodies(event)?;
    let agents: Vec<AgentSpec> = agents.iter().map(|field| agent(field, starts)).collect::<Result<_, _>>()?;
    Ok(Scene {
        layout,
        agents: core::array::from_fn(|i| agents[i]),
        objects: objects.iter().map(|field| object(field, starts)).collect::<Result<_, _>>()?,
        kind: event.required("event")?.one_of(&EventKind::ALL.map(|kind| (kind.name(), kind)))?,
    })
}

pub(super) fn layout_and_sizes(event: &Field<'_>) -> Result<LayoutAndSizes, FieldError> {
    let layout = layout(event)?;
    let (agents, objects) = bodies(event)?;
    agents.iter().try_for_each(|agent| agent.only(&[AGENT, &["controller"]].concat()))?;
    objects.iter().try_for_each(|object| object.only(OBJECT))?;
    let agents = agents.iter().map(size).collect::<Result<Vec<_>, _>>()?;
    Ok((layout, core::array::from_fn(|i| agents[i]), objects.iter().map(size).collect::<Result<_, _>>()?))
}

/// The fields of the agents and of the objects, of which there may be as many.
fn bodies<'a>(event: &Field<'a>) -> Result<(Vec<Field<'a>>, Vec<Field<'a>>), FieldError> {
    let agents = event.required("agents")?;
    let found: Vec<_> = agents.items()?.collect();
    if found.len() != AGENT_COUNT {
        return Err(agents.error(format!("must hold {AGENT_COUNT} agents, not {}", found.len())));
    }
    let objects = event.required("objects")?;
    let those: Vec<_> = objects.items()?.collect();
    if those.len() > MAX_OBJECTS {
        return Err(objects.error(format!("must hold at most {MAX_OBJECTS} objects, not {}", those.len())));
    }
    Ok((found, those))
}

fn layout(event: &Field<'_>) -> Result<Layout, FieldError> {
    let field = event.required("layout")?;
    field.only(&["base", "flip"])?;
    let base = field.required("base")?.whole(0, 21)? as u8;
    let flip = field.optional("flip")?.map(|flip| Ok(Flip::ALL[flip.whole(0, 3)? as usize])).transpose()?;
    let layout = Layout::new(base, flip).map_err(|error| field.error(error.to_string()))?;
    if let Some(walls) = event.optional("walls")? {
        let found = walls.items()?.map(|wall| segment(&wall)).collect::<Result<Vec<_>, _>>()?;
        let expected = layout.walls();
        let same = |a: &Segment, b: &Segment| {
            (near(a.a, b.a) && near(a.b, b.b)) || (near(a.a, b.b) && near(a.b, b.a))
        };
        let all_in = |a: &[Segment], b: &[Segment]| a.iter().all(|x| b.iter().any(|y| same(x, y)));
        if found.len() != expected.len() || !all_in(&found, &expected) || !all_in(&expected, &found) {
            let flip = flip.map_or_else(|| "null".into(), |flip| u8::from(flip).to_string());
            return Err(walls.error(format!("must be the walls of layout base {base}, flip {flip}")));
        }
    }
    if let Some(landmarks) = event.optional("landmarks")? {
        let found = landmarks.items()?.map(|field| point(&field)).collect::<Result<Vec<_>, _>>()?;
        if found.len() != arena::LANDMARKS.len()
            || !found.iter().zip(arena::LANDMARKS).all(|(&a, b)| near(a, b))
        {
            let centres = arena::LANDMARKS.map(|centre| format!("({}, {})", centre.x, centre.y));
            return Err(landmarks.error(format!("must be the four centres {}", centres.join(", "))));
        }
    }
    Ok(layout)
}

fn agent(field: &Field<'_>, starts: Starts) -> Result<AgentSpec, FieldError> {
    match starts {
        // Of an event it is known who moved the agent; a scene leaves that open.
        Starts::Elsewhere => field.only(&[AGENT, &["controller"]].concat())?,
        Starts::Members => only(field, AGENT, starts)?,
    }
    let size = size(field)?;
    let level = field.required("strength_level")?.whole(0, 3)?;
    let strength = Strength::ALL[level as usize];
    repeats(field, "max_force", strength.max_force(), &format!("the force of strength_level {level}"))?;
    let attitude = attitude(&field.required("alpha")?)?;
    let goal = goal(&field.required("goal")?)?;
    let awareness = awareness(field)?;
    Ok(AgentSpec { size, strength, goal, attitude, awareness, start: start(field, starts)? })
}

fn awareness(field: &Field<'_>) -> Result<Awareness, FieldError> {
    let knows = field.optional("knows")?.map(|knows| knows.one_of(&[("goals", false), ("nothing", true)]));
    let level = field.optional("level")?;
    let knows = match (knows.transpose()?.unwrap_or(false), level) {
        (true, level) => {
            let number = level.map_or(Ok(1), |level| level.whole(0, 2))?;
            Knowledge::Nothing(Level::ALL[number as usize])
        }
        (false, None) => Knowledge::Goals,
        (false, Some(level)) => {
            return Err(level.error("is for agents that know \"nothing\" of the other's goal"));
        }
    };
    let sights = Sight::ALL.map(|sees| (sees.name(), sees));
    let sees = field.optional("sees")?.map_or(Ok(Sight::Own), |sees| sees.one_of(&sights))?;
    let waits = field.optional("waits")?.map_or(Ok(0), |waits| waits.whole(0, MOST_WAITING.into()))?;
    Ok(Awareness { knows, sees, waits: waits as u16 })
}

fn object(field: &Field<'_>, starts: Starts) -> Result<ObjectSpec, FieldError> {
    only(field, OBJECT, starts)?;
    Ok(ObjectSpec { size: size(field)?, start: start(field, starts)? })
}

fn only(field: &Field<'_>, keys: &[&str], starts: Starts) -> Result<(), FieldError> {
    match starts {
        Starts::Elsewhere => field.only(keys),
        Starts::Members => field.only(&[keys, &["start"]].concat()),
    }
}

fn start(field: &Field<'_>, starts: Starts) -> Result<Body, FieldError> {
    if starts == Starts::Elsewhere {
        return Ok(Body::default());
    }
    let start = field.required("start")?;
    start.only(&["x", "y", "vx", "vy", "angle", "angular_velocity"])?;
    let or_zero = |key| start.optional(key)?.map_or(Ok(0.0), |number| number.number());
    Ok(Body {
        position: Vec2::new(start.required("x")?.number()?, start.required("y")?.number()?),
        velocity: Vec2::new(or_zero("vx")?, or_zero("vy")?),
        angle: or_zero("angle")?,
        angular_velocity: or_zero("angular_velocity")?,
    })
}

fn size(field: &Field<'_>) -> Result<Size, FieldError> {
    let level = field.required("size_level")?.whole(0, 3)?;
    let size = Size::ALL[level as usize];
    repeats(field, "radius", size.radius(), &format!("the radius of size_level {level}"))?;
    Ok(size)
}

/// Checks a number that repeats what a level implies, if it is present.
fn repeats(field: &Field<'_>, key: &str, expected: f32, what: &str) -> Result<(), FieldError> {
    match field.optional(key)? {
        Some(number) if (number.number()? - expected).abs() > TOLERANCE => {
            Err(number.must_be(&format!("{expected}, {what}")))
        }
        _ => Ok(()),
    }
}

/// An attitude that is written as its α, −1, 0 or 1.
///
/// # Errors
/// [`FieldError`] for any other value.
pub fn attitude(alpha: &Field<'_>) -> Result<Attitude, FieldError> {
    Ok(match alpha.whole(-1, 1)? {
        -1 => Attitude::Hinder,
        0 => Attitude::Neutral,
        _ => Attitude::Help,
    })
}

/// A goal, which is an object with `kind`, `sign` and the members of its kind.
///
/// # Errors
/// [`FieldError`] names the member and the rule that is violated.
pub fn goal(field: &Field<'_>) -> Result<Goal, FieldError> {
    let agent = |key| field.required(key)?.id(&AgentId::ALL);
    let object = || field.required("object")?.id(&ObjectId::ALL);
    let landmark = || field.required("landmark")?.id(&LandmarkId::ALL);
    let sign = || {
        let field = field.required("sign")?;
        match field.whole(-1, 1) {
            Ok(1) => Ok(Sign::Positive),
            Ok(-1) => Ok(Sign::Negative),
            _ => Err(field.must_be("1 or -1")),
        }
    };
    let kinds = [("agent_on_landmark", 0), ("object_on_landmark", 1), ("touch", 2)];
    match field.required("kind")?.one_of(&kinds)? {
        0 => {
            field.only(&["kind", "agent", "landmark", "sign"])?;
            Ok(Goal::AgentOnLandmark { agent: agent("agent")?, landmark: landmark()?, sign: sign()? })
        }
        1 => {
            field.only(&["kind", "object", "landmark", "sign"])?;
            Ok(Goal::ObjectOnLandmark { object: object()?, landmark: landmark()?, sign: sign()? })
        }
        _ => {
            field.only(&["kind", "agent", "other", "sign"])?;
            Ok(Goal::Touch { agent: agent("agent")?, other: agent("other")?, sign: sign()? })
        }
    }
}

fn segment(field: &Field<'_>) -> Result<Segment, FieldError> {
    let ends = field.items()?.map(|end| point(&end)).collect::<Result<Vec<_>, _>>()?;
    match ends[..] {
        [a, b] => Ok(Segment { a, b }),
        _ => Err(field.must_be("two points")),
    }
}

fn point(field: &Field<'_>) -> Result<Vec2, FieldError> {
    let numbers = field.items()?.map(|number| number.number()).collect::<Result<Vec<_>, _>>()?;
    match numbers[..] {
        [x, y] => Ok(Vec2::new(x, y)),
        _ => Err(field.must_be("a point of two numbers")),
    }
}

fn near(a: Vec2, b: Vec2) -> bool {
    a.distance(b) <= TOLERANCE
}
