//! Random problems of the symbolic search.

use phase_model::{
    AgentBody, AgentId, Body, BodySet, Entity, Goal, Grip, LandmarkId, Layout, ObjectId, PhysicsConfig,
    Segment, Side, Sign, Size, State, Strength, Vec2, arena,
};
use phase_planner::{
    PlanningProblem,
    task::{Effort, PlanningTask},
};
use proptest::prelude::*;

/// One problem: a scene at some moment, a goal and the acting agents.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub(crate) layout: Layout,
    pub(crate) agents: [(Size, Strength); 2],
    pub(crate) objects: Vec<Size>,
    pub(crate) places: [Vec2; 4],
    pub(crate) holds: [Option<ObjectId>; 2],
    pub(crate) goal: Goal,
    pub(crate) actors: [bool; 2],
    pub(crate) efforts: [Effort; 2],
    pub(crate) cooperative: bool,
    /// The place of a round body that narrows doors for the given agent.
    pub(crate) narrowed: Option<(AgentId, Vec2)>,
}

impl Problem {
    pub(crate) fn physics(&self) -> PhysicsConfig {
        let mut object_radii = [0.0; 2];
        for (radius, size) in object_radii.iter_mut().zip(&self.objects) {
            *radius = size.radius();
        }
        let walls: Vec<Segment> = self.layout.walls();
        let agents = self
            .agents
            .map(|(size, strength)| AgentBody { radius: size.radius(), max_force: strength.max_force() });
        PhysicsConfig { walls, agents, object_radii, object_count: self.objects.len() }
    }

    pub(crate) fn state(&self) -> State {
        let mut state = State::new(self.places.map(|place| Body::at_rest(place, 0.0)));
        for (grip, held) in state.grips.iter_mut().zip(self.holds) {
            *grip = held.map(|object| Grip { object, side: Side::Head, relative_angle: 0.0 });
        }
        state
    }

    pub(crate) fn task<'a>(&self, problem: &'a PlanningProblem<'a>) -> PlanningTask<'a> {
        let narrowed = self.narrowed.map(|(agent, place)| {
            let mut gaps = *problem.gaps(agent, BodySet::OBJECTS);
            gaps.obstruct(place, 1.0, 1.0);
            (agent, gaps)
        });
        let goal = self.goal;
        let actors = self.actors;
        let efforts = self.efforts;
        let cooperative = self.cooperative;
        PlanningTask { problem, goal, actors, efforts, cooperative, narrowed }
    }
}

/// A random position anywhere, or in the middle of the arena where the doors are.
fn place() -> impl Strategy<Value = Vec2> {
    (0.0..1.0_f32, 0.0..1.0_f32, any::<bool>()).prop_map(|(x, y, near_doors)| {
        let place = arena::MIN + arena::SIDE * Vec2::new(x, y);
        if near_doors { arena::CENTRE + (place - arena::CENTRE) * 0.5 } else { place }
    })
}

fn goal(object_count: usize) -> impl Strategy<Value = Goal> {
    let sign = Sign::Positive;
    let agent = prop::sample::select(AgentId::ALL.to_vec());
    let landmark = prop::sample::select(LandmarkId::ALL.to_vec());
    (0..3_u8, agent, 0..2_usize, landmark).prop_map(move |(kind, agent, object, landmark)| match kind {
        0 => Goal::AgentOnLandmark { agent, landmark, sign },
        1 if object_count > 0 => {
            Goal::ObjectOnLandmark { object: ObjectId::ALL[object % object_count], landmark, sign }
        }
        _ => Goal::Touch { agent, other: agent.other(), sign },
    })
}

/// Problems of all kinds: layouts, places, sizes, strengths, holds, goals, actors.
pub(crate) fn problems() -> impl Strategy<Value = Problem> {
    let layout = prop::sample::select(Layout::all_used().collect::<Vec<_>>());
    let size = || prop::sample::select(Size::ALL.to_vec());
    let body = || (size(), prop::sample::select(Strength::ALL.to_vec()));
    let actors = prop::sample::select(vec![[true, false], [false, true], [true, true]]);
    let efforts = {
        let own = Effort::OWN;
        let helper = Effort::helper(0.4);
        prop::sample::select(vec![[own, own], [helper, own], [own, helper]])
    };
    let scene = (layout, [body(), body()], prop::collection::vec(size(), 0..=2));
    (scene, [place(), place(), place(), place()], actors, efforts, any::<bool>())
        .prop_flat_map(|(scene, places, actors, efforts, cooperative)| {
            let count = scene.2.len();
            let held = || prop::option::weighted(0.3, prop::sample::select(ObjectId::ALL.to_vec()));
            let narrowed =
                prop::option::weighted(0.2, (prop::sample::select(AgentId::ALL.to_vec()), place()));
            (Just((scene, places, actors, efforts, cooperative)), [held(), held()], goal(count), narrowed)
        })
        .prop_map(|(fixed, holds, goal, narrowed)| {
            let ((layout, agents, objects), mut places, actors, efforts, cooperative) = fixed;
            let holds = holds.map(|held| held.filter(|&object| object.index() < objects.len()));
            // A held object touches its holder; if both agents hold it, it is placed at the first.
            for agent in [1, 0] {
                if let Some(object) = holds[agent] {
                    let arm = agents[agent].0.radius() + objects[object.index()].radius();
                    places[Entity::Object(object)] = places[agent] + Vec2::new(0.0, arm);
                }
            }
            if let [Some(a), Some(b)] = holds
                && a == b
            {
                let arms = agents.map(|(size, _)| size.radius() + objects[a.index()].radius());
                places[1] = places[Entity::Object(a)] + Vec2::new(0.0, arms[1]);
            }
            Problem { layout, agents, objects, places, holds, goal, actors, efforts, cooperative, narrowed }
        })
}
