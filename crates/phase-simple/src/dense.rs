//! Fully connected layers of the small networks that are evaluated here, in a fixed order and in double
//! precision: no neural-network library is needed, and the result is the same everywhere, bit for bit.

use phase_tensors::{NamedTensor, TensorFile, TensorsError, check_shape};

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
    /// The layer's output, summed in order.
    #[must_use]
    pub fn apply(&self, inputs: &[f64]) -> Vec<f64> {
        let rows = self.weight.chunks_exact(self.inputs.max(1));
        let sum = |row: &[f32]| -> f64 {
            row.iter().zip(inputs).map(|(&weight, input)| f64::from(weight) * input).sum()
        };
        self.bias.iter().zip(rows).map(|(&bias, row)| f64::from(bias) + sum(row)).collect()
    }

    /// The layer in a file: tensors `NAME.weight` and `NAME.bias`.
    ///
    /// # Errors
    /// If one of them is missing or they do not match each other.
    pub(crate) fn read(file: &TensorFile<'_>, name: &str) -> Result<Self, TensorsError> {
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
pub(crate) fn vector(file: &TensorFile<'_>, name: &str) -> Result<Vec<f32>, TensorsError> {
    let NamedTensor { shape, values, .. } = file.tensor(name)?;
    check_shape(name, &[values.len()], &shape)?;
    Ok(values)
}

/// max(0, ·) of every value.
pub(crate) fn relu(mut values: Vec<f64>) -> Vec<f64> {
    values.iter_mut().for_each(|number| *number = number.max(0.0));
    values
}
