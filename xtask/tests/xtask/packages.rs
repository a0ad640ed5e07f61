//! Commands of the packages below `xtask/`.

use crate::support::{phase, run, text};
use clap::CommandFactory;
use std::{collections::BTreeSet, fs, path::Path};
use xtask::packages::PACKAGES;

/// The command-line interface of a package.
fn interface(package: &str) -> clap::Command {
    match package {
        "phase-lab" => phase_lab::cli::Cli::command(),
        "phase-torture" => phase_torture::cli::Cli::command(),
        "phase-fuzz" => phase_fuzz::command::Cli::command(),
        "phase-golden" => phase_golden::command::Cli::command(),
        other => panic!("{other} is not known here"),
    }
}

#[test]
fn every_command_of_a_package_is_listed_with_what_it_says_of_itself() {
    let of_phase = phase_cli::cli::Cli::command();
    let of_phase: BTreeSet<&str> = of_phase.get_subcommands().map(clap::Command::get_name).collect();
    for (package, listed) in PACKAGES {
        let interface = interface(package);
        let own = interface.get_subcommands().filter(|command| !of_phase.contains(command.get_name()));
        let own: BTreeSet<(String, String)> = own
            .map(|command| {
                let about = command.get_about().map(ToString::to_string).unwrap_or_default();
                (command.get_name().to_owned(), about)
            })
            .collect();
        let listed = listed.iter().map(|&(name, about)| (name.to_owned(), about.to_owned())).collect();
        assert_eq!(own, listed, "{package}");
    }
}

/// A program in the place of cargo shows what it is asked for.
#[cfg(unix)]
#[test]
fn words_reach_the_package_as_they_are_and_its_exit_code_comes_back() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let cargo = folder.path().join("cargo");
    fs::write(&cargo, "#!/bin/sh\nprintf '%s\\n' \"$@\"\nexit 130\n").expect("written");
    fs::set_permissions(&cargo, fs::Permissions::from_mode(0o755)).expect("made executable");
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a workspace").join("Cargo.toml");
    for (words, package, handed_on) in [
        (
            &["fit-reports", "--events", "a b", "--help"][..],
            "phase-lab",
            &["fit-reports", "--events", "a b", "--help"][..],
        ),
        (&["help", "torture"], "phase-torture", &["torture", "--help"]),
        (&["-q", "fuzz", "--seconds", "1"], "phase-fuzz", &["fuzz", "--seconds", "1", "--quiet"]),
        (&["golden", "--machine=wasm", "-v"], "phase-golden", &["golden", "--machine=wasm", "-v"]),
    ] {
        let output =
            phase(folder.path()).args(words).env("CARGO", &cargo).output().expect("the program starts");
        assert_eq!(output.status.code(), Some(130), "{words:?}: {}", text(&output.stderr));
        let said = text(&output.stdout);
        let said: Vec<&str> = said.lines().filter(|word| *word != "--release").collect();
        let manifest = manifest.to_string_lossy();
        let expected =
            [&["run", "--package", package, "--manifest-path", &manifest, "--"], handed_on].concat();
        assert_eq!(said, expected, "{words:?}");
    }
}

#[test]
fn the_commands_of_packages_are_shown_by_help() {
    let folder = tempfile::tempdir().expect("a folder");
    let help = text(&run(folder.path(), &["--help"]).stdout);
    for (name, _) in PACKAGES.iter().flat_map(|(_, commands)| *commands) {
        assert!(help.lines().any(|line| line.trim_start().starts_with(name)), "{name}: {help}");
    }
}
