//! A network that chooses among options.

use crate::{Dense, TensorFile, TensorsError, check_shape, relu};

/// A network that scores each option of a choice by the same weights, and the choice as a whole.
///
/// The features that all options share are embedded. A hidden layer adds up what the embedding and the
/// option's own features say; another one and the output make a logit of it. Every layer but the outputs is
/// followed by max(0, ·). The value comes from the embedding.
#[derive(Clone, PartialEq, Debug)]
pub struct ChoiceNetwork {
    embedding: Dense,
    context: Dense,
    option: Dense,
    hidden: Dense,
    output: Dense,
    value: Dense,
}

impl ChoiceNetwork {
    /// The network in a file, for so many features that options share and so many of each option. Its layers
    /// are `embedding`, `context`, `action` (of an option's features), `hidden`, `output` and `value`.
    ///
    /// # Errors
    /// If tensors are missing or have other shapes.
    pub fn read(file: &TensorFile<'_>, shared: usize, of_option: usize) -> Result<Self, TensorsError> {
        let layer = |name| Dense::read(file, name);
        let network = Self {
            embedding: layer("embedding")?,
            context: layer("context")?,
            option: layer("action")?,
            hidden: layer("hidden")?,
            output: layer("output")?,
            value: layer("value")?,
        };
        let Self { embedding, context, option, hidden, output, value } = &network;
        for (name, layer, inputs, outputs) in [
            ("embedding.weight", embedding, shared, embedding.outputs),
            ("context.weight", context, embedding.outputs, context.outputs),
            ("action.weight", option, of_option, context.outputs),
            ("hidden.weight", hidden, context.outputs, hidden.outputs),
            ("output.weight", output, hidden.outputs, 1),
            ("value.weight", value, embedding.outputs, 1),
        ] {
            check_shape(name, &[outputs, inputs], &[layer.outputs, layer.inputs])?;
        }
        Ok(network)
    }

    /// The logit of each option, and the value of the choice.
    #[must_use]
    pub fn evaluate<'a>(&self, shared: &[f32], options: impl Iterator<Item = &'a [f32]>) -> (Vec<f64>, f64) {
        let doubles = |features: &[f32]| -> Vec<f64> { features.iter().map(|&it| it.into()).collect() };
        let only = |outputs: Vec<f64>| outputs.first().copied().unwrap_or_default();
        let embedded = relu(self.embedding.apply(&doubles(shared)));
        let context = self.context.apply(&embedded);
        let logit = |features: &[f32]| {
            let mut sums = self.option.apply(&doubles(features));
            sums.iter_mut().zip(&context).for_each(|(sum, context)| *sum += context);
            only(self.output.apply(&relu(self.hidden.apply(&relu(sums)))))
        };
        (options.map(logit).collect(), only(self.value.apply(&embedded)))
    }
}
