//! The PHASE command line.

fn main() {}
