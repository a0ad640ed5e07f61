//! Choices, made by a random generator or by the bytes of an input.

use phase_model::random::Pcg64Mcg;
use rand::RngExt;

/// Something that makes choices.
pub trait Draw {
    /// A number below `count`, which is at least 1.
    fn below(&mut self, count: usize) -> usize;

    /// A number from 0 to 1.
    fn unit(&mut self) -> f32;

    /// A number between two.
    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// One of some values, of which there is at least one.
    fn pick<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }
}

impl Draw for Pcg64Mcg {
    fn below(&mut self, count: usize) -> usize {
        self.random_range(0..count)
    }

    fn unit(&mut self) -> f32 {
        self.random()
    }
}

/// The bytes of an input, which a fuzzer changes to make other choices; zeros after its end.
#[derive(Clone, Copy, Debug)]
pub struct Bytes<'a> {
    left: &'a [u8],
}

impl<'a> Bytes<'a> {
    /// Choices by these bytes.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { left: bytes }
    }

    /// Whether all bytes have been used.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.left.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((&first, left)) = self.left.split_first() else { return 0 };
        self.left = left;
        first
    }

    /// Four bytes as a number, whatever it is: not a number, infinite, subnormal.
    pub fn any_float(&mut self) -> f32 {
        f32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()])
    }

    /// The bytes that are left.
    #[must_use]
    pub fn rest(&self) -> &'a [u8] {
        self.left
    }
}

impl Draw for Bytes<'_> {
    fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    fn unit(&mut self) -> f32 {
        f32::from(u16::from_le_bytes([self.byte(), self.byte()])) / f32::from(u16::MAX)
    }
}
