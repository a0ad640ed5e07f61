//! A mind that plays as a person would: from what the server tells its agent.

use phase_game::{Instructions, playlist::Item};
use phase_minds::{Agent, MindParameters};
use phase_model::{
    Action, AgentId, Body, BodySet, Contacts, Entity, Grip, MAX_ENTITIES, ObjectId, PhysicsConfig, Scene,
    Side, State, Vec2,
    random::{Pcg64Mcg, Purpose, stream},
    words::Names,
};
use phase_perception::{
    CellSet, Observation,
    cells::{CELL_COUNT, Cell},
};
use serde_json::Value;

/// An agent of a scene that observes what the server tells it.
pub(crate) struct Player {
    scene: Scene,
    parameters: MindParameters,
    physics: PhysicsConfig,
    own: AgentId,
    /// The agent, from its first observation on.
    agent: Option<Agent>,
    last: Option<Action>,
    random: [Pcg64Mcg; 2],
}

impl Player {
    /// The mind of an agent of the scene that a message `stage` tells of: the one with these walls, bodies
    /// and instructions.
    pub(crate) fn new(
        scenes: &[Item],
        stage: &Value,
        agent: AgentId,
        parameters: &MindParameters,
    ) -> Option<Self> {
        let scene = &scenes
            .iter()
            .find(|item| {
                let told = Instructions::new(&item.scene, agent, &Names::PAPER);
                serde_json::to_value(told).is_ok_and(|told| told == stage["instructions"])
            })?
            .scene;
        Some(Self {
            scene: scene.clone(),
            parameters: *parameters,
            physics: scene.physics(),
            own: agent,
            agent: None,
            last: None,
            random: [Purpose::Belief, Purpose::Search]
                .map(|purpose| stream(1, purpose, agent.number().into())),
        })
    }

    /// Observes what was seen, and decides.
    pub(crate) fn decide(&mut self, sight: &Value) -> Option<Action> {
        let observation = self.observation(sight)?;
        let [beliefs, searches] = &mut self.random;
        let agent = match self.agent.take().zip(self.last) {
            Some((mut agent, action)) => {
                agent.perceive(action, &observation, &[], beliefs);
                agent
            }
            None => Agent::new(&self.scene, &self.parameters, &observation, None, beliefs).ok()?,
        };
        let (action, _) = self.agent.insert(agent).decide(searches).ok()?;
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
        let own = Entity::Agent(self.own);
        let touched = self.physics.entities().filter(|&entity| known.touching(own, entity)).collect();
        let visible = cells(sight["visible"].as_str()?);
        Some(Observation::from_parts(self.own, visible, observed, touched, &known))
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
