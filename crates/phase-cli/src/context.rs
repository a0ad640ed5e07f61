//! What every command is given beside its own options.

/// A program that runs the commands of this crate, as its messages name it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Program {
    /// What is typed to start it.
    pub name: &'static str,
    /// What to do for neural networks where it was built without them.
    pub networks_hint: &'static str,
}

/// The program `phase`.
pub const PHASE: Program = Program {
    name: "phase",
    networks_hint: "install `phase` with its default features (`cargo install --path crates/phase-cli`)",
};

/// What every command is given beside its own options.
#[derive(Clone, Copy, Debug)]
pub struct Context {
    /// The program that was started.
    pub program: Program,
}
