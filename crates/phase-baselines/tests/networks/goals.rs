//! The classes of goals.

use phase_baselines::{
    goals::{CLASSES, class_of, classes, is_absent},
    recognition::LabelledEvent,
};
use phase_model::{AgentId, Goal, LandmarkId, ObjectId, Relation, Sign};
use phase_simple::physical_goals;
use std::collections::BTreeSet;

#[test]
fn every_goal_of_an_agent_has_one_class() {
    for agent in AgentId::ALL {
        let goals = classes(agent);
        assert_eq!(goals.iter().collect::<BTreeSet<_>>().len(), CLASSES);
        for (class, goal) in goals.into_iter().enumerate() {
            assert_eq!(class_of(agent, goal), Some(class));
        }
        // Own goals, the other's for a helper, and the other's negated for a hinderer.
        let other = physical_goals(agent.other(), 2);
        let labels = physical_goals(agent, 2).into_iter().chain(other.iter().copied());
        let all: BTreeSet<usize> = labels
            .chain(other.iter().map(|goal| goal.negated()))
            .map(|goal| class_of(agent, goal).expect("a class"))
            .collect();
        assert_eq!(all.len(), CLASSES, "no class is superfluous");
    }
}

#[test]
fn classes_are_the_same_for_both_agents() {
    let landmark = |agent, sign| Goal::AgentOnLandmark { agent, landmark: LandmarkId::BOTTOM_RIGHT, sign };
    assert_eq!(
        class_of(AgentId::ZERO, landmark(AgentId::ZERO, Sign::Positive)),
        class_of(AgentId::ONE, landmark(AgentId::ONE, Sign::Positive))
    );
    assert_eq!(
        class_of(AgentId::ZERO, landmark(AgentId::ONE, Sign::Negative)),
        class_of(AgentId::ONE, landmark(AgentId::ZERO, Sign::Negative))
    );
    assert_ne!(
        class_of(AgentId::ZERO, landmark(AgentId::ONE, Sign::Positive)),
        class_of(AgentId::ONE, landmark(AgentId::ONE, Sign::Positive))
    );
    // Which agent touches which does not matter, and no agent keeps itself off a landmark.
    let touch = |agent, other| Goal::Touch { agent, other, sign: Sign::Positive };
    assert_eq!(
        class_of(AgentId::ZERO, touch(AgentId::ZERO, AgentId::ONE)),
        class_of(AgentId::ZERO, touch(AgentId::ONE, AgentId::ZERO))
    );
    assert_eq!(class_of(AgentId::ZERO, landmark(AgentId::ZERO, Sign::Negative)), None);
}

#[test]
fn goals_about_absent_objects_are_known() {
    for agent in AgentId::ALL {
        for objects in 0..=2 {
            let present: BTreeSet<usize> = (0..CLASSES).filter(|&class| !is_absent(class, objects)).collect();
            let about = |goal: &Goal| match goal {
                Goal::ObjectOnLandmark { object, .. } => usize::from(*object) >= objects,
                Goal::AgentOnLandmark { .. } | Goal::Touch { .. } => false,
            };
            let expected = classes(agent)
                .iter()
                .enumerate()
                .filter(|(_, goal)| !about(goal))
                .map(|(class, _)| class)
                .collect();
            assert_eq!(present, expected);
        }
    }
}

#[test]
fn labels_that_cannot_be_are_refused() {
    let event = crate::support::event(0, 3, 1, 0.0);
    let thing =
        |object| Goal::ObjectOnLandmark { object, landmark: LandmarkId::TOP_LEFT, sign: Sign::Positive };
    assert!(LabelledEvent::new(&event, [thing(ObjectId::ZERO); 2], Relation::Friendly).is_ok());
    let error = LabelledEvent::new(&event, [thing(ObjectId::ZERO), thing(ObjectId::ONE)], Relation::Friendly)
        .unwrap_err();
    assert_eq!(error.agent, AgentId::ONE);
}
