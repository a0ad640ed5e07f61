//! From which of the sampler's variants the scenes of each part are drawn, and what they must satisfy.

use super::{candidate::Candidate, conditions};
use phase_model::{AgentId, Attitude, EventKind, Goal, Scene};
use phase_sampler::Variant;

/// Recipe by which the scenes of one part are drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recipe {
    /// The part of the table, the name of its file without `.json`.
    pub part: &'static str,
    /// Sources of draws, in rotation over the part's scenes.
    pub sources: &'static [Source],
    /// Whether a draw is a scene of this part.
    pub condition: fn(&Candidate<'_>) -> bool,
}

/// A variant of the sampler and how its goals and attitudes are rewritten.
pub(super) type Source = (Variant, Rewriting);

/// Change of the goals and attitudes of a drawn scene, where the sampler has no variant for a part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Rewriting {
    /// Not at all.
    Unchanged,
    /// The hinderer becomes a helper: its goal is the other's.
    HelpInstead,
    /// Both goals are negated: the hinderer wants to bring about what the other wants to prevent.
    Negated,
    /// The hinderer wants to be on the landmark of the other's goal, the other wants it off.
    Intruding,
}

impl Rewriting {
    /// The rewritten scene.
    pub(super) fn apply(self, mut scene: Scene) -> Scene {
        let [first, second] = &mut scene.agents;
        match self {
            Self::Unchanged => {}
            Self::HelpInstead => {
                first.attitude = Attitude::Help;
                first.goal = second.goal;
                scene.kind = EventKind::Helping;
            }
            Self::Negated => {
                first.goal = first.goal.negated();
                second.goal = second.goal.negated();
            }
            Self::Intruding => {
                if let Goal::AgentOnLandmark { landmark, sign, .. } = second.goal {
                    first.goal = Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark, sign };
                    second.goal = first.goal.negated();
                }
            }
        }
        scene
    }
}

use Rewriting::{HelpInstead, Intruding, Negated, Unchanged};

/// The recipes of all parts, in the order of the table.
pub(super) const RECIPES: [Recipe; 19] = [
    Recipe {
        part: "01-landmark",
        sources: &[(Variant::Places, Unchanged)],
        condition: conditions::errand_through_door,
    },
    Recipe { part: "02-search", sources: &[(Variant::Mixed, Unchanged)], condition: conditions::search },
    Recipe {
        part: "03-fetch",
        sources: &[(Variant::Mixed, Unchanged)],
        condition: conditions::errand_through_door,
    },
    Recipe {
        part: "04-together",
        sources: &[(Variant::Carry, Unchanged)],
        condition: conditions::carry_together,
    },
    Recipe {
        part: "05a-reach",
        sources: &[(Variant::Blocked, Unchanged)],
        condition: conditions::out_of_reach,
    },
    Recipe { part: "05b-carry", sources: &[(Variant::Lift, Unchanged)], condition: conditions::too_heavy },
    Recipe {
        part: "05c-clear",
        sources: &[(Variant::Move, Unchanged)],
        condition: conditions::door_to_clear,
    },
    Recipe {
        part: "05d-no-need",
        sources: &[(Variant::HinderPlace, HelpInstead), (Variant::HinderObject, HelpInstead)],
        condition: conditions::no_need,
    },
    Recipe {
        part: "06a-block",
        sources: &[(Variant::HinderPlace, Unchanged), (Variant::HinderObject, Unchanged)],
        condition: conditions::door_to_block,
    },
    Recipe {
        part: "06b-take",
        sources: &[(Variant::HinderObject, Unchanged)],
        condition: conditions::object_to_take,
    },
    Recipe {
        part: "06c-drag",
        sources: &[(Variant::HinderObject, Unchanged)],
        condition: conditions::object_to_drag,
    },
    Recipe {
        part: "06d-hide",
        sources: &[(Variant::HinderObject, Unchanged)],
        condition: conditions::object_to_hide,
    },
    Recipe {
        part: "06e-evade",
        sources: &[(Variant::Evade, Unchanged)],
        condition: conditions::fleer_is_faster,
    },
    Recipe {
        part: "06f-undo",
        sources: &[
            (Variant::HinderPlace, Intruding),
            (Variant::HinderObject, Negated),
            (Variant::Pester, Unchanged),
        ],
        condition: conditions::undoing,
    },
    Recipe { part: "07-chase", sources: &[(Variant::Chase, Unchanged)], condition: conditions::chase },
    Recipe { part: "08-compete", sources: &[(Variant::Compete, Unchanged)], condition: conditions::compete },
    Recipe { part: "09-doorway", sources: &[(Variant::Places, Unchanged)], condition: conditions::doorway },
    Recipe {
        part: "10-rest",
        sources: &[(Variant::Places, Unchanged), (Variant::Mixed, Unchanged)],
        condition: conditions::errand_alone,
    },
    Recipe {
        part: "10-rest-both",
        sources: &[(Variant::Mixed, Unchanged), (Variant::Places, Unchanged)],
        condition: conditions::separate_errands,
    },
];
