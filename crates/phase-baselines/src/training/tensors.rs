//! Named tensors in a safetensors file.

use safetensors::{Dtype, SafeTensorError, SafeTensors, tensor::TensorView};
use std::collections::HashMap;
use thiserror::Error;

/// Why bytes are not the file they should be.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum TensorsError {
    /// The bytes are something else.
    #[error("is no safetensors file: {0}")]
    Container(String),
    /// It is a file of tensors, but of another kind.
    #[error("field `{field}` must be {expected:?}")]
    Kind {
        /// The entry of its metadata.
        field: &'static str,
        /// What it must say.
        expected: String,
    },
    /// A tensor is not there.
    #[error("tensor `{0}` is missing")]
    Missing(String),
    /// A tensor is none of those of its network.
    #[error("tensor `{0}` is none of this network")]
    Unknown(String),
    /// A tensor holds another type of numbers.
    #[error("tensor `{0}` must hold 32-bit floats")]
    Type(String),
    /// A tensor has another shape than in the network.
    #[error("tensor `{name}` must have the shape {expected:?}, not {found:?}")]
    Shape {
        /// The tensor.
        name: String,
        /// What it must have.
        expected: Vec<usize>,
        /// What it has.
        found: Vec<usize>,
    },
    /// A number is none.
    #[error("tensor `{0}` must hold finite numbers")]
    NotFinite(String),
    /// The network cannot be read or changed.
    #[error("the network cannot be read or changed: {0}")]
    Network(String),
}

impl From<candle_core::Error> for TensorsError {
    fn from(error: candle_core::Error) -> Self {
        Self::Network(error.to_string())
    }
}

impl From<SafeTensorError> for TensorsError {
    fn from(error: SafeTensorError) -> Self {
        Self::Container(error.to_string())
    }
}

/// A tensor as it stands in a file.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) shape: Vec<usize>,
    pub(super) numbers: Vec<f32>,
}

/// Writes tensors and one entry of metadata; more would stand in the file in an order that changes from run to run.
pub(super) fn write(tensors: &[Named], field: &str, says: &str) -> Result<Vec<u8>, TensorsError> {
    let bytes: Vec<Vec<u8>> = tensors
        .iter()
        .map(|tensor| tensor.numbers.iter().flat_map(|number| number.to_le_bytes()).collect())
        .collect();
    let views = tensors.iter().zip(&bytes).map(|(tensor, bytes)| {
        Ok((&*tensor.name, TensorView::new(Dtype::F32, tensor.shape.clone(), bytes)?))
    });
    let views: Vec<_> = views.collect::<Result<_, TensorsError>>()?;
    Ok(safetensors::serialize(views, Some(HashMap::from([(field.to_owned(), says.to_owned())])))?)
}

/// A file that has been looked into.
pub(super) struct File<'a> {
    tensors: SafeTensors<'a>,
    says: Option<String>,
}

impl<'a> File<'a> {
    /// Opens bytes with the entry `field` in their metadata.
    pub(super) fn open(bytes: &'a [u8], field: &'static str) -> Result<Self, TensorsError> {
        let (_, metadata) = SafeTensors::read_metadata(bytes)?;
        let says = metadata.metadata().as_ref().and_then(|entries| entries.get(field)).cloned();
        Ok(Self { tensors: SafeTensors::deserialize(bytes)?, says })
    }

    /// What the entry says, if it is there.
    pub(super) fn says(&self) -> Option<&str> {
        self.says.as_deref()
    }

    /// Whether there is a tensor of this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.tensors.tensor(name).is_ok()
    }

    /// The names of all tensors.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.tensors.names().into_iter()
    }

    /// The numbers of a tensor of this shape.
    pub(super) fn numbers(&self, name: &str, shape: &[usize]) -> Result<Vec<f32>, TensorsError> {
        let view = self.tensors.tensor(name).map_err(|_| TensorsError::Missing(name.into()))?;
        if view.dtype() != Dtype::F32 {
            return Err(TensorsError::Type(name.into()));
        }
        if view.shape() != shape {
            let (expected, found) = (shape.into(), view.shape().into());
            return Err(TensorsError::Shape { name: name.into(), expected, found });
        }
        let (numbers, _) = view.data().as_chunks();
        let numbers: Vec<f32> = numbers.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
        if numbers.iter().all(|number| number.is_finite()) {
            Ok(numbers)
        } else {
            Err(TensorsError::NotFinite(name.into()))
        }
    }
}
