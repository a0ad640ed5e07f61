//! Features of one agent's progress towards one goal in one row of an event, as a viewer sees it.

use crate::physical_goals;
use phase_event::ObservedEvent;
use phase_model::{
    AGENT_COUNT, AgentId, Body, Entity, Goal, MAX_ENTITIES, ObjectId, Segment, Sign, Vec2,
    arena::{LANDMARK_HALF_SIDE, LANDMARKS, SIDE},
};

/// Number of features of a goal in a row.
pub const FEATURES: usize = 44;

/// Half the arena's side (u): the scale of distances.
const LENGTH: f32 = SIDE / 2.0;
/// The scale of speeds (u/s); most are below it.
const SPEED: f32 = 10.0;
/// Bodies whose outlines are closer than this touch (u).
const TOUCH: f32 = 0.2;
/// A body whose origin is this near to a landmark's centre in both coordinates (u) is on it: a body of medium
/// size then lies inside.
const ON: f32 = LANDMARK_HALF_SIDE - 1.0;

/// Features of all goals of both agents in an event, relative to the goal: what has to get where, who is near
/// it, who moves towards what. Neither places nor numbers of agents, objects and landmarks enter, so what is
/// learnt of one goal holds for all.
#[derive(Clone, Debug)]
pub struct GoalFeatures {
    walls: Vec<Segment>,
    radii: [f32; MAX_ENTITIES],
    objects: usize,
    /// The goals of agent 0, then those of agent 1.
    goals: Vec<(AgentId, Goal)>,
}

impl GoalFeatures {
    /// Features of the goals that agents can have in an event.
    #[must_use]
    pub fn new(observed: &ObservedEvent) -> Self {
        let objects = observed.object_sizes().len();
        let mut radii = [0.0; MAX_ENTITIES];
        let sizes = observed.agent_sizes().into_iter().chain(observed.object_sizes().iter().copied());
        radii.iter_mut().zip(sizes).for_each(|(radius, size)| *radius = size.radius());
        let of = |agent| physical_goals(agent, objects).into_iter().map(move |goal| (agent, goal));
        let goals = AgentId::ALL.into_iter().flat_map(of).collect();
        Self { walls: observed.layout().walls(), radii, objects, goals }
    }

    /// Whose goals these are, and which, in the order of [`GoalFeatures::of_row`].
    #[must_use]
    pub fn goals(&self) -> &[(AgentId, Goal)] {
        &self.goals
    }

    /// The features of every goal in a row.
    pub fn of_row<'a>(&'a self, row: &'a [Body; MAX_ENTITIES]) -> impl Iterator<Item = [f32; FEATURES]> + 'a {
        self.goals.iter().map(move |&(agent, goal)| self.of_goal(row, agent, goal))
    }

    /// The features of a goal: its kind (4, one-hot); the remaining way of what has to be moved, with the
    /// speed at which it shortens and whether a wall lies across it; the same of both agents' ways to it and
    /// to where it has to get, and of both agents' ways to one another, with how far they face along it; who
    /// touches what; the nearest of the other objects; speeds; whether the goal holds; radii. Distances in
    /// units of 10 u, speeds of 10 u/s, radii in u.
    fn of_goal(&self, row: &[Body; MAX_ENTITIES], agent: AgentId, goal: Goal) -> [f32; FEATURES] {
        let me = Entity::Agent(agent);
        let other = Entity::Agent(agent.other());
        let (kind, carried, to) = match goal {
            Goal::AgentOnLandmark { agent, landmark, .. } => {
                (0, Entity::Agent(agent), LANDMARKS[usize::from(landmark)])
            }
            Goal::ObjectOnLandmark { object, landmark, .. } => {
                (1, Entity::Object(object), LANDMARKS[usize::from(landmark)])
            }
            Goal::Touch { sign: Sign::Positive, .. } => (2, me, row[other].position),
            Goal::Touch { sign: Sign::Negative, .. } => (3, me, row[other].position),
        };
        let is_object = matches!(carried, Entity::Object(_));
        let mut features = FeatureList::default();
        (0..4).for_each(|k| features.push(f32::from(u8::from(k == kind))));

        let place = |entity: Entity| row[entity].position;
        let remaining = self.way(&row[carried], to);
        features.extend([remaining.distance, remaining.closing, remaining.wall]);
        for who in [me, other] {
            let way = self.way(&row[who], place(carried));
            features.extend([way.distance, way.closing, way.facing, way.wall]);
        }
        for who in [me, other] {
            let way = self.way(&row[who], to);
            features.extend([way.distance, way.closing, way.facing]);
        }
        let mine = self.way(&row[me], place(other));
        let theirs = self.way(&row[other], place(me));
        features.extend([mine.distance, mine.closing, mine.facing, theirs.closing, theirs.facing, mine.wall]);

        let touches = |a: Entity, b: Entity| a != b && self.touch(row, a, b);
        features.extend_flags([
            touches(me, carried),
            is_object && touches(other, carried),
            touches(me, other),
        ]);
        self.others(row, carried, [me, other], &mut features);
        let speed = |entity: Entity| row[entity].velocity.length() / SPEED;
        features.extend([speed(me), speed(other), speed(carried)]);
        let apart = (place(carried) - to).abs();
        let holds = if kind < 2 { apart.x < ON && apart.y < ON } else { touches(me, other) };
        features.extend_flags([holds]);
        features.extend([me, other, carried].map(|entity| self.radii[entity.index()]));
        features.values
    }

    /// The objects that the goal is not about: who touches one, and the nearest.
    fn others(
        &self,
        row: &[Body; MAX_ENTITIES],
        carried: Entity,
        agents: [Entity; AGENT_COUNT],
        features: &mut FeatureList,
    ) {
        let others = || {
            let objects = ObjectId::ALL.into_iter().take(self.objects).map(Entity::Object);
            objects.filter(|&object| object != carried)
        };
        features.extend_flags(agents.map(|who| others().any(|object| self.touch(row, who, object))));
        for who in agents {
            let ways = || others().map(|object| self.way(&row[who], row[object].position));
            features.push(ways().map(|way| way.distance).reduce(f32::min).unwrap_or_default());
            features.push(ways().map(|way| way.closing).reduce(f32::max).unwrap_or_default());
        }
        let speeds = others().map(|object| row[object].velocity.length() / SPEED);
        features.push(speeds.reduce(f32::max).unwrap_or_default());
    }

    /// The straight way of a body to a point.
    fn way(&self, body: &Body, to: Vec2) -> Way {
        let line = Segment { a: body.position, b: to };
        let direction = (to - body.position).normalize_or_zero();
        Way {
            distance: (to - body.position).length() / LENGTH,
            closing: body.velocity.dot(direction) / SPEED,
            facing: body.forward().dot(direction),
            wall: f32::from(u8::from(self.walls.iter().any(|wall| wall.crosses(line)))),
        }
    }

    fn touch(&self, row: &[Body; MAX_ENTITIES], a: Entity, b: Entity) -> bool {
        let reach = self.radii[a.index()] + self.radii[b.index()] + TOUCH;
        row[a].position.distance(row[b].position) < reach
    }
}

/// A body's way to a point.
struct Way {
    /// Straight distance.
    distance: f32,
    /// Speed along it.
    closing: f32,
    /// Cosine of the angle between it and where the body faces; 0 at the point.
    facing: f32,
    /// 1 if a wall crosses it.
    wall: f32,
}

/// Features one after the other.
struct FeatureList {
    values: [f32; FEATURES],
    count: usize,
}

impl Default for FeatureList {
    fn default() -> Self {
        Self { values: [0.0; FEATURES], count: 0 }
    }
}

impl FeatureList {
    fn push(&mut self, value: f32) {
        debug_assert!(self.count < FEATURES, "there is no place for another feature");
        if let Some(place) = self.values.get_mut(self.count) {
            *place = value;
        }
        self.count += 1;
    }

    fn extend(&mut self, values: impl IntoIterator<Item = f32>) {
        values.into_iter().for_each(|value| self.push(value));
    }

    fn extend_flags(&mut self, flags: impl IntoIterator<Item = bool>) {
        self.extend(flags.into_iter().map(|flag| f32::from(u8::from(flag))));
    }
}

/// The number of a goal among [`physical_goals`] of an agent; of touching goals only the sign counts. `None`
/// for others, such as keeping somebody off a landmark.
#[must_use]
pub fn goal_index(agent: AgentId, goal: Goal, objects: usize) -> Option<usize> {
    let same = |other: &Goal| match (*other, goal) {
        (Goal::Touch { sign, .. }, Goal::Touch { sign: wanted, .. }) => sign == wanted,
        (other, goal) => other == goal,
    };
    physical_goals(agent, objects).iter().position(same)
}

#[cfg(test)]
mod tests {
    use super::{FEATURES, GoalFeatures, goal_index};
    use phase_event::ObservedEvent;
    use phase_model::{AgentId, Body, Flip, Goal, LandmarkId, Layout, ObjectId, Sign, Size, Vec2};

    fn observed(layout: Layout, places: [[f32; 2]; 4], velocity: Vec2) -> ObservedEvent {
        let mut row = places.map(|[x, y]| Body::at_rest(Vec2::new(x, y), 0.0));
        row[0].velocity = velocity;
        let sizes = vec![Size::Small, Size::Large];
        ObservedEvent::new(layout, [Size::Small, Size::Medium], sizes, vec![row]).expect("an event")
    }

    fn features(observed: &ObservedEvent) -> Vec<[f32; FEATURES]> {
        let goals = GoalFeatures::new(observed);
        goals.of_row(&observed.rows()[0]).collect()
    }

    #[test]
    fn the_features_of_a_goal_by_hand() {
        // Agent 0 at (12, 19.5) moves left at 10 u/s towards the landmark at (8.5, 19.5), facing up.
        let layout = Layout::new(0, None).expect("a layout");
        let event =
            observed(layout, [[12.0, 19.5], [20.0, 19.5], [12.0, 17.0], [20.0, 5.0]], Vec2::new(-10.0, 0.0));
        let goal = goal_index(
            AgentId::ZERO,
            Goal::AgentOnLandmark {
                agent: AgentId::ZERO,
                landmark: LandmarkId::TOP_LEFT,
                sign: Sign::Positive,
            },
            2,
        );
        let of = features(&event)[goal.expect("a goal")];
        assert_eq!(of[..4], [1.0, 0.0, 0.0, 0.0]);
        assert!((of[4] - 0.35).abs() < 1e-6 && (of[5] - 1.0).abs() < 1e-6, "3.5 u, closing at 10 u/s");
        // It is itself what has to get there: no way to it.
        assert_eq!(of[7..11], [0.0; 4]);
        // The other agent is 8 u away and stands.
        assert!((of[21] - 0.8).abs() < 1e-6 && (of[22] + 1.0).abs() < 1e-6 && of[24] == 0.0, "{of:?}");
        assert_eq!(of.iter().filter(|value| !value.is_finite()).count(), 0);
    }

    /// A reflected event has the same features for the reflected goals.
    #[test]
    fn reflections_change_nothing() {
        let places = [[9.0, 6.0], [20.0, 9.0], [12.0, 17.0], [23.0, 5.0]];
        let velocity = Vec2::new(3.0, 1.0);
        let layout = Layout::new(8, None).expect("a layout");
        let plain = observed(layout, places, velocity);
        for flip in Flip::ALL {
            let point = |[x, y]: [f32; 2]| flip.point(Vec2::new(x, y)).to_array();
            let mut rows = plain.rows().to_vec();
            for (body, place) in rows[0].iter_mut().zip(places) {
                body.position = Vec2::from_array(point(place));
                body.velocity = flip.vector(body.velocity);
                body.angle = flip.angle(body.angle);
            }
            let sizes = plain.object_sizes().to_vec();
            let other = ObservedEvent::new(layout.flipped(flip), plain.agent_sizes(), sizes, rows);
            let other = other.expect("an event");
            let one = features(&plain);
            let two = features(&other);
            for (agent, goal) in GoalFeatures::new(&plain).goals() {
                let reflected = match *goal {
                    Goal::AgentOnLandmark { agent, landmark, sign } => {
                        Goal::AgentOnLandmark { agent, landmark: flip.landmark(landmark), sign }
                    }
                    Goal::ObjectOnLandmark { object, landmark, sign } => {
                        Goal::ObjectOnLandmark { object, landmark: flip.landmark(landmark), sign }
                    }
                    touch @ Goal::Touch { .. } => touch,
                };
                let index = |goal| agent.index() * 14 + goal_index(*agent, goal, 2).expect("a goal");
                let a = one[index(*goal)];
                let b = two[index(reflected)];
                for (k, (a, b)) in a.iter().zip(b).enumerate() {
                    assert!((a - b).abs() < 1e-4, "{flip:?}, {goal:?}: feature {k} is {a} and {b}");
                }
            }
        }
    }

    /// Exchanging the agents, or the objects, exchanges the features.
    #[test]
    fn numbers_do_not_matter() {
        let places = [[9.0, 6.0], [20.0, 9.0], [12.0, 17.0], [23.0, 5.0]];
        let layout = Layout::new(8, None).expect("a layout");
        let event = observed(layout, places, Vec2::new(3.0, 1.0));
        let mut rows = event.rows().to_vec();
        rows[0].swap(2, 3);
        let swapped = vec![Size::Large, Size::Small];
        let other = ObservedEvent::new(layout, event.agent_sizes(), swapped, rows).expect("an event");
        let [first, second] = ObjectId::ALL;
        for landmark in LandmarkId::ALL {
            let goal = |object| Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive };
            let index = |object| goal_index(AgentId::ZERO, goal(object), 2).expect("a goal");
            assert_eq!(features(&event)[index(first)], features(&other)[index(second)]);
        }
    }
}
