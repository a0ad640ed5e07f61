//! Plans of agents that contest an object, or wait for help.

use crate::support;

use phase_model::{AgentId, Attitude, ObjectId, Size::*, Strength::*, Vec2};
use phase_planner::Planner;
use support::{Setup, object_on, plain};

/// An agent lets go of an object that it cedes, and waits beside it; one that hinders does so by other means.
#[test]
fn an_object_that_is_ceded_is_not_touched() {
    let contest = Setup {
        agents: [(Small, Strong, Vec2::new(14.0, 16.5)), (Small, Strong, Vec2::new(18.0, 19.0))],
        objects: vec![(Small, Vec2::new(16.0, 18.0))],
        goals: [object_on(0, 2), object_on(0, 3)],
        holds: [Some(0), Some(0)],
        ..plain()
    };
    let ceding = |setup: &Setup, agent: usize| {
        let who = AgentId::ALL[agent];
        let planner = Planner::new(setup.physics(), setup.layout, who, setup.goals, setup.attitudes[agent]);
        let plan = planner.plan_ceding(&setup.state(), setup.observed, Some(ObjectId::ZERO));
        plan.subgoals.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(ceding(&contest, 0), ["not Attach(agent 0, object 0)"]);
    let left = Setup { holds: [None, Some(0)], ..contest };
    assert!(left.words(0).contains(&"Attach(agent 0, object 0)".into()), "{:?}", left.words(0));
    assert_eq!(ceding(&left, 0), Vec::<String>::new(), "it is beside the object");
    let far = Setup {
        agents: [(Small, Strong, Vec2::new(7.0, 18.0)), left.agents[1]],
        ..Setup { objects: left.objects.clone(), ..left }
    };
    assert_eq!(ceding(&far, 0), ["Close(agent 0, object 0)"]);
    let hindering = Setup {
        goals: [object_on(0, 3).negated(), object_on(0, 3)],
        attitudes: [Attitude::Hinder, Attitude::Neutral],
        ..Setup { objects: far.objects.clone(), ..far }
    };
    assert!(hindering.words(0).iter().any(|word| word.contains("Attach")), "{:?}", hindering.words(0));
    let other_means = ceding(&hindering, 0);
    assert!(
        !other_means.is_empty() && !other_means.iter().any(|word| word.contains("Attach")),
        "{other_means:?}"
    );
    // Two that want the same cede nothing.
    let together = Setup {
        goals: [object_on(0, 3); 2],
        attitudes: [Attitude::Neutral; 2],
        holds: [Some(0), Some(0)],
        ..Setup { objects: hindering.objects.clone(), ..hindering }
    };
    assert_eq!(ceding(&together, 0), together.words(0));
}

/// An agent that has no part in the best plan, because the helper serves it alone, tries for itself, and
/// lends a hand where it is not in the way.
#[test]
fn who_is_helped_shows_what_it_wants_first() {
    let setup = Setup {
        agents: [(Small, Mighty, Vec2::new(20.0, 9.0)), (Small, Weak, Vec2::new(8.0, 18.0))],
        objects: vec![(Small, Vec2::new(22.0, 8.0))],
        goals: [object_on(0, 2); 2],
        attitudes: [Attitude::Help, Attitude::Neutral],
        ..plain()
    };
    let tries = ["Close(agent 1, object 0)", "Attach(agent 1, object 0)"];
    assert_eq!(setup.words(1)[..2], tries);
    let helped = Setup { holds: [Some(0), None], ..setup };
    assert_eq!(helped.words(1)[..2], tries);
}
