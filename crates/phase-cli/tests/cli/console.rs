//! What goes to stdout and to stderr, and in which colours.

use crate::support::{QUICK, phase, recording, run, text, write_events};

#[test]
fn quiet_leaves_errors_and_results() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    write_events(&path.join("events.json"), &[recording("apart")]);
    let simulate = |out: &str, more: &[&str]| {
        let options = ["simulate", "--events", "events.json", "--no-video", "--out", out];
        let output = run(path, &[&options[..], &QUICK[..], more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        (text(&output.stdout), text(&output.stderr))
    };
    let (result, said) = simulate("said", &[]);
    assert_eq!(said.lines().next(), Some("simulating 1 event"));
    assert!(said.contains("1/1 apart independent: 4 steps"), "{said}");
    let (quiet, nothing) = simulate("quiet", &["--quiet"]);
    assert_eq!((quiet.replace("quiet", "said"), nothing.as_str()), (result.clone(), ""));
    let (verbose, more) = simulate("verbose", &["-v"]);
    assert_eq!(verbose.replace("verbose", "said"), result);
    assert!(
        more.starts_with("seed 1: engine world, phase minds, foresight coarse, 10 particles, 20 simulations"),
        "{more}"
    );
    let output = run(path, &["--quiet", "verify", "nowhere"]);
    assert!(text(&output.stderr).starts_with("error: nowhere: holds no manifest.json"));
}

#[test]
fn verbose_names_the_causes_of_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let preset = ["gen-dataset", "--preset", "missing.json"];
    let plain = text(&run(folder.path(), &preset).stderr);
    let verbose = text(&run(folder.path(), &[&preset[..], &["--verbose"]].concat()).stderr);
    assert_eq!(plain.lines().count(), 1, "{plain}");
    assert!(verbose.starts_with(&plain), "{verbose}");
}

#[test]
fn no_color_means_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let help = |variables: &[(&str, &str)]| {
        let mut command = phase(folder.path());
        command.env_remove("NO_COLOR").env_remove("CLICOLOR").arg("--help").envs(variables.iter().copied());
        text(&command.output().expect("the program starts").stdout)
    };
    assert!(help(&[("CLICOLOR_FORCE", "1")]).contains('\u{1b}'), "colours can be had without a terminal");
    assert!(!help(&[("NO_COLOR", "1")]).contains('\u{1b}'));
    assert!(!help(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]).contains('\u{1b}'));
}
