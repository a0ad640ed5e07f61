//! JSON with one line for each member of the outermost object, readable for people and `diff`.

use serde_json::ser::Formatter;
use std::io::{self, Write};

/// Compact JSON, except for a line break between the members of the outermost object.
#[derive(Default)]
pub(crate) struct LineFormatter {
    depth: usize,
}

impl Formatter for LineFormatter {
    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth -= 1;
        writer.write_all(b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        match (first, self.depth) {
            (true, _) => Ok(()),
            (false, 1) => writer.write_all(b",\n"),
            (false, _) => writer.write_all(b","),
        }
    }
}
