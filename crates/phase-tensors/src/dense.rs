//! Fully connected layers of the small networks that are evaluated here, in a fixed order and in double
//! precision: no neural-network library is needed, and the result is the same everywhere, bit for bit.

use crate::{NamedTensor, TensorFile, TensorsError, check_shape};

/// Outputs that are summed side by side, because the terms of one sum wait for each other.
const TOGETHER: usize = 4;

/// One fully connected layer: output o is bias\[o\] + Σ weight\[o · inputs + i\] · input\[i\].
#[derive(Clone, PartialEq, Debug)]
pub struct Dense {
    /// Number of inputs.
    pub inputs: usize,
    /// Number of outputs.
    pub outputs: usize,
    /// Row by row, `outputs` rows of `inputs` weights.
    pub weight: Vec<f32>,
    /// `outputs` biases.
    pub bias: Vec<f32>,
}

impl Dense {
    /// The layer's output, each summed in the order of the inputs.
    #[must_use]
    pub fn apply(&self, inputs: &[f64]) -> Vec<f64> {
        let mut rows = self.weight.chunks_exact(self.inputs.max(1));
        let mut outputs = Vec::with_capacity(self.outputs);
        for biases in self.bias.chunks(TOGETHER) {
            let Some(a) = rows.next() else { break };
            let [b, c, d] = core::array::from_fn(|_| rows.next().unwrap_or(a));
            let mut sums = [0.0; TOGETHER];
            for ((((input, a), b), c), d) in inputs.iter().zip(a).zip(b).zip(c).zip(d) {
                for (sum, weight) in sums.iter_mut().zip([a, b, c, d]) {
                    *sum += f64::from(*weight) * input;
                }
            }
            outputs.extend(biases.iter().zip(sums).map(|(&bias, sum)| f64::from(bias) + sum));
        }
        outputs
    }

    /// The layer in a file: tensors `NAME.weight` and `NAME.bias`.
    ///
    /// # Errors
    /// If one of them is missing or they do not match each other.
    pub fn read(file: &TensorFile<'_>, name: &str) -> Result<Self, TensorsError> {
        let weight = file.tensor(&format!("{name}.weight"))?;
        let bias = vector(file, &format!("{name}.bias"))?;
        let [outputs, inputs] = weight.shape[..] else {
            return Err(TensorsError::Shape {
                name: weight.name,
                expected: vec![bias.len(), 0],
                found: weight.shape,
            });
        };
        Ok(Self { inputs, outputs, weight: weight.values, bias })
    }
}

/// A one-dimensional tensor of a file.
///
/// # Errors
/// If it is missing or has another shape.
pub fn vector(file: &TensorFile<'_>, name: &str) -> Result<Vec<f32>, TensorsError> {
    let NamedTensor { shape, values, .. } = file.tensor(name)?;
    check_shape(name, &[values.len()], &shape)?;
    Ok(values)
}

/// max(0, ·) of every value.
#[must_use]
pub fn relu(mut values: Vec<f64>) -> Vec<f64> {
    values.iter_mut().for_each(|number| *number = number.max(0.0));
    values
}
