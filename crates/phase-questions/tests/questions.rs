//! Answers, frames, balance and scores, on synthetic events.

use phase_evidence::Track;
use phase_model::{
    AgentId, Entity, EventKind, Judgement, LandmarkId, ObjectId, RelationProbabilities, RoleProbabilities,
    Scene, State, Vec2, arena::LANDMARKS, words::Names,
};
use phase_questions::{
    Answer, BUDGETS, Choice, Control, Facts, FrameBudget, NONE, Query, Question, Watched, accepted,
    frames_needed, parse_answer, parse_free, questions, reordered, sampled, score, shown_steps,
};
use rand::SeedableRng;
use serde_json::Value;

fn scene(kind: &str, alpha: i8, landmark: usize) -> Scene {
    let goal = format!(r#"{{"kind": "object_on_landmark", "object": 0, "landmark": {landmark}, "sign": 1}}"#);
    let agent = |alpha: i8, x: f32, goal: &str| {
        format!(
            r#"{{"size_level": 1, "strength_level": 1, "alpha": {alpha}, "goal": {goal},
                "start": {{"x": {x}, "y": 8, "angle": 0}}}}"#
        )
    };
    let own = format!(r#"{{"kind": "agent_on_landmark", "agent": 0, "landmark": {landmark}, "sign": 1}}"#);
    let first = match alpha {
        0 => own,
        1 => goal.clone(),
        _ => goal.replace("\"sign\": 1", "\"sign\": -1"),
    };
    Scene::from_json(&format!(
        r#"{{"layout": {{"base": 0}}, "agents": [{}, {}], "objects": [{{"size_level": 1, "start": {{"x": 12, "y": 5}}}}],
            "event": "{kind}"}}"#,
        agent(alpha, 8.0, &first),
        agent(0, 24.0, &goal),
    ))
    .expect("a scene")
}

/// Agent 0 and object 0 go straight from the bottom left to a landmark in 40 steps. An agent that is not
/// independent is there, too, in the second half.
fn track(scene: &Scene, landmark: usize) -> Track {
    let start = scene.initial_state();
    let to = LANDMARKS[landmark];
    let states = (0..=40u8).map(|step| {
        let mut state = start;
        for entity in [Entity::Agent(AgentId::ZERO), Entity::Object(ObjectId::ZERO)] {
            let body = &mut state.bodies[entity];
            body.position += f32::from(step) / 40.0 * (to - body.position);
        }
        if step > 20 && scene.kind != EventKind::Independent {
            let object = state.position(Entity::Object(ObjectId::ZERO));
            state.bodies[Entity::Agent(AgentId::ONE)].position = object;
        }
        state
    });
    Track { physics: scene.physics(), states: states.collect() }
}

fn facts(k: usize, kind: &str, alpha: i8) -> Facts {
    let landmark = k % 3;
    let scene = scene(kind, alpha, landmark);
    let track = track(&scene, landmark);
    Facts { id: format!("event-{k:03}"), set: None, scene, track, inside: None, ratings: Some([3, 1, 0]) }
}

fn events() -> Vec<Facts> {
    let kinds = [("helping", 1), ("hindering", -1), ("independent", 0)];
    (0..36).map(|k| facts(k, kinds[k / 3 % 3].0, kinds[k / 3 % 3].1)).collect()
}

fn benchmark() -> Vec<Question> {
    questions(&events(), &Names::PAPER, None, &mut rand_pcg(1))
}

fn rand_pcg(seed: u64) -> impl rand::Rng {
    phase_model::random::Pcg64Mcg::seed_from_u64(seed)
}

#[test]
fn answers_are_the_labels_and_equally_frequent() {
    let events = events();
    let all = benchmark();
    let of = |name: &str| all.iter().filter(|it| it.query.type_name() == name).collect::<Vec<_>>();
    let relations = of("relation");
    assert_eq!(relations.len(), 36);
    for question in &relations {
        let facts = events.iter().find(|it| it.id == question.events[0]).expect("an event");
        assert_eq!(question.options[question.answer].value, facts.scene.relation().name());
        let people = question.p_human.as_ref().expect("ratings");
        let friendly = question.options.iter().position(|it| it.value == "friendly").expect("an option");
        assert_eq!(people[friendly], 0.75);
    }
    for (place, count) in [0, 1, 2].map(|k| (k, relations.iter().filter(|it| it.answer == k).count())) {
        assert_eq!(count, 12, "place {place}");
    }
    // Goals at which the subject already is are not asked about, and are no options.
    for question in of("goal") {
        assert_eq!(question.options.len(), 3);
        assert!(question.options.iter().all(|it| it.value != LandmarkId::BOTTOM_LEFT.to_string()));
    }
    // The same seed asks the same, another in other words and orders.
    assert_eq!(all, benchmark());
    assert_ne!(all, questions(&events, &Names::PAPER, None, &mut rand_pcg(2)));
}

#[test]
fn motion_answers_what_it_shows() {
    let facts = facts(1, "independent", 0);
    let object = Entity::Object(ObjectId::ZERO);
    let seen = |query: Query| query.seen(&facts.track);
    assert_eq!(seen(Query::EndRoom { entity: object }).as_deref(), Some("1"));
    assert_eq!(seen(Query::RoomAt { entity: object, step: 1 }).as_deref(), Some("3"));
    assert_eq!(seen(Query::RoomAt { entity: object, step: 99 }), None, "past the end");
    let still = Entity::Agent(AgentId::ONE);
    assert_eq!(seen(Query::EndRoom { entity: still }).as_deref(), Some("2"));
    assert_eq!(seen(Query::EntersFirst { agent: AgentId::ONE }), None, "it enters none");
    assert_eq!(seen(Query::Carrier { object: ObjectId::ZERO }).as_deref(), Some("neither"));
    assert_eq!(seen(Query::Relation), None, "not a matter of motion alone");
}

#[test]
fn judgements_choose_options() {
    let values = |all: &[&str]| all.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>();
    let judged = |helps: [f64; 2], friendly: f64| Watched {
        track: facts(0, "helping", 1).track,
        stills: facts(0, "helping", 1).track,
        judgement: Some(Judgement {
            relation: RelationProbabilities {
                friendly,
                adversarial: (1.0 - friendly) / 2.0,
                neutral: (1.0 - friendly) / 2.0,
            },
            roles: Some(RoleProbabilities { helps, hinders: [0.1; 2] }),
            ..Judgement::default()
        }),
    };
    let one = judged([0.2, 0.5], 0.8);
    let relation = values(&["neutral", "friendly", "adversarial"]);
    assert_eq!(Query::Relation.choice(core::slice::from_ref(&one), &relation), Some(1));
    let roles = values(&["neither", "0", "1"]);
    assert_eq!(Query::Role.choice(core::slice::from_ref(&one), &roles), Some(2));
    let pair = [judged([0.1, 0.1], 0.5), judged([0.1, 0.6], 0.5)];
    assert_eq!(Query::PairHelp.choice(&pair, &values(&["0", "1"])), Some(1));
    // Without a judgement nothing speaks for any option.
    let blind = Watched { judgement: None, ..one };
    assert_eq!(Query::Relation.choice(&[blind], &relation), None);
}

#[test]
fn frames_are_spaced_evenly_and_show_straight_lines() {
    assert_eq!(shown_steps(40, FrameBudget::Frames(5)), [0, 10, 20, 30, 40]);
    assert_eq!(shown_steps(3, FrameBudget::Frames(64)), [0, 1, 2, 3]);
    assert_eq!(shown_steps(40, FrameBudget::All).len(), 41);
    let mut whole = facts(0, "helping", 1).track;
    // A detour between two frames is not seen.
    whole.states[5].bodies[0].position = Vec2::new(25.0, 3.0);
    let seen = sampled(&whole, FrameBudget::Frames(5));
    assert_eq!(seen.states.len(), whole.states.len());
    let place = |state: &State| state.position(Entity::Agent(AgentId::ZERO));
    assert_eq!(place(&seen.states[10]), place(&whole.states[10]));
    let middle = 0.5 * (place(&whole.states[0]) + place(&whole.states[10]));
    assert!(place(&seen.states[5]).distance(middle) < 1e-4);
    assert_eq!(sampled(&whole, FrameBudget::All), whole);
    let back: Vec<usize> = (0..=40).rev().collect();
    assert_eq!(place(&reordered(&whole, &back).states[0]), place(&whole.states[40]));
}

#[test]
fn the_least_number_of_frames_is_that_from_which_all_greater_ones_suffice() {
    let all = benchmark();
    let question = all.iter().find(|it| it.query == Query::Relation).expect("a question");
    let right = question.options[question.answer].value.clone();
    let watch = |knowing: &[FrameBudget], budget: FrameBudget| {
        let relation = |name: &str| f64::from(u8::from(name == right)) * 0.8 + 0.1;
        let knows = knowing.contains(&budget);
        let relation = RelationProbabilities {
            friendly: if knows { relation("friendly") } else { 0.1 },
            adversarial: if knows { relation("adversarial") } else { 0.1 },
            neutral: if knows { relation("neutral") } else { 0.1 },
        };
        let judgement = Some(Judgement { relation, ..Judgement::default() });
        let track = facts(0, "helping", 1).track;
        Some(Watched { stills: track.clone(), track, judgement })
    };
    let needed = |knowing: &[FrameBudget]| frames_needed(question, |_, budget| watch(knowing, budget));
    assert_eq!(needed(&BUDGETS), Some(FrameBudget::Frames(4)));
    assert_eq!(needed(&BUDGETS[2..]), Some(FrameBudget::Frames(16)));
    assert_eq!(needed(&[BUDGETS[0], BUDGETS[5]]), Some(FrameBudget::All), "four were luck");
    assert_eq!(needed(&BUDGETS[..5]), None);
}

#[test]
fn one_option_of_n_is_none_of_these() {
    let all = benchmark();
    let relations: Vec<&Question> = all.iter().filter(|it| it.query == Query::Relation).collect();
    let right = relations.iter().filter(|it| it.shown(Control::NoneOfThese).0[it.answer] == NONE).count();
    for question in &relations {
        let (texts, _) = question.shown(Control::NoneOfThese);
        assert_eq!(texts.iter().filter(|text| **text == NONE).count(), 1);
        assert!(!question.shown(Control::Video).0.contains(&NONE));
        assert!(question.prompt(Control::Video).contains("\nB. "));
    }
    assert!((6..=18).contains(&right), "about a third of 36: {right}");
}

#[test]
fn answers_are_read_as_models_write_them() {
    let options = ["the red agent", "the green agent", "both agents"];
    for (text, option) in [
        ("B", Some(1)),
        (" (c) ", Some(2)),
        ("A.", Some(0)),
        ("B) the green agent", Some(1)),
        ("C both agents", Some(2)),
        ("**B**", Some(1)),
        ("The answer is B.", Some(1)),
        ("Answer: C", Some(2)),
        ("I think it is the red agent", Some(0)),
        ("A guess would be the green agent", Some(1)),
        ("D", None),
        ("", None),
        ("the red agent or the green agent", None),
        ("Because of its speed", None),
    ] {
        assert_eq!(parse_answer(text, &options), option, "{text:?}");
    }
    // A word is no part of another.
    assert_eq!(parse_answer("I do not know", &["yes", "no"]), None);
    assert_eq!(parse_answer("No, it has not.", &["yes", "no"]), Some(1));
}

#[test]
fn answers_in_words_name_one_value() {
    let names = &Names::PAPER;
    let object = ObjectId::ZERO;
    let agent = AgentId::ZERO;
    let room = Query::EndRoom { entity: Entity::Object(object) };
    let carrier = Query::Carrier { object };
    let seen = Query::Seen { agent, object, step: 12 };
    for (query, text, value) in [
        (room, "It is in the top-left room.", Some("0")),
        (room, "UPPER LEFT", Some("0")),
        (room, "from the top left to the bottom left", None),
        (room, "in a room", None),
        (carrier, "Red", Some("0")),
        (carrier, "the green agent, alone", Some("1")),
        (carrier, "a green object", None),
        (carrier, "No one.", Some("neither")),
        (seen, "No, it knows nothing", Some("no")),
        (seen, "not now", None),
        (Query::Stronger, "They are equally strong", None),
        (Query::Relation, "hostile", Some("adversarial")),
        (Query::PairHelp, "the left video", Some("0")),
        (Query::Kind, "anything", None),
    ] {
        assert_eq!(parse_free(text, &query, names).as_deref(), value, "{text:?}");
    }
    // No words name two values of a type.
    for query in [room, carrier, seen, Query::Stronger, Query::Relation, Query::PairHelp] {
        for it in accepted(&query, names) {
            for words in it.anywhere.iter().chain(&it.alone) {
                assert_eq!(parse_free(words, &query, names), Some(it.value.clone()), "{words}");
            }
        }
    }
}

#[test]
fn scores_count_types_frames_and_people() {
    let option = |value: &str| Choice { value: value.into(), text: value.into() };
    let question = |id: &str, query: Query, answer: usize| Question {
        id: id.into(),
        query,
        events: vec!["a".into()],
        video: "a".into(),
        set: Some("s".into()),
        until: None,
        text: "?".into(),
        options: vec![option("x"), option("y")],
        answer,
        frames: Some(FrameBudget::Frames(8)),
        p_human: (query == Query::Relation).then(|| vec![0.5, 0.5]),
        stratum: String::new(),
        proof: Value::Null,
    };
    let all = [
        question("r1", Query::Relation, 0),
        question("r2", Query::Relation, 1),
        question("s1", Query::Stronger, 1),
        question("b1", Query::IsRight { agent: AgentId::ZERO, object: ObjectId::ZERO, step: 9 }, 0),
        question("b2", Query::IsRight { agent: AgentId::ZERO, object: ObjectId::ZERO, step: 9 }, 1),
    ];
    let answer = |id: &str, option: Option<usize>, control: Control| Answer {
        id: id.into(),
        control,
        option,
        probabilities: id.starts_with('r').then(|| vec![0.5, 0.5]),
    };
    let answers = [
        answer("r1", Some(0), Control::Video),
        answer("r2", Some(1), Control::Video),
        answer("s1", None, Control::Video),
        answer("s1", Some(1), Control::Reversed),
        answer("s1", Some(0), Control::FreeForm),
        answer("b1", Some(0), Control::Video),
        answer("b2", Some(0), Control::Video),
    ];
    let score = score(&all, &answers);
    let row = |control: &str, group: &str| {
        let row = score.rows.iter().find(|row| row.control == control && row.group == group);
        row.map(|row| (row.accuracy.right, row.accuracy.of))
    };
    assert_eq!(row("video", "all"), Some((3, 5)));
    assert_eq!(row("video", "relation"), Some((2, 2)));
    assert_eq!(row("video", "frames 8"), Some((3, 5)));
    assert_eq!(row("reversed", "stronger"), Some((1, 1)));
    let free = score.rows.iter().find(|row| row.control == "free-form").expect("a row");
    assert_eq!((free.accuracy.right, free.accuracy.chance), (0, 0.5), "one of two values");
    assert_eq!(score.unreadable, 1);
    assert_eq!(score.sets.map(|sets| (sets.right, sets.of)), Some((1, 1)));
    let pairs = score.belief_pairs.map(|pairs| (pairs.right, pairs.of, pairs.chance));
    assert_eq!(pairs, Some((0, 1, 0.25)), "one of two is half a pair");
    let entropy = core::f64::consts::LN_2;
    assert!(score.cross_entropy.is_some_and(|it| (it - entropy).abs() < 1e-12));
    assert!(score.human_entropy.is_some_and(|it| (it - entropy).abs() < 1e-12));
}
