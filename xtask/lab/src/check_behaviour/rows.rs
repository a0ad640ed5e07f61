//! The table of what is checked.

use phase_model::AgentId;

/// One row of the table: scenes in a separate file, how they are simulated, and what counts as success.
#[derive(Clone, Copy, Debug)]
pub(super) struct BehaviourTest {
    /// The row, from 1.
    pub row: u8,
    /// The file in a set's folder without `.json`; begins with the row, or with the one whose scenes it
    /// shares.
    pub name: &'static str,
    /// The intended behaviour, in words.
    pub title: &'static str,
    /// An agent that is idle because the scene is about the other alone.
    pub idle: Option<AgentId>,
    /// An agent that is idle in the scene's counterfactual, if it has one.
    pub control: Option<AgentId>,
    /// The agent whose goal is timed, with and without the other's contribution.
    pub judged: AgentId,
    /// λ of the subgoal value, if it is not the usual one.
    pub lambda: Option<f64>,
    /// Whether the event lasts to its maximum length however quiet it is.
    pub runs_full_length: bool,
    /// Condition of success.
    pub criterion: Criterion,
}

/// Condition on which an event counts as a success.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Criterion {
    /// Every agent that is not idle reaches its goal.
    Reach,
    /// Every agent that is not idle reaches its goal, and at the end nothing is held and nothing moves.
    Fetch,
    /// Of the two regions on either side of its room the agent first searches this one (0 the near one of one
    /// room, 1 the larger).
    SearchFirst(usize),
    /// The goal is reached, and the object was carried by both at once.
    CarryTogether,
    /// The goal is reached only with the helper, or at least a tenth sooner.
    Help,
    /// The goal is reached, not a tenth later than without the other, and the other did not touch any entity.
    StayOut,
    /// The goal is missed because of the hinderer, or reached at least a tenth later.
    Hinder(Form),
    /// The chaser pursues the other, which by fleeing is caught at least a tenth later or not at all.
    Chase,
    /// Both have touched the object, and it is decided or fought over.
    Compete,
    /// Every agent reaches its goal, releases its object, and stays still to the end of a long event.
    Rest,
    /// The hinderer holds the object, most of the time without being perceived by the victim.
    Unseen,
    /// Once the agent acts, it looks where the object of its goal was at the start before it sees the object,
    /// or sees the object first. By then the object has to have been moved to another room unseen.
    WrongPlace(bool),
}

/// Way in which an agent is hindered.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Form {
    /// By obstructing it.
    Block,
    /// By taking the object.
    Take,
    /// By pulling at the object it holds.
    Drag,
    /// By putting the object where it does not fit.
    Hide,
    /// By not being touched.
    Evade,
    /// By causing what the other wants to avoid.
    Undo,
}

impl Criterion {
    /// Success, in words.
    #[must_use]
    pub(super) const fn description(self) -> &'static str {
        match self {
            Self::Reach => "goals reached",
            Self::Fetch => "goal reached, nothing held and nothing moving at the end",
            Self::SearchFirst(0) => "half of the near unseen region seen before half of the larger",
            Self::SearchFirst(_) => "half of the larger unseen region seen before half of the near",
            Self::CarryTogether => "goal reached, object carried by both at once over 1 u",
            Self::Help => "goal reached only with the helper, or at least a tenth sooner",
            Self::StayOut => "goal reached, not a tenth later, the other never touched",
            Self::Hinder(_) => "goal missed only with the hinderer, or reached at least a tenth later",
            Self::Chase => {
                "chaser heads for the other by its way, flight delays the catch by a tenth or prevents it"
            }
            Self::Compete => "both have had the object, and one won or both pulled for 5 steps",
            Self::Unseen => "the object held for 3 steps, more than half of them unseen by the victim",
            Self::WrongPlace(true) => "the place that the object has left seen before the object",
            Self::WrongPlace(false) => "the object seen before the place that it has left",
            Self::Rest => "goals reached, nothing held, everybody still from 8 steps later to the end",
        }
    }
}

const ALONE: BehaviourTest = BehaviourTest {
    row: 0,
    name: "",
    title: "",
    idle: Some(AgentId::ONE),
    control: None,
    judged: AgentId::ZERO,
    lambda: None,
    runs_full_length: false,
    criterion: Criterion::Reach,
};
const BOTH: BehaviourTest = BehaviourTest { idle: None, ..ALONE };
const HELPING: BehaviourTest = BehaviourTest {
    row: 5,
    control: Some(AgentId::ZERO),
    judged: AgentId::ONE,
    criterion: Criterion::Help,
    ..BOTH
};
const HINDERING: BehaviourTest =
    BehaviourTest { row: 6, control: Some(AgentId::ZERO), judged: AgentId::ONE, ..BOTH };
const UNSEEN: BehaviourTest =
    BehaviourTest { row: 12, control: None, criterion: Criterion::Unseen, ..HINDERING };
const SEARCHING: BehaviourTest = BehaviourTest { row: 2, name: "02-search", ..ALONE };

/// Everything that is checked, in order.
pub(super) const PARTS: [BehaviourTest; 25] = [
    BehaviourTest { row: 1, name: "01-landmark", title: "going to a landmark through doors", ..ALONE },
    BehaviourTest {
        title: "searching at lambda 0.05: the near region first",
        lambda: Some(0.05),
        criterion: Criterion::SearchFirst(0),
        ..SEARCHING
    },
    BehaviourTest {
        title: "searching at lambda 0: the larger region first",
        lambda: Some(0.0),
        criterion: Criterion::SearchFirst(1),
        ..SEARCHING
    },
    BehaviourTest {
        row: 3,
        name: "03-fetch",
        title: "fetching an object through doors and letting go",
        criterion: Criterion::Fetch,
        ..ALONE
    },
    BehaviourTest {
        row: 4,
        name: "04-together",
        title: "carrying together",
        control: Some(AgentId::ZERO),
        criterion: Criterion::CarryTogether,
        ..BOTH
    },
    BehaviourTest { name: "05a-reach", title: "helping: an object out of reach", ..HELPING },
    BehaviourTest { name: "05b-carry", title: "helping: a load too heavy", ..HELPING },
    BehaviourTest { name: "05c-clear", title: "helping: a door to clear", ..HELPING },
    BehaviourTest {
        name: "05d-no-need",
        title: "helping: no help needed",
        criterion: Criterion::StayOut,
        ..HELPING
    },
    BehaviourTest {
        name: "06a-block",
        title: "hindering: blocking a door",
        criterion: Criterion::Hinder(Form::Block),
        ..HINDERING
    },
    BehaviourTest {
        name: "06b-take",
        title: "hindering: taking the object away",
        criterion: Criterion::Hinder(Form::Take),
        ..HINDERING
    },
    BehaviourTest {
        name: "06c-drag",
        title: "hindering: dragging against",
        criterion: Criterion::Hinder(Form::Drag),
        ..HINDERING
    },
    BehaviourTest {
        name: "06d-hide",
        title: "hindering: hiding the object",
        criterion: Criterion::Hinder(Form::Hide),
        ..HINDERING
    },
    BehaviourTest {
        name: "06e-evade",
        title: "hindering: not being touched",
        criterion: Criterion::Hinder(Form::Evade),
        ..HINDERING
    },
    BehaviourTest {
        name: "06f-undo",
        title: "hindering: bringing about what is not to be",
        criterion: Criterion::Hinder(Form::Undo),
        ..HINDERING
    },
    BehaviourTest {
        row: 7,
        name: "07-chase",
        title: "chasing and fleeing",
        control: Some(AgentId::ONE),
        criterion: Criterion::Chase,
        ..BOTH
    },
    BehaviourTest {
        row: 8,
        name: "08-compete",
        title: "competing for an object",
        control: Some(AgentId::ONE),
        criterion: Criterion::Compete,
        ..BOTH
    },
    BehaviourTest { row: 9, name: "09-doorway", title: "meeting in a doorway", ..BOTH },
    BehaviourTest {
        row: 10,
        name: "10-rest",
        title: "resting once the goal is reached",
        runs_full_length: true,
        criterion: Criterion::Rest,
        ..ALONE
    },
    BehaviourTest {
        row: 10,
        name: "10-rest-both",
        title: "both resting once their goals are reached",
        runs_full_length: true,
        criterion: Criterion::Rest,
        ..BOTH
    },
    BehaviourTest {
        row: 11,
        name: "11a-false-belief",
        title: "an object moved unseen is sought where it was",
        criterion: Criterion::WrongPlace(true),
        ..BOTH
    },
    BehaviourTest {
        row: 11,
        name: "11b-true-belief",
        title: "told of the move, it is sought where it is",
        criterion: Criterion::WrongPlace(false),
        ..BOTH
    },
    BehaviourTest { name: "06b-take", title: "taking the object away unseen", ..UNSEEN },
    BehaviourTest { name: "06c-drag", title: "dragging the object unseen", ..UNSEEN },
    BehaviourTest { name: "06d-hide", title: "hiding the object unseen", ..UNSEEN },
];
