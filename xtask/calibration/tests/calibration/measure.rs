use crate::support::{Drifting, probe, probes, run, runs};
use phase_calibration::{
    Deviation, ErrorQuantiles, Probe, Replay, Run, grip_of, horizon_errors, probes_report, replay_reports,
    run_reports,
};
use phase_model::{Action, AgentId, Body, MAX_ENTITIES, ObjectId, PhysicsConfig, Side, State, Vec2};
use serde_json::json;

#[test]
fn probes_are_followed_step_by_step_and_substep_by_substep() {
    let probes =
        Probe::parse(&probes(&[probe("push_one"), probe("push_two"), probe("other")])).expect("probes");
    let report = probes_report::<Drifting<true>>(&probes);
    assert_eq!((report.n, report.each.len()), (3, 3));
    assert_eq!(report.families.keys().collect::<Vec<_>>(), ["other", "push"]);
    let push = &report.families["push"];
    assert_eq!((push.n, push.steps, push.grip_mismatches), (2, 4, 2));
    // After the idle substep 0.25 u, after five more 1.5 u, after ten more 2.75 u.
    assert_eq!(push.position, ErrorQuantiles { median: 1.5, p90: 2.75, max: 2.75 });
    assert_eq!(push.angle, ErrorQuantiles { median: 0.5, p90: 1.0, max: 1.0 });
    // 0.5 u to 2.75 u twice over; ten of twenty are at most 1.5 u, eighteen at most 2.5 u.
    assert_eq!(push.substeps.position, ErrorQuantiles { median: 1.5, p90: 2.5, max: 2.75 });
    assert_eq!((push.within_0_01, push.within_0_1), (0.0, 0.0));
    assert_eq!(report.each[0].start, Deviation { position: 0.25, angle: 0.0 });

    let from_record = probes_report::<Drifting<false>>(&probes);
    assert_eq!(from_record.families["push"].position, ErrorQuantiles { median: 1.25, p90: 2.5, max: 2.5 });
    assert_eq!(from_record.each[0].start.position, 0.25, "the idle substep is still measured");
}

#[test]
fn velocities_are_given_after_the_idle_substep() {
    let mut value = probe("coast");
    value["init_velocities"] = json!([null, null, [3, -4], null]);
    let probe = &Probe::parse(&probes(&[value])).expect("a probe")[0];
    assert_eq!(probe.velocities, [None, None, Some(Vec2::new(3.0, -4.0)), None]);
}

#[test]
fn runs_are_followed_freely_and_restarted() {
    let runs = Run::parse(&runs(&[run("long", 11), run("short", 2)])).expect("runs");
    let reports = run_reports::<Drifting<true>>(&runs);
    assert_eq!(reports[0].steps, 11);
    assert_eq!(reports[0].position_by_step[..2], [1.5, 2.75]);
    assert_eq!((reports[1].steps, reports[1].steps_within_0_5), (2, 0));
    assert_eq!(reports[1].grip_mismatches, Some(0));
    // 1.25 u a step, and 0.25 u more in the two restarts at state 0, before which lies the idle substep.
    let one = horizon_errors::<Drifting<true>>(&runs, 1).expect("restarts");
    assert_eq!((one.n, one.median, one.p90, one.p99), (13, 1.25, 1.5, 1.5));
    let ten = horizon_errors::<Drifting<true>>(&runs, 10).expect("restarts");
    assert_eq!((ten.n, ten.median, ten.p99), (2, 12.5, 12.75));
    assert_eq!(horizon_errors::<Drifting<true>>(&runs, 12), None);
}

#[test]
fn real_rows_are_means_over_substeps() {
    let physics = PhysicsConfig {
        walls: Vec::new(),
        agents: [phase_model::AgentBody { radius: 0.8, max_force: 150.0 }; 2],
        object_radii: [0.8; 2],
        object_count: 0,
    };
    let rest = [Body::default(); MAX_ENTITIES];
    let mut off = rest;
    // An absent object does not count.
    off[3].position.x = 9.0;
    let replay = Replay {
        id: "one".into(),
        physics,
        initial: State::new(rest),
        actions: vec![[Action::Stop; 2]; 2],
        rows: vec![off; 3],
    };
    let reports = replay_reports::<Drifting<false>>(&[replay]);
    // The idle substep and the mean of one to five more: 0.25 + 0.75 u; then 1.25 u more.
    assert_eq!(reports[0].position_by_step, [1.0, 2.25]);
    assert_eq!((reports[0].steps, reports[0].grip_mismatches), (2, None));
}

#[test]
fn grips_are_on_the_side_where_the_object_lies() {
    let quarter = core::f32::consts::FRAC_PI_2;
    // Facing −x: the head is to the left, the right flank up.
    for (offset, side) in [
        ([-2.0, 0.0], Side::Head),
        ([2.0, 0.1], Side::Tail),
        ([0.0, 2.0], Side::Right),
        ([0.1, -2.0], Side::Left),
    ] {
        let mut state = State::new([Body::default(); MAX_ENTITIES]);
        state.bodies[1] = Body::at_rest(Vec2::new(10.0, 10.0), quarter);
        state.bodies[2] = Body::at_rest(Vec2::new(10.0, 10.0) + Vec2::from(offset), 2.0);
        let grip = grip_of(&state, AgentId::ONE, ObjectId::ZERO);
        assert_eq!((grip.object, grip.side), (ObjectId::ZERO, side), "{offset:?}");
        assert!((grip.relative_angle - (2.0 - quarter)).abs() < 1e-6);
    }
}

#[test]
fn what_is_no_number_is_no_small_error() {
    let mut bodies = [Body::default(); MAX_ENTITIES];
    bodies[0].position.x = f32::NAN;
    bodies[1].angle = f32::NAN;
    let physics = &Run::parse(&runs(&[run("r", 1)])).expect("a run")[0].physics;
    let deviation = Deviation::between(physics, &bodies, &[Body::default(); MAX_ENTITIES]);
    assert_eq!(deviation, Deviation { position: f32::INFINITY, angle: f32::INFINITY });
}
