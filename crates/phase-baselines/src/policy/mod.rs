//! Training of the policy networks of both kinds of minds, which [`phase_agent::PolicyNetwork`] and
//! [`phase_published::PolicyNetwork`] evaluate.
//!
//! The loss is the cross-entropy of the network's policy to the shares of visits of whole searches, plus the
//! squared error of the value. Some decisions of the agents of each event are searched again, wholly, since a
//! search that acts ends once it is decided; and some that an agent with another intent would have made in
//! their place, because inference asks what other agents would do.

mod decisions;

use crate::{
    layer::Layer,
    parameters::Parameter,
    training::{Loss, Network, PublishedNetwork, TrainingSettings},
};
use candle_core::{D, Device, Module, Result, Tensor};
use candle_nn::ops::log_softmax;
use core::marker::PhantomData;
pub use decisions::{Decision, Decisions, OurMinds, PublishedMinds, Searchers};
use phase_model::{Action, random::Pcg64Mcg};

/// Units of the embedding of what all actions have in common.
const EMBEDDING: usize = 32;
/// Units of the hidden layers.
const UNITS: usize = 48;
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

/// The network in training, a [`phase_tensors::ChoiceNetwork`].
#[derive(Clone, Debug)]
pub struct PolicyNetwork<M> {
    embedding: Layer,
    context: Layer,
    action: Layer,
    hidden: Layer,
    output: Layer,
    value: Layer,
    searchers: PhantomData<M>,
}

impl<M> PolicyNetwork<M> {
    /// ln of the policy of each decision, and its value.
    fn forward(&self, shared: &Tensor, actions: &Tensor, masks: &Tensor) -> Result<(Tensor, Tensor)> {
        let embedded = self.embedding.forward(shared)?.relu()?;
        let context = self.context.forward(&embedded)?.unsqueeze(1)?;
        let sums = self.action.forward(actions)?.broadcast_add(&context)?.relu()?;
        let logits = self.output.forward(&self.hidden.forward(&sums)?.relu()?)?.squeeze(D::Minus1)?;
        Ok((log_softmax(&(logits + masks)?, D::Minus1)?, self.value.forward(&embedded)?))
    }
}

impl<M: Searchers> Network for PolicyNetwork<M> {
    type Sample = Decisions;
    const NAME: &'static str = M::NAME;
    const METRICS: &'static [&'static str] = M::METRICS;

    fn parameters(&self) -> Vec<Parameter> {
        let Self { embedding, context, action, hidden, output, value, .. } = self;
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
        let shared = all(|it| &it.shared, M::SHARED)?;
        let decisions = shared.dim(0)?;
        let actions = all(|it| &it.actions, M::OF_ACTION)?.reshape((decisions, ACTIONS, M::OF_ACTION))?;
        let (logs, values) = self.forward(&shared, &actions, &all(|it| &it.masks, ACTIONS)?)?;
        let count = decisions.max(1) as f64;
        let shares = all(|it| &it.shares, ACTIONS)?;
        let policy = ((&shares * &logs)?.sum_all()? / -count)?;
        let value = ((values - all(|it| &it.values, 1)?)?.sqr()?.sum_all()? / count)?;
        let loss = (&policy + (&value * M::VALUE_WEIGHT)?)?;
        let variation = ((shares - logs.exp()?)?.abs()?.sum_all()? / (2.0 * count))?;
        let number = |tensor: &Tensor| Ok::<f64, candle_core::Error>(tensor.to_scalar::<f32>()?.into());
        let others = (0..M::METRICS.len() - 3)
            .map(|k| events.iter().filter_map(|event| event.others.get(k)).sum::<f64>() / count);
        let mut scores = vec![number(&policy)?];
        scores.extend(others);
        scores.extend([number(&variation)?, number(&value)?.sqrt()]);
        Ok(Loss { loss, scores })
    }
}

impl<M: Searchers> PublishedNetwork for PolicyNetwork<M> {
    const BUNDLED_WEIGHTS: &'static [u8] = M::BUNDLED.weights;
    const BUNDLED_RECORD: &'static str = M::BUNDLED.record;

    fn published(random: &mut Pcg64Mcg) -> Result<Self> {
        Ok(Self {
            embedding: Layer::new(M::SHARED, EMBEDDING, random)?,
            context: Layer::new(EMBEDDING, UNITS, random)?,
            action: Layer::new(M::OF_ACTION, UNITS, random)?,
            hidden: Layer::new(UNITS, UNITS, random)?,
            output: Layer::new(UNITS, 1, random)?,
            value: Layer::new(EMBEDDING, 1, random)?,
            searchers: PhantomData,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{
        ACTIONS, Decisions, OurMinds, PolicyNetwork, PublishedMinds, Searchers, decisions::MASKED_LOGIT,
    };
    use crate::training::{Network, PublishedNetwork, TrainingRun, to_safetensors};
    use candle_core::{Device, Tensor};
    use phase_agent::PhaseParameters;
    use phase_event::Recording;
    use phase_minds::MindParameters;
    use phase_model::{Action, Scene};
    use phase_sim::{SimulationSettings, simulate};
    use serde_json::Value;

    type Trained = PolicyNetwork<OurMinds>;

    /// Decisions in an event of one agent that goes to a landmark and one that brings an object.
    fn decisions<M: Searchers>() -> Decisions {
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
        let parameters = M::parameters(&minds).expect("parameters").with_particles(5).with_simulations(40);
        Decisions::of::<M>(&event, &observed, &parameters).expect("decisions")
    }

    /// Each searched decision is there once, with shares that sum to 1 over the actions that were searched.
    fn have_the_shares_of_their_searches<M: Searchers>(uniform: core::ops::Range<f64>) {
        let decisions = decisions::<M>();
        let count = decisions.values.len();
        assert!(count > 8, "{count}");
        assert_eq!(decisions.shared.len(), count * M::SHARED);
        assert_eq!(decisions.actions.len(), count * ACTIONS * M::OF_ACTION);
        for (shares, masks) in decisions.shares.chunks(ACTIONS).zip(decisions.masks.chunks(ACTIONS)) {
            assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            assert!(shares.iter().zip(masks).all(|(&share, &mask)| share == 0.0 || mask > MASKED_LOGIT));
        }
        let found = decisions.others[0] / count as f64;
        assert!(uniform.contains(&found), "{found}");
    }

    #[test]
    fn decisions_have_the_shares_of_their_searches() {
        // ln 12 to ln 13, the actions without releasing or without grasping.
        have_the_shares_of_their_searches::<OurMinds>(2.48..2.57);
        // ln 5 to ln 14, as many as published minds compare.
        have_the_shares_of_their_searches::<PublishedMinds>(1.6..2.64);
    }

    /// Policy and value that minds evaluate for shared features, features of all actions, and weights.
    type Evaluated = fn(&[f32], &[f32], &[u8]) -> (Vec<f64>, f64);

    fn is_evaluated_as_trained<M: Searchers>(evaluated: Evaluated) {
        let mut random = TrainingRun::<PolicyNetwork<M>>::first_weights(3);
        let network = PolicyNetwork::<M>::published(&mut random).expect("a network");
        let bytes = to_safetensors(&network).expect("a file");
        let decisions = decisions::<M>();
        let tensor = |values: &[f32], shape: &[usize]| {
            Tensor::from_vec(values.to_vec(), shape, &Device::Cpu).expect("a tensor")
        };
        for k in 0..3 {
            let shared = &decisions.shared[k * M::SHARED..(k + 1) * M::SHARED];
            let actions = &decisions.actions[k * ACTIONS * M::OF_ACTION..(k + 1) * ACTIONS * M::OF_ACTION];
            let (logs, value) = network
                .forward(
                    &tensor(shared, &[1, M::SHARED]),
                    &tensor(actions, &[1, ACTIONS, M::OF_ACTION]),
                    &tensor(&[0.0; ACTIONS], &[1, ACTIONS]),
                )
                .expect("outputs");
            let (policy, found) = evaluated(shared, actions, &bytes);
            let trained: Vec<Vec<f32>> = logs.exp().and_then(|policy| policy.to_vec2()).expect("numbers");
            for (trained, found) in trained[0].iter().zip(&policy) {
                assert!((f64::from(*trained) - found).abs() < 1e-6, "{trained} {found}");
            }
            let value: Vec<Vec<f32>> = value.to_vec2().expect("numbers");
            assert!((f64::from(value[0][0]) - found).abs() < 1e-5);
        }
    }

    /// The network in training and the one that minds evaluate give the same policy and value.
    #[test]
    fn the_evaluated_network_is_the_trained_one() {
        is_evaluated_as_trained::<OurMinds>(|shared, actions, bytes| {
            let network = phase_agent::PolicyNetwork::from_safetensors(bytes).expect("the same network");
            let features = phase_agent::policy::Features {
                shared: shared.try_into().expect("as many"),
                actions: actions.as_chunks().0.try_into().expect("as many"),
            };
            let found = network.evaluate(&features, &Action::ALL);
            (found.policy, found.value)
        });
        is_evaluated_as_trained::<PublishedMinds>(|shared, actions, bytes| {
            let network = phase_published::PolicyNetwork::from_safetensors(bytes).expect("the same network");
            let features = phase_published::policy::Features {
                shared: shared.try_into().expect("as many"),
                actions: actions.as_chunks().0.try_into().expect("as many"),
            };
            network.evaluate(&features, &Action::ALL)
        });
    }

    /// The loss of an event is its mean cross-entropy, which is near that of the uniform policy at first.
    #[test]
    fn the_loss_is_a_mean() {
        let decisions = decisions::<OurMinds>();
        let network = Trained::published(&mut TrainingRun::<Trained>::first_weights(1)).expect("a network");
        let [one, two] = [vec![&decisions], vec![&decisions, &decisions]]
            .map(|events| network.loss(&events, None).expect("a loss").scores);
        assert!(one.iter().zip(&two).all(|(one, two)| (one - two).abs() < 1e-4));
        assert!((2.0..3.2).contains(&one[0]), "{}", one[0]);
    }
}
