//! Nested values as Parquet stores them: leaves with definition and repetition levels.
//!
//! The type of a value determines both its column's schema and its levels, so the two cannot disagree.

use parquet::{
    basic::{LogicalType, Repetition, Type as Physical},
    data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int32Type, Int64Type},
    errors::Result,
    schema::types::Type,
};
use std::sync::Arc;

/// The values of one column, in Parquet's own form: every leaf, and a level of each kind for every leaf,
/// empty list and missing value.
#[derive(Debug)]
pub(super) struct Leaves<T: DataType> {
    pub(super) values: Vec<T::T>,
    pub(super) definition: Vec<i16>,
    pub(super) repetition: Vec<i16>,
}

impl<T: DataType> Default for Leaves<T> {
    fn default() -> Self {
        Self { values: Vec::new(), definition: Vec::new(), repetition: Vec::new() }
    }
}

impl<T: DataType> Leaves<T> {
    fn push(&mut self, value: Option<T::T>, definition: i16, repetition: i16) {
        self.values.extend(value);
        self.definition.push(definition);
        self.repetition.push(repetition);
    }

    pub(super) fn clear(&mut self) {
        self.values.clear();
        self.definition.clear();
        self.repetition.clear();
    }
}

/// A value of a column: a number or text, possibly missing, or a list of such values.
pub(super) trait Cell {
    /// Parquet's type of the leaves.
    type Leaf: DataType;
    /// Whether the leaves are floating-point numbers, which compress best byte by byte.
    const FLOATING: bool;
    /// The path from a column's name to its leaf.
    fn path() -> Vec<&'static str>;
    /// The schema of a column of such values.
    fn schema(name: &str) -> Result<Type>;
    /// Appends the value; `depth` lists are around it, and it begins at repetition level `repetition`.
    fn shred(self, depth: i16, repetition: i16, leaves: &mut Leaves<Self::Leaf>);
}

/// A value that is not a list.
pub(super) trait Scalar {
    type Leaf: DataType;
    const PHYSICAL: Physical;
    const LOGICAL: Option<LogicalType> = None;
    const FLOATING: bool = false;
    fn leaf(self) -> <Self::Leaf as DataType>::T;
}

impl Scalar for bool {
    type Leaf = BoolType;
    const PHYSICAL: Physical = Physical::BOOLEAN;
    fn leaf(self) -> bool {
        self
    }
}

impl Scalar for i32 {
    type Leaf = Int32Type;
    const PHYSICAL: Physical = Physical::INT32;
    fn leaf(self) -> i32 {
        self
    }
}

impl Scalar for u64 {
    type Leaf = Int64Type;
    const PHYSICAL: Physical = Physical::INT64;
    const LOGICAL: Option<LogicalType> = Some(LogicalType::Integer { bit_width: 64, is_signed: false });
    fn leaf(self) -> i64 {
        self.cast_signed()
    }
}

impl Scalar for f32 {
    type Leaf = FloatType;
    const PHYSICAL: Physical = Physical::FLOAT;
    const FLOATING: bool = true;
    fn leaf(self) -> f32 {
        self
    }
}

impl Scalar for f64 {
    type Leaf = DoubleType;
    const PHYSICAL: Physical = Physical::DOUBLE;
    const FLOATING: bool = true;
    fn leaf(self) -> f64 {
        self
    }
}

impl Scalar for String {
    type Leaf = ByteArrayType;
    const PHYSICAL: Physical = Physical::BYTE_ARRAY;
    const LOGICAL: Option<LogicalType> = Some(LogicalType::String);
    fn leaf(self) -> ByteArray {
        self.into_bytes().into()
    }
}

fn scalar_schema<S: Scalar>(name: &str, repetition: Repetition) -> Result<Type> {
    Type::primitive_type_builder(name, S::PHYSICAL)
        .with_repetition(repetition)
        .with_logical_type(S::LOGICAL)
        .build()
}

impl<S: Scalar> Cell for S {
    type Leaf = S::Leaf;
    const FLOATING: bool = S::FLOATING;

    fn path() -> Vec<&'static str> {
        Vec::new()
    }

    fn schema(name: &str) -> Result<Type> {
        scalar_schema::<S>(name, Repetition::REQUIRED)
    }

    fn shred(self, depth: i16, repetition: i16, leaves: &mut Leaves<Self::Leaf>) {
        leaves.push(Some(self.leaf()), depth, repetition);
    }
}

impl<S: Scalar> Cell for Option<S> {
    type Leaf = S::Leaf;
    const FLOATING: bool = S::FLOATING;

    fn path() -> Vec<&'static str> {
        Vec::new()
    }

    fn schema(name: &str) -> Result<Type> {
        scalar_schema::<S>(name, Repetition::OPTIONAL)
    }

    fn shred(self, depth: i16, repetition: i16, leaves: &mut Leaves<Self::Leaf>) {
        let present = i16::from(self.is_some());
        leaves.push(self.map(Scalar::leaf), depth + present, repetition);
    }
}

impl<C: Cell> Cell for Vec<C> {
    type Leaf = C::Leaf;
    const FLOATING: bool = C::FLOATING;

    fn path() -> Vec<&'static str> {
        [vec!["list", "element"], C::path()].concat()
    }

    fn schema(name: &str) -> Result<Type> {
        let list = Type::group_type_builder("list")
            .with_repetition(Repetition::REPEATED)
            .with_fields(vec![Arc::new(C::schema("element")?)])
            .build()?;
        Type::group_type_builder(name)
            .with_repetition(Repetition::REQUIRED)
            .with_logical_type(Some(LogicalType::List))
            .with_fields(vec![Arc::new(list)])
            .build()
    }

    fn shred(self, depth: i16, repetition: i16, leaves: &mut Leaves<Self::Leaf>) {
        if self.is_empty() {
            leaves.push(None, depth, repetition);
        }
        for (k, element) in self.into_iter().enumerate() {
            // The first element continues what began around the list; each later one repeats at this depth.
            element.shred(depth + 1, if k == 0 { repetition } else { depth + 1 }, leaves);
        }
    }
}
