//! Training of the policy network, which [`phase_agent::PolicyNetwork`] evaluates.
//!
//! The loss is the cross-entropy of the network's policy to the shares of visits of whole searches, plus the
//! squared error of the value. Some decisions of the agents of each event are searched again, wholly, since a
//! search that acts ends once it is decided; and some that an agent with another intent would have made in
//! their place, because inference asks what other agents would do.

use crate::{
    layer::Layer,
    parameters::Parameter,
    training::{Loss, Network, PublishedNetwork, TrainingSettings},
};
use candle_core::{D, Device, Module, Result, Tensor};
use candle_nn::ops::log_softmax;
use phase_agent::{
    Consideration, Mind, PhaseParameters, Prior,
    policy::{Features, OF_ACTION, SHARED},
};
use phase_event::{Event, ObservedEvent, Thought};
use phase_forward::Forward;
use phase_minds::MindParameters;
use phase_model::{
    Action, AgentId,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_pomcp::PomcpError;
use phase_sim::belief_view;
use phase_simple::{Hypothesis, Intent};
use rand::{RngExt, seq::IndexedRandom};

/// Units of the embedding of what all actions have in common.
const EMBEDDING: usize = 32;
/// Units of the hidden layers.
const UNITS: usize = 48;
/// Weight of the squared error of the value (1 over the square of the reward's unit) beside the
/// cross-entropy (nat).
const VALUE_WEIGHT: f64 = 0.02;
/// Added to the logits of actions that are not searched.
const MASKED_LOGIT: f32 = -1e9;
/// Decisions of the agents of an event, and of agents with other intents, that are learnt of it.
const LEARNT: [usize; 2] = [40, 40];
/// Number of all actions.
const ACTIONS: usize = Action::ALL.len();

/// Settings of the training, whose samples are events.
pub const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 2,
    learning_rate: 1e-3,
    max_gradient_norm: 5.0,
    round: 160,
    patience: 12,
    rounds: 100,
};

/// The decisions of an event that were searched.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Decisions {
    /// [`SHARED`] features for each.
    shared: Vec<f32>,
    /// [`OF_ACTION`] features for each action of each.
    actions: Vec<f32>,
    /// 0 for each action that was searched, [`MASKED_LOGIT`] for the others.
    masks: Vec<f32>,
    /// The share of visits of each action.
    shares: Vec<f32>,
    /// The mean return of the most visited action.
    values: Vec<f32>,
    /// Cross-entropies of the uniform policy, the heuristic's rollouts and habits to the shares, summed
    /// (nat).
    others: [f64; 3],
}

impl Decisions {
    /// Decisions by our own minds in the states and beliefs of an event, searched wholly with the event's
    /// other parameters.
    ///
    /// # Errors
    /// [`PomcpError`], if a search fails.
    pub fn of(
        event: &Event,
        observed: &ObservedEvent,
        parameters: PhaseParameters,
    ) -> core::result::Result<Self, PomcpError> {
        let parameters = PhaseParameters { prior: Prior::Habits, convergence: 0.0, ..parameters };
        let minds = MindParameters::Phase(parameters);
        let beliefs = AgentId::ALL.map(|agent| phase_sim::beliefs(event, agent, &minds));
        let strengths = event.scene.agents.each_ref().map(|agent| agent.strength);
        let mut decisions = Self::default();
        let mut random = random::stream(event.seed, Purpose::Training, 0);
        let [own, others] = LEARNT.map(|count| count.min(event.steps.len()));
        for k in 0..own + others {
            let agent = AgentId::ALL[k % AgentId::ALL.len()];
            let step = random.random_range(0..event.steps.len());
            let intents = Intent::all(agent, observed.object_sizes().len());
            let intent = intents.choose(&mut random).filter(|_| k >= own);
            let scene = intent.map_or_else(
                || event.scene.clone(),
                |it| {
                    Hypothesis::of_intent(*it, agent, event.scene.goals()[agent.other()], strengths)
                        .scene(observed)
                },
            );
            let mut mind = Mind::new(&scene, agent, Forward::new(&scene.physics()), parameters)?;
            let view = belief_view(event, agent, step, &beliefs[agent]);
            if let Some(considered) = mind.consider(view) {
                let (_, thought) = mind.decide(view, &mut random)?;
                decisions.push(&considered, &thought);
            }
        }
        Ok(decisions)
    }

    /// Adds a decision and the search that was made for it.
    fn push(&mut self, considered: &Consideration, thought: &Thought) {
        let visits: u32 = thought.actions.iter().map(|found| found.visits).sum();
        let Some(best) = thought.actions.iter().max_by_key(|found| found.visits) else { return };
        if visits == 0 || thought.actions.len() != considered.actions.len() {
            return;
        }
        let mut masks = [MASKED_LOGIT; ACTIONS];
        let mut shares = [0.0; ACTIONS];
        let count = considered.actions.len() as f64;
        let habits: f64 = considered.habits.iter().sum();
        for (found, habit) in thought.actions.iter().zip(&considered.habits) {
            let share = f64::from(found.visits) / f64::from(visits);
            masks[found.action.index()] = 0.0;
            shares[found.action.index()] = share as f32;
            let heuristic = f64::from(u8::from(found.action == considered.heuristic));
            let policies = [1.0 / count, 0.5 / count + 0.5 * heuristic, habit / habits];
            for (sum, policy) in self.others.iter_mut().zip(policies) {
                *sum -= share * libm::log(policy);
            }
        }
        let Features { shared, actions } = &considered.features;
        self.shared.extend(shared);
        self.actions.extend(actions.as_flattened());
        self.masks.extend(masks);
        self.shares.extend(shares);
        self.values.push(best.value as f32);
    }
}

/// The network in training; see [`phase_agent::PolicyNetwork`].
#[derive(Clone, Debug)]
pub struct PolicyNetwork {
    embedding: Layer,
    context: Layer,
    action: Layer,
    hidden: Layer,
    output: Layer,
    value: Layer,
}

impl PolicyNetwork {
    /// ln of the policy of each decision, and its value.
    fn forward(&self, shared: &Tensor, actions: &Tensor, masks: &Tensor) -> Result<(Tensor, Tensor)> {
        let embedded = self.embedding.forward(shared)?.relu()?;
        let context = self.context.forward(&embedded)?.unsqueeze(1)?;
        let sums = self.action.forward(actions)?.broadcast_add(&context)?.relu()?;
        let logits = self.output.forward(&self.hidden.forward(&sums)?.relu()?)?.squeeze(D::Minus1)?;
        Ok((log_softmax(&(logits + masks)?, D::Minus1)?, self.value.forward(&embedded)?))
    }
}

impl Network for PolicyNetwork {
    type Sample = Decisions;
    const NAME: &'static str = "policy";
    const METRICS: &'static [&'static str] = &["policy", "habits", "heuristic", "uniform", "tv", "value"];

    fn parameters(&self) -> Vec<Parameter> {
        let Self { embedding, context, action, hidden, output, value } = self;
        [
            (embedding, "embedding"),
            (context, "context"),
            (action, "action"),
            (hidden, "hidden"),
            (output, "output"),
            (value, "value"),
        ]
        .into_iter()
        .flat_map(|(layer, name)| layer.parameters(name))
        .collect()
    }

    fn loss(&self, events: &[&Decisions], _: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        let all = |of: fn(&Decisions) -> &[f32], width: usize| {
            let numbers: Vec<f32> = events.iter().flat_map(|event| of(event)).copied().collect();
            Tensor::from_vec(numbers.clone(), (numbers.len() / width, width), &Device::Cpu)
        };
        let shared = all(|it| &it.shared, SHARED)?;
        let decisions = shared.dim(0)?;
        let actions = all(|it| &it.actions, OF_ACTION)?.reshape((decisions, ACTIONS, OF_ACTION))?;
        let (logs, values) = self.forward(&shared, &actions, &all(|it| &it.masks, ACTIONS)?)?;
        let count = decisions.max(1) as f64;
        let shares = all(|it| &it.shares, ACTIONS)?;
        let policy = ((&shares * &logs)?.sum_all()? / -count)?;
        let value = ((values - all(|it| &it.values, 1)?)?.sqr()?.sum_all()? / count)?;
        let loss = (&policy + (&value * VALUE_WEIGHT)?)?;
        let variation = ((shares - logs.exp()?)?.abs()?.sum_all()? / (2.0 * count))?;
        let number = |tensor: &Tensor| Ok::<f64, candle_core::Error>(tensor.to_scalar::<f32>()?.into());
        let [uniform, heuristic, habits] =
            [0, 1, 2].map(|k| events.iter().map(|event| event.others[k]).sum::<f64>() / count);
        let scores =
            vec![number(&policy)?, habits, heuristic, uniform, number(&variation)?, number(&value)?.sqrt()];
        Ok(Loss { loss, scores })
    }
}

impl PublishedNetwork for PolicyNetwork {
    const BUNDLED_WEIGHTS: &'static [u8] = phase_data::POLICY.weights;
    const BUNDLED_RECORD: &'static str = phase_data::POLICY.record;

    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            embedding: Layer::new(SHARED, EMBEDDING, random)?,
            context: Layer::new(EMBEDDING, UNITS, random)?,
            action: Layer::new(OF_ACTION, UNITS, random)?,
            hidden: Layer::new(UNITS, UNITS, random)?,
            output: Layer::new(UNITS, 1, random)?,
            value: Layer::new(EMBEDDING, 1, random)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{ACTIONS, Decisions, MASKED_LOGIT, PolicyNetwork};
    use crate::training::{Network, PublishedNetwork, TrainingRun, to_safetensors};
    use candle_core::{Device, Tensor};
    use phase_agent::{
        PhaseParameters,
        policy::{Features, OF_ACTION, SHARED},
    };
    use phase_event::Recording;
    use phase_minds::MindParameters;
    use phase_model::{Action, Scene};
    use phase_sim::{SimulationSettings, simulate};
    use serde_json::Value;

    /// An event of one agent that goes to a landmark and one that brings an object.
    fn decisions() -> Decisions {
        let scene = Scene::from_json(
            r#"{"layout": {"base": 0}, "objects": [{"size_level": 0, "start": {"x": 12, "y": 12, "angle": 0}}],
            "event": "independent", "agents": [
            {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
             "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
            {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 14, "angle": 0},
             "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 0, "sign": 1}}]}"#,
        )
        .expect("a scene");
        let parameters = PhaseParameters { simulations: 40, particles: 5, ..PhaseParameters::default() };
        let minds = MindParameters::Phase(parameters);
        let settings = SimulationSettings { minds, max_steps: 8, ..SimulationSettings::default() };
        let event = simulate(&scene, 3, &settings).expect("an event");
        let observed =
            Recording::of_event("a", event.clone(), String::new(), Value::Null).observed().expect("rows");
        Decisions::of(&event, &observed, parameters).expect("decisions")
    }

    /// Each searched decision is there once, with shares that sum to 1 over the actions that were searched.
    #[test]
    fn decisions_have_the_shares_of_their_searches() {
        let decisions = decisions();
        let count = decisions.values.len();
        assert!(count > 8, "{count}");
        assert_eq!(decisions.shared.len(), count * SHARED);
        assert_eq!(decisions.actions.len(), count * ACTIONS * OF_ACTION);
        for (shares, masks) in decisions.shares.chunks(ACTIONS).zip(decisions.masks.chunks(ACTIONS)) {
            assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            assert!(shares.iter().zip(masks).all(|(&share, &mask)| share == 0.0 || mask > MASKED_LOGIT));
        }
        // ln 12 to ln 13, the actions without releasing or without grasping.
        let uniform = decisions.others[0] / count as f64;
        assert!((2.48..2.57).contains(&uniform), "{uniform}");
    }

    /// The network in training and the one that minds evaluate give the same policy and value.
    #[test]
    fn the_evaluated_network_is_the_trained_one() {
        let mut random = TrainingRun::<PolicyNetwork>::first_weights(3);
        let network = PolicyNetwork::published(&mut random).expect("a network");
        let bytes = to_safetensors(&network).expect("a file");
        let evaluated = phase_agent::PolicyNetwork::from_safetensors(&bytes).expect("the same network");
        let decisions = decisions();
        let tensor = |values: &[f32], shape: &[usize]| {
            Tensor::from_vec(values.to_vec(), shape, &Device::Cpu).expect("a tensor")
        };
        for k in 0..3 {
            let shared = &decisions.shared[k * SHARED..(k + 1) * SHARED];
            let actions = &decisions.actions[k * ACTIONS * OF_ACTION..(k + 1) * ACTIONS * OF_ACTION];
            let (logs, value) = network
                .forward(
                    &tensor(shared, &[1, SHARED]),
                    &tensor(actions, &[1, ACTIONS, OF_ACTION]),
                    &tensor(&[0.0; ACTIONS], &[1, ACTIONS]),
                )
                .expect("outputs");
            let rows = actions.as_chunks::<OF_ACTION>().0;
            let features = Features {
                shared: shared.try_into().expect("as many"),
                actions: rows.try_into().expect("as many"),
            };
            let found = evaluated.evaluate(&features, &Action::ALL);
            let trained: Vec<Vec<f32>> = logs.exp().and_then(|policy| policy.to_vec2()).expect("numbers");
            for (trained, found) in trained[0].iter().zip(&found.policy) {
                assert!((f64::from(*trained) - found).abs() < 1e-6, "{trained} {found}");
            }
            let value: Vec<Vec<f32>> = value.to_vec2().expect("numbers");
            assert!((f64::from(value[0][0]) - found.value).abs() < 1e-5);
        }
    }

    /// The loss of an event is its mean cross-entropy, which is near that of the uniform policy at first.
    #[test]
    fn the_loss_is_a_mean() {
        let decisions = decisions();
        let network =
            PolicyNetwork::published(&mut TrainingRun::<PolicyNetwork>::first_weights(1)).expect("a network");
        let [one, two] = [vec![&decisions], vec![&decisions, &decisions]]
            .map(|events| network.loss(&events, None).expect("a loss").scores);
        assert!(one.iter().zip(&two).all(|(one, two)| (one - two).abs() < 1e-4));
        assert!((2.0..3.2).contains(&one[0]), "{}", one[0]);
    }
}
