//! Published results on recordings of PHASE, for comparison.

/// A published row of Task 1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GoalRow {
    /// The method.
    pub method: &'static str,
    /// The publication.
    pub source: &'static str,
    /// Goal accuracy of the one, two and three most likely.
    pub goal: [f64; 3],
    /// Relation accuracy.
    pub relation: f64,
}

/// A published row of Task 2 (u).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TrajectoryRow {
    /// The method.
    pub method: &'static str,
    /// The publication.
    pub source: &'static str,
    /// Average displacement error: independent, social, all events.
    pub ade: [f64; 3],
    /// Final displacement error: independent, social, all events.
    pub fde: [f64; 3],
}

const TABLE_1: &str = "paper, Table 1";
const ABLATION: &str = "paper, appendix, ablation study";
const TABLE_2: &str = "paper, Table 2";

/// Task 1 on the 100 test recordings, best first.
pub const GOALS: [GoalRow; 7] = [
    GoalRow { method: "humans", source: TABLE_1, goal: [0.970, 0.990, 0.995], relation: 0.99 },
    GoalRow { method: "SIMPLE", source: TABLE_1, goal: [0.870, 0.890, 0.910], relation: 0.88 },
    GoalRow {
        method: "SIMPLE, later log",
        source: "log of each event published with the code",
        goal: [0.855, 0.895, 0.925],
        relation: 0.90,
    },
    GoalRow { method: "SIMPLE (global)", source: ABLATION, goal: [0.835, 0.865, 0.880], relation: 0.84 },
    GoalRow { method: "SIMPLE (initial)", source: ABLATION, goal: [0.795, 0.825, 0.835], relation: 0.82 },
    GoalRow { method: "ARG", source: TABLE_1, goal: [0.485, 0.665, 0.805], relation: 0.61 },
    GoalRow { method: "2-Level LSTM", source: TABLE_1, goal: [0.405, 0.610, 0.735], relation: 0.77 },
];

/// A published row on the 400 recordings that are not in the test set.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OtherRow {
    /// The method.
    pub method: &'static str,
    /// Share of recordings in which it names the relation that most raters reported, the mean of ten parts
    /// of 100.
    pub people: f64,
    /// Share in which it names the generator's relation, if that is published.
    pub generator: Option<f64>,
}

/// Malik and Isik, Nature Communications 14 (2023), on the recordings that are not in the test set, best
/// first.
pub const OTHER_RECORDINGS: [OtherRow; 3] = [
    OtherRow { method: "the generator's relation", people: 0.869, generator: Some(1.0) },
    OtherRow { method: "SocialGNN", people: 0.783, generator: None },
    OtherRow { method: "SIMPLE", people: 0.667, generator: Some(0.719) },
];

/// Mean share of raters who gave the most frequent answer about those recordings.
pub const OTHER_AGREEMENT: f64 = 0.787;

/// Task 2 on the 100 test recordings, best first.
pub const TRAJECTORIES: [TrajectoryRow; 3] = [
    TrajectoryRow { method: "SIMPLE", source: TABLE_2, ade: [3.39, 4.14, 3.84], fde: [4.42, 5.75, 5.23] },
    TrajectoryRow {
        method: "Social-LSTM",
        source: TABLE_2,
        ade: [6.47, 7.21, 7.02],
        fde: [7.10, 7.93, 7.72],
    },
    TrajectoryRow { method: "STGAT", source: TABLE_2, ade: [6.64, 7.23, 7.08], fde: [7.44, 7.79, 7.70] },
];
