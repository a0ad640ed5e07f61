//! Reading and writing of tensor files.

use crate::TensorsError;
use safetensors::{Dtype, SafeTensors, tensor::TensorView};
use std::collections::HashMap;

/// A tensor as stored in a file.
#[derive(Clone, PartialEq, Debug)]
pub struct NamedTensor {
    /// Its name, unique in its file.
    pub name: String,
    /// Its dimensions, the outermost first.
    pub shape: Vec<usize>,
    /// Its values in row-major order; as many as the product of its dimensions.
    pub values: Vec<f32>,
}

/// The bytes of a file with these tensors, whose entry `field` is `metadata_value`. The same tensors always
/// give the same bytes.
///
/// # Errors
/// [`TensorsError::Container`] if a shape does not match its values, or the tensors cannot be laid out.
pub fn write(tensors: &[NamedTensor], field: &str, metadata_value: &str) -> Result<Vec<u8>, TensorsError> {
    let bytes: Vec<Vec<u8>> = tensors
        .iter()
        .map(|tensor| tensor.values.iter().flat_map(|number| number.to_le_bytes()).collect())
        .collect();
    let views = tensors.iter().zip(&bytes).map(|(tensor, bytes)| {
        Ok((&*tensor.name, TensorView::new(Dtype::F32, tensor.shape.clone(), bytes)?))
    });
    let views: Vec<_> = views.collect::<Result<_, TensorsError>>()?;
    Ok(safetensors::serialize(views, Some(HashMap::from([(field.to_owned(), metadata_value.to_owned())])))?)
}

/// A parsed tensor file.
#[derive(Debug)]
pub struct TensorFile<'a> {
    tensors: SafeTensors<'a>,
    metadata_value: Option<String>,
}

impl<'a> TensorFile<'a> {
    /// Opens bytes with the entry `field` in their metadata.
    ///
    /// # Errors
    /// [`TensorsError::Container`] if they are not such a file.
    pub fn open(bytes: &'a [u8], field: &'static str) -> Result<Self, TensorsError> {
        let (_, metadata) = SafeTensors::read_metadata(bytes)?;
        let metadata_value = metadata.metadata().as_ref().and_then(|entries| entries.get(field)).cloned();
        Ok(Self { tensors: SafeTensors::deserialize(bytes)?, metadata_value })
    }

    /// Opens bytes whose entry `field` has this value.
    ///
    /// # Errors
    /// [`TensorsError::Container`] if they are not such a file, [`TensorsError::Kind`] if the entry has
    /// another value or is missing.
    pub fn open_as(bytes: &'a [u8], field: &'static str, expected: &str) -> Result<Self, TensorsError> {
        let file = Self::open(bytes, field)?;
        if file.metadata_value() == Some(expected) {
            Ok(file)
        } else {
            Err(TensorsError::Kind { field, expected: expected.into() })
        }
    }

    /// The value of the entry, if it exists.
    #[must_use]
    pub fn metadata_value(&self) -> Option<&str> {
        self.metadata_value.as_deref()
    }

    /// Whether there is a tensor of this name.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.tensors.tensor(name).is_ok()
    }

    /// The names of all tensors.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.tensors.names().into_iter()
    }

    /// Checks that there are no tensors but known ones.
    ///
    /// # Errors
    /// [`TensorsError::Unknown`] for one that is not.
    pub fn check_names(&self, is_known: impl Fn(&str) -> bool) -> Result<(), TensorsError> {
        match self.names().find(|name| !is_known(name)) {
            Some(name) => Err(TensorsError::Unknown(name.into())),
            None => Ok(()),
        }
    }

    /// A tensor of any shape.
    ///
    /// # Errors
    /// If there is none of this name, or its values are of another type or not finite.
    pub fn tensor(&self, name: &str) -> Result<NamedTensor, TensorsError> {
        let view = self.tensors.tensor(name).map_err(|_| TensorsError::Missing(name.into()))?;
        if view.dtype() != Dtype::F32 {
            return Err(TensorsError::Type(name.into()));
        }
        let (values, _) = view.data().as_chunks();
        let values: Vec<f32> = values.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
        if !values.iter().all(|number| number.is_finite()) {
            return Err(TensorsError::NotFinite(name.into()));
        }
        Ok(NamedTensor { name: name.into(), shape: view.shape().into(), values })
    }

    /// The values of a tensor of this shape.
    ///
    /// # Errors
    /// [`TensorsError::Missing`], [`TensorsError::Type`] and [`TensorsError::NotFinite`] as of
    /// [`tensor`](Self::tensor), and [`TensorsError::Shape`] for another shape.
    pub fn values(&self, name: &str, shape: &[usize]) -> Result<Vec<f32>, TensorsError> {
        let NamedTensor { shape: found, values, .. } = self.tensor(name)?;
        check_shape(name, shape, &found)?;
        Ok(values)
    }
}

/// Checks a tensor's shape.
///
/// # Errors
/// [`TensorsError::Shape`] if it is another one.
pub fn check_shape(name: &str, expected: &[usize], found: &[usize]) -> Result<(), TensorsError> {
    if expected == found {
        return Ok(());
    }
    Err(TensorsError::Shape { name: name.into(), expected: expected.into(), found: found.into() })
}
