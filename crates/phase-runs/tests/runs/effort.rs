//! What somebody asked for, in the settings of the simulation.

use phase_minds::{Foresight, MindKind, MindParameters, Prior};
use phase_runs::effort::{Effort, MindChoice, description};
use phase_sim::{Engine, SimulationSettings};

fn minds(kind: MindKind) -> MindChoice {
    MindChoice { kind: Some(kind), ..MindChoice::default() }
}

#[test]
fn who_asks_for_nothing_gets_the_defaults() {
    assert_eq!(Effort::default().settings().expect("settings"), SimulationSettings::default());
}

#[test]
fn every_request_changes_its_setting_alone() {
    let defaults = SimulationSettings::default();
    let of = |effort: Effort| effort.settings().expect("settings");
    let fewer = of(Effort { max_steps: Some(7), ..Effort::default() });
    assert_eq!(fewer, SimulationSettings { max_steps: 7, ..defaults });
    let quick = of(Effort { engine: Some(Engine::Forward), ..Effort::default() });
    assert_eq!(quick, SimulationSettings { engine: Engine::Forward, ..defaults });
    for kind in MindKind::ALL {
        let plain = MindParameters::of(kind);
        let searching = MindChoice { simulations: Some(11), ..minds(kind) };
        let effort = Effort { minds: searching, particles: Some(3), ..Effort::default() };
        let expected = plain.with_particles(3).with_simulations(11);
        assert_eq!(of(effort), SimulationSettings { minds: expected, ..defaults });
        let points =
            of(Effort { minds: minds(kind), foresight: Some(Foresight::Points), ..Effort::default() });
        assert_eq!(points, SimulationSettings { minds: plain.without_collisions(), ..defaults });
    }
    let turns = MindChoice { one_way_turns: true, ..MindChoice::default() };
    let turning = of(Effort { minds: turns, ..Effort::default() });
    assert_eq!(turning, SimulationSettings { one_way_turns: true, ..defaults });
}

#[test]
fn what_minds_of_a_kind_do_not_have_is_refused() {
    for foresight in [Foresight::Coarse, Foresight::Exact] {
        let effort =
            Effort { minds: minds(MindKind::Published), foresight: Some(foresight), ..Effort::default() };
        let error = effort.settings().expect_err("published minds have none").to_string();
        assert!(error.starts_with(&format!("--foresight {}: ", foresight.name())), "{error}");
    }
    let published = Effort { minds: minds(MindKind::Published), ..Effort::default() };
    let error = Effort { prior: Some(Prior::Network), ..published }.settings().expect_err("no priors");
    let rule = "--prior network: published minds search without priors, or take `network-alone`";
    assert_eq!(error.to_string(), rule);
    for kind in [MindKind::Phase, MindKind::Published] {
        let minds = MindChoice { simulations: Some(7), ..minds(kind) };
        let effort = Effort { minds, prior: Some(Prior::NetworkAlone), ..Effort::default() };
        let error = effort.settings().expect_err("no search").to_string();
        assert_eq!(error, "--simulations: minds with --prior network-alone do not search");
    }
    let effort = published;
    let given = MindParameters::of(MindKind::Phase);
    let error = effort.settings_with(given).expect_err("two kinds").to_string();
    assert_eq!(error, "--minds published: the parameters are those of phase minds");
}

/// Two settings that differ in what the description is about read differently.
#[test]
fn settings_that_differ_read_differently() {
    let base = Effort::default();
    let efforts = [
        base,
        Effort { engine: Some(Engine::Forward), ..base },
        Effort { particles: Some(3), ..base },
        Effort { minds: MindChoice { simulations: Some(3), ..MindChoice::default() }, ..base },
        Effort { max_steps: Some(3), ..base },
        Effort { foresight: Some(Foresight::Exact), ..base },
        Effort { prior: Some(Prior::Network), ..base },
        Effort { foresight: Some(Foresight::Points), ..base },
        Effort { minds: minds(MindKind::Published), ..base },
        Effort { minds: minds(MindKind::Published), foresight: Some(Foresight::Points), ..base },
        Effort { minds: minds(MindKind::Published), prior: Some(Prior::NetworkAlone), ..base },
        Effort { minds: MindChoice { one_way_turns: true, ..base.minds }, ..base },
        Effort { minds: MindChoice { strongest_coasts: true, ..base.minds }, ..base },
    ];
    let told: Vec<String> = efforts.iter().map(|it| description(&it.settings().expect("settings"))).collect();
    for (k, one) in told.iter().enumerate() {
        assert!(!told[k + 1..].contains(one), "{one}");
    }
}
