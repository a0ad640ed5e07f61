//! Ids: what they accept, how they are written, and how they relate to each other.

use phase_model::{
    AgentId, BodySet, Entity, Goal, IdError, LandmarkId, ObjectId, RoomId, SlotId, arena, layout::room_of,
};

/// All numbers from 0 to `last` make a value with that number, in order, which is written as the bare number;
/// larger numbers are rejected with the same message by every conversion.
macro_rules! check {
    ($id:ident, $kind:literal, $last:literal) => {
        assert_eq!($id::ALL.len(), $last + 1);
        for (number, id) in (0_u8..).zip($id::ALL) {
            assert_eq!((id.number(), id.index()), (number, usize::from(number)));
            assert_eq!((u8::from(id), usize::from(id)), (number, usize::from(number)));
            assert_eq!($id::new(number), Ok(id));
            assert_eq!($id::try_from(number), Ok(id));
            assert_eq!($id::try_from(usize::from(number)), Ok(id));
            assert_eq!(id.to_string(), number.to_string());
            assert_eq!(serde_json::to_string(&id).expect("a number"), number.to_string());
            assert_eq!(serde_json::from_str::<$id>(&number.to_string()).expect("a number"), id);
        }
        for number in [$last + 1_u8, u8::MAX] {
            let error = IdError { kind: $kind, last: $last, number: number.into() };
            assert_eq!($id::new(number), Err(error));
            assert_eq!($id::try_from(usize::from(number)), Err(error));
            let sentence = format!(concat!($kind, " must be 0 to ", $last, ", not {}"), number);
            assert_eq!(error.to_string(), sentence);
            let refused = serde_json::from_str::<$id>(&number.to_string()).expect_err("too great");
            assert!(refused.to_string().starts_with(&sentence), "{refused}");
        }
        // A number that does not fit a u8 must not wrap around.
        let error = $id::try_from(256_usize).expect_err("too great");
        assert_eq!(error.number, 256);
        for text in ["-1", "256", "0.5", "null", "\"0\""] {
            assert!(serde_json::from_str::<$id>(text).is_err(), "{text}");
        }
    };
}

#[test]
fn numbers_become_ids_and_back_and_others_are_refused() {
    check!(AgentId, "agent", 1);
    check!(ObjectId, "object", 1);
    check!(LandmarkId, "landmark", 3);
    check!(RoomId, "room", 3);
    check!(SlotId, "wall slot", 3);
}

#[test]
fn the_other_of_the_other_is_oneself() {
    for agent in AgentId::ALL {
        assert_ne!(agent.other(), agent);
        assert_eq!(agent.other().other(), agent);
    }
}

#[test]
fn a_room_has_the_number_of_the_landmark_in_it() {
    for landmark in LandmarkId::ALL {
        let room = landmark.room();
        assert_eq!((room.number(), room.landmark()), (landmark.number(), landmark));
        assert_eq!(room_of(arena::LANDMARKS[landmark]), room);
    }
}

#[test]
fn arrays_are_indexed_by_ids() {
    let mut names = ["first", "second"];
    assert_eq!([names[AgentId::ONE], names[ObjectId::ZERO]], ["second", "first"]);
    names[AgentId::ONE] = "last";
    assert_eq!(names, ["first", "last"]);
    let all = Entity::ALL.map(Entity::index);
    assert_eq!(all, [0, 1, 2, 3]);
    assert!(Entity::ALL.into_iter().all(|entity| all[entity] == entity.index()));
}

#[test]
fn goals_that_name_nothing_are_refused_where_they_are_read() {
    let goal = |agent, landmark| {
        let text =
            format!(r#"{{"kind":"agent_on_landmark","agent":{agent},"landmark":{landmark},"sign":1}}"#);
        serde_json::from_str::<Goal>(&text).map_err(|error| error.to_string())
    };
    assert!(goal(1, 3).is_ok());
    let refused = goal(0, 4).expect_err("no such landmark");
    assert!(refused.contains("landmark must be 0 to 3, not 4"), "{refused}");
    let refused = goal(2, 0).expect_err("no such agent");
    assert!(refused.contains("agent must be 0 to 1, not 2"), "{refused}");
}

#[test]
fn the_set_of_all_objects_has_no_agent_in_it() {
    let objects: Vec<Entity> = BodySet::OBJECTS.iter().collect();
    assert_eq!(objects, ObjectId::ALL.map(Entity::Object));
}
