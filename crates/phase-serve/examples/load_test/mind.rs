//! A mind that plays as a person would: from what the server tells its agent.

use phase_agent::{BeliefView, MindParameters};
use phase_belief::Belief;
use phase_forward::Forward;
use phase_game::{Instructions, playlist::Item};
use phase_minds::Mind;
use phase_model::{
    Action, AgentId, Body, BodySet, Contacts, Entity, Grip, MAX_ENTITIES, ObjectId, PhysicsConfig, Side,
    State, Vec2,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_perception::{
    CellSet, Observation,
    cells::{CELL_COUNT, Cell},
};
use phase_render::Palette;
use serde_json::Value;

/// A mind with its belief.
pub(crate) struct Player {
    mind: Box<dyn Mind>,
    agent: AgentId,
    physics: PhysicsConfig,
    forward: Forward,
    belief: Option<Belief>,
    particles: usize,
    last: Option<Action>,
    random: [Pcg64Mcg; 2],
}

impl Player {
    /// The mind of an agent of the scene that a message `stage` tells of: the one with these walls, bodies and instructions.
    pub(crate) fn new(
        scenes: &[Item],
        stage: &Value,
        agent: AgentId,
        parameters: &MindParameters,
    ) -> Option<Self> {
        let scene = &scenes
            .iter()
            .find(|item| {
                let told = Instructions::new(&item.scene, agent, &Palette::PAPER);
                serde_json::to_value(told).is_ok_and(|told| told == stage["instructions"])
            })?
            .scene;
        let physics = scene.physics();
        Some(Self {
            mind: phase_minds::mind(scene, agent, parameters).ok()?,
            forward: Forward::new(&physics),
            physics,
            agent,
            belief: None,
            particles: parameters.particles,
            last: None,
            random: [Purpose::Belief, Purpose::Search]
                .map(|purpose| stream(1, purpose, agent.number().into())),
        })
    }

    /// Observes what was seen, and decides.
    pub(crate) fn decide(&mut self, sight: &Value) -> Option<Action> {
        let observation = self.observation(sight)?;
        let [beliefs, searches] = &mut self.random;
        match (&mut self.belief, self.last) {
            (Some(belief), Some(action)) => {
                belief.update(&self.forward, &self.physics, action, &observation, beliefs);
            }
            _ => self.belief = Some(Belief::new(&self.physics, &observation, self.particles, beliefs)),
        }
        let particles = self.belief.as_ref()?.particles();
        let view = BeliefView { particles, observed: observation.observed, last_action: self.last };
        let (action, _) = self.mind.decide(view, searches).ok()?;
        self.last = Some(action);
        Some(action)
    }

    fn observation(&self, sight: &Value) -> Option<Observation> {
        let mut known = State::new([Body::default(); MAX_ENTITIES]);
        let mut observed = BodySet::EMPTY;
        for (entity, body) in self.physics.entities().zip(sight["bodies"].as_array()?) {
            let Some(numbers) = body.as_array() else { continue };
            let number = |k: usize| numbers.get(k).and_then(Value::as_f64).unwrap_or_default() as f32;
            *known.body_mut(entity) = Body {
                position: Vec2::new(number(0), number(1)),
                angle: number(2),
                velocity: Vec2::new(number(3), number(4)),
                angular_velocity: number(5),
            };
            observed.insert(entity);
        }
        for agent in AgentId::ALL {
            let seen = &sight["grips"][agent.index()];
            let Some(object) = seen["object"].as_u64() else { continue };
            let side = [0, 1].map(|k| seen["side"][k].as_f64().unwrap_or_default() as f32);
            known.grips[agent] = Some(Grip {
                object: ObjectId::ALL[usize::from(object == 1)],
                side: Side::ALL.into_iter().find(|it| it.direction().to_array() == side)?,
                relative_angle: seen["angle"].as_f64().unwrap_or_default() as f32,
            });
        }
        let mut contacts = Contacts::NONE;
        for pair in sight["contacts"].as_array()? {
            let entity = |k: usize| Entity::ALL.get(pair[k].as_u64()? as usize).copied();
            contacts.insert(entity(0)?, entity(1)?);
        }
        known.contacts = contacts;
        let own = Entity::Agent(self.agent);
        let touched = self.physics.entities().filter(|&entity| known.touching(own, entity)).collect();
        let visible = cells(sight["visible"].as_str()?);
        Some(Observation::from_parts(self.agent, visible, observed, touched, &known))
    }
}

fn cells(digits: &str) -> CellSet {
    let mut cells = CellSet::EMPTY;
    let digits: Vec<u32> = digits.chars().filter_map(|digit| digit.to_digit(16)).collect();
    for index in 0..CELL_COUNT {
        let seen = digits.get(index / 4).is_some_and(|digit| digit >> (index % 4) & 1 == 1);
        if let (true, Some(cell)) = (seen, Cell::from_index(index)) {
            cells.insert(cell);
        }
    }
    cells
}
