//! As much of the compact protocol of Thrift as it takes to see what a Parquet file declares, before a reader believes it.

/// Deepest nesting of structures; the format itself needs eight.
const DEEPEST: usize = 32;

/// The types of values, by their numbers in the protocol.
mod kind {
    pub(super) const TRUE: u8 = 1;
    pub(super) const FALSE: u8 = 2;
    pub(super) const BYTE: u8 = 3;
    pub(super) const WHOLE: core::ops::RangeInclusive<u8> = 4..=6;
    pub(super) const DOUBLE: u8 = 7;
    pub(super) const BINARY: u8 = 8;
    pub(super) const LIST: u8 = 9;
    pub(super) const SET: u8 = 10;
    pub(super) const MAP: u8 = 11;
    pub(super) const STRUCTURE: u8 = 12;
}

/// The rule that is violated.
pub(super) type Result<T> = core::result::Result<T, String>;

/// A value that is read from its first byte on.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Bytes read so far.
    pub(super) const fn position(&self) -> usize {
        self.at
    }

    /// Reads a structure: `whole` receives every whole number in it with the numbers of the fields that lead to it. Every list
    /// has room for as many elements as it declares: an element takes a byte at least.
    pub(super) fn structure(&mut self, whole: &mut dyn FnMut(&[u16], i64)) -> Result<()> {
        self.structure_at(&mut Vec::new(), whole)
    }

    fn structure_at(&mut self, path: &mut Vec<u16>, whole: &mut dyn FnMut(&[u16], i64)) -> Result<()> {
        if path.len() >= DEEPEST {
            return Err("its structures are nested too deeply".into());
        }
        let mut field: u16 = 0;
        loop {
            let head = self.byte()?;
            if head == 0 {
                return Ok(());
            }
            field = match head >> 4 {
                0 => u16::try_from(self.zigzag()?).map_err(|_| "it has a field without a number")?,
                step => field.wrapping_add(step.into()),
            };
            path.push(field);
            self.value(head & 15, path, whole)?;
            path.pop();
        }
    }

    fn value(&mut self, kind: u8, path: &mut Vec<u16>, whole: &mut dyn FnMut(&[u16], i64)) -> Result<()> {
        match kind {
            kind::TRUE | kind::FALSE => Ok(()),
            kind::BYTE => self.skip(1),
            kind if kind::WHOLE.contains(&kind) => {
                let number = self.zigzag()?;
                whole(path, number);
                Ok(())
            }
            kind::DOUBLE => self.skip(8),
            kind::BINARY => {
                let length = self.varint()?;
                self.skip(length)
            }
            kind::LIST | kind::SET => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.varint()? } else { u64::from(head >> 4) };
                self.elements(count, head & 15, path, whole)
            }
            kind::MAP => {
                let count = self.varint()?;
                if count == 0 {
                    return Ok(());
                }
                let kinds = self.byte()?;
                for _ in 0..self.fitting(count)? {
                    self.elements(1, kinds >> 4, path, whole)?;
                    self.elements(1, kinds & 15, path, whole)?;
                }
                Ok(())
            }
            kind::STRUCTURE => self.structure_at(path, whole),
            _ => Err("it has a value of an unknown type".into()),
        }
    }

    /// Elements of a list, in which truth values take a byte.
    fn elements(
        &mut self,
        count: u64,
        kind: u8,
        path: &mut Vec<u16>,
        whole: &mut dyn FnMut(&[u16], i64),
    ) -> Result<()> {
        for _ in 0..self.fitting(count)? {
            match kind {
                kind::TRUE | kind::FALSE => self.skip(1)?,
                kind => self.value(kind, path, whole)?,
            }
        }
        Ok(())
    }

    fn fitting(&self, count: u64) -> Result<u64> {
        let left = (self.bytes.len() - self.at) as u64;
        if count <= left { Ok(count) } else { Err(format!("it declares {count} elements in {left} bytes")) }
    }

    fn byte(&mut self) -> Result<u8> {
        let byte = self.bytes.get(self.at).copied().ok_or("it ends within a structure")?;
        self.at += 1;
        Ok(byte)
    }

    fn skip(&mut self, count: u64) -> Result<()> {
        self.at += self.fitting(count)? as usize;
        Ok(())
    }

    fn varint(&mut self) -> Result<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 127) << shift;
            if byte < 128 {
                return Ok(number);
            }
        }
        Err("it has a number that is too long".into())
    }

    fn zigzag(&mut self) -> Result<i64> {
        let number = self.varint()?;
        Ok((number >> 1) as i64 ^ -((number & 1) as i64))
    }
}
