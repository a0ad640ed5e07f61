//! Every kind of scene satisfies its specification.

use phase_model::{
    AgentId, Attitude, EventKind, Goal, LandmarkId, Layout, Relation, Sign,
    random::{Purpose, stream},
};
use phase_predicates::achieved;
use phase_sampler::{Request, SampleError, Starts, Variant, sample, sample_kind};
use proptest::prelude::*;
use std::collections::BTreeSet;

fn all_layouts() -> Vec<Layout> {
    Layout::all_used().collect()
}

fn relation_of(kind: EventKind) -> (Relation, Attitude) {
    match kind {
        EventKind::Helping => (Relation::Friendly, Attitude::Help),
        EventKind::Hindering => (Relation::Adversarial, Attitude::Hinder),
        EventKind::Chasing | EventKind::Competing => (Relation::Adversarial, Attitude::Neutral),
        EventKind::Collaborating => (Relation::Friendly, Attitude::Neutral),
        EventKind::Independent => (Relation::Neutral, Attitude::Neutral),
    }
}

/// A goal independent of its owner: an agent's own number does not matter.
fn anonymous(goal: Goal) -> Goal {
    match goal {
        Goal::AgentOnLandmark { landmark, sign, .. } => {
            Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark, sign }
        }
        Goal::Touch { sign, .. } => Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign },
        object => object,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Nothing overlaps, nothing is solved, and labels are those of the variant, whatever the seed.
    #[test]
    fn scenes_keep_the_promises_of_their_variant(
        seed: u64,
        which in 0..Variant::ALL.len(),
        goal_index in 0_usize..48,
    ) {
        let variant = Variant::ALL[which];
        let layouts = all_layouts();
        let request = Request { variant, goal_index, layouts: &layouts, starts: Starts::Near };
        let scene = sample(&request, &mut stream(seed, Purpose::Scene, 0)).unwrap();
        prop_assert_eq!(scene.kind, variant.kind());
        prop_assert_eq!(scene.validate_without_overlap(), Ok(()));
        prop_assert_eq!(scene.check_kind(), Ok(()));
        prop_assert_eq!(scene.warnings(), []);
        prop_assert!(layouts.contains(&scene.layout));
        let physics = scene.physics();
        let state = scene.initial_state();
        for goal in scene.goals() {
            let goal_objects = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
            prop_assert!(!achieved(&physics, &state, goal_objects), "starts solved");
        }
        let (relation, attitude) = relation_of(scene.kind);
        prop_assert_eq!(scene.relation(), relation);
        let mut attitudes = scene.attitudes();
        attitudes.sort_by_key(|attitude| *attitude == Attitude::Neutral);
        prop_assert_eq!(attitudes, [attitude, Attitude::Neutral]);
        let [mut goal_objects, mut found] =
            [variant.goals(goal_index), scene.goals()].map(|goals| goals.map(anonymous));
        goal_objects.sort_unstable();
        found.sort_unstable();
        prop_assert_eq!(goal_objects, found);
    }
}

#[test]
fn all_values_of_every_variable_occur() {
    let layouts = all_layouts();
    let mut used = BTreeSet::new();
    let mut sizes = BTreeSet::new();
    let mut strengths = BTreeSet::new();
    let mut objects = BTreeSet::new();
    let mut social = [0; 2];
    for variant in Variant::ALL {
        for index in 0..60 {
            let request =
                Request { variant, goal_index: index as usize, layouts: &layouts, starts: Starts::Near };
            let scene = sample(&request, &mut stream(7, Purpose::Scene, index)).unwrap();
            used.insert(scene.layout);
            objects.insert(scene.objects.len());
            for (k, agent) in scene.agents.iter().enumerate() {
                sizes.insert(agent.size);
                strengths.insert(agent.strength);
                social[k] += usize::from(agent.attitude != Attitude::Neutral);
            }
        }
    }
    assert_eq!(used.len(), 90);
    assert_eq!((sizes.len(), strengths.len()), (4, 4));
    assert_eq!(objects.into_iter().collect::<Vec<_>>(), [0, 1, 2]);
    // A social agent is equally often the one and the other.
    let variants = Variant::ALL.iter().filter(|it| it.attitude() != Attitude::Neutral).count();
    assert_eq!(social[0] + social[1], 60 * variants);
    assert!(social[0].abs_diff(social[1]) < 120, "{social:?}");
}

#[test]
fn turns_name_all_goals_equally_often() {
    let mut physical = BTreeSet::new();
    for variant in Variant::ALL {
        let pairs: BTreeSet<[Goal; 2]> =
            (0..variant.goal_count()).map(|goal_index| variant.goals(goal_index)).collect();
        assert_eq!(pairs.len(), variant.goal_count(), "{variant:?}");
        assert_eq!(variant.goals(3), variant.goals(3 + variant.goal_count()));
        let landmarks = |role: usize, landmark: usize| {
            let turns = (0..variant.goal_count()).map(|goal_index| variant.goals(goal_index)[role]);
            turns.filter(|goal| goal.landmark() == Some(LandmarkId::ALL[landmark])).count()
        };
        for role in 0..2 {
            assert!((1..4).all(|landmark| landmarks(role, landmark) == landmarks(role, 0)), "{variant:?}");
        }
        let own = if relation_of(variant.kind()).1 == Attitude::Neutral { 0 } else { 1 };
        for goal_index in 0..variant.goal_count() {
            physical.extend(variant.goals(goal_index)[own..].iter().copied().map(anonymous));
        }
    }
    assert_eq!(physical.len(), 14, "the paper's physical goals");
}

#[test]
fn layouts_come_from_the_pool_alone() {
    let pool = [Layout::new(13, None).unwrap(), Layout::new(6, None).unwrap()];
    for variant in Variant::ALL {
        let drawn: BTreeSet<Layout> = (0..12)
            .filter_map(|index| {
                let request =
                    Request { variant, goal_index: index as usize, layouts: &pool, starts: Starts::Near };
                sample(&request, &mut stream(1, Purpose::Scene, index)).ok()
            })
            .map(|scene| scene.layout)
            .collect();
        assert!(!drawn.is_empty() && drawn.iter().all(|layout| pool.contains(layout)), "{variant:?}");
    }
    // Without a narrow door no agent is kept out by one.
    let open = [Layout::new(0, None).unwrap()];
    let request = Request { variant: Variant::Blocked, goal_index: 0, layouts: &open, starts: Starts::Near };
    let refused = sample(&request, &mut stream(1, Purpose::Scene, 0));
    assert_eq!(refused, Err(SampleError(Variant::Blocked)));
    let none = Request { variant: Variant::Chase, goal_index: 0, layouts: &[], starts: Starts::Near };
    assert!(sample(&none, &mut stream(1, Purpose::Scene, 0)).is_err());
}

#[test]
fn one_stream_one_scene() {
    for kind in EventKind::ALL {
        let draw = |index| sample_kind(kind, &mut stream(3, Purpose::Scene, index)).unwrap();
        assert_eq!(draw(0).kind, kind);
        assert_eq!(draw(0), draw(0));
        assert_ne!(draw(0), draw(1));
    }
}

/// On the grid are all bodies that no variant needs elsewhere, and the scenes are as sound as others.
#[test]
fn bodies_start_on_the_grid_where_that_is_asked_for() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let elsewhere = [Variant::Move, Variant::MakeWay];
    for variant in Variant::ALL.into_iter().filter(|variant| !elsewhere.contains(variant)) {
        let request = Request { variant, goal_index: 1, layouts: &layouts, starts: Starts::Grid };
        let scene = sample(&request, &mut stream(5, Purpose::Scene, 0)).expect("a scene");
        let agents = scene.agents.iter().map(|agent| agent.start.position);
        let places: Vec<_> = agents.chain(scene.objects.iter().map(|object| object.start.position)).collect();
        let on_grid = places
            .iter()
            .all(|place| phase_model::arena::START_POINTS.iter().flatten().any(|point| point == place));
        assert!(on_grid, "{}: {places:?}", variant.name());
        assert!(scene.validate_without_overlap().is_ok());
    }
}
