//! The labels that an audit is about.

/// A label that the forest predicts.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Target {
    /// Friendly, neutral, adversarial.
    Relation,
    /// The kind of event.
    Kind,
    /// The goal of agent 0, of sixteen classes.
    GoalOfAgent0,
    /// The goal of agent 1.
    GoalOfAgent1,
    /// Each agent's knowledge of the other's mind and of objects without finding it out.
    Knowledge,
}

/// Number of targets.
pub(crate) const TARGETS: usize = Target::ALL.len();

impl Target {
    /// All targets, in the order of tables.
    pub const ALL: [Self; 5] =
        [Self::Relation, Self::Kind, Self::GoalOfAgent0, Self::GoalOfAgent1, Self::Knowledge];

    /// The name of the target in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Relation => "relation",
            Self::Kind => "kind",
            Self::GoalOfAgent0 => "goal of agent 0",
            Self::GoalOfAgent1 => "goal of agent 1",
            Self::Knowledge => "knowledge",
        }
    }
}
