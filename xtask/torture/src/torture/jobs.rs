//! The commands that are tortured.

/// A command, what it needs, and what it makes. Words of a command are separated by spaces.
pub(super) struct Job {
    pub(super) name: &'static str,
    /// Commands that make its input, run once in the folder that `{in}` stands for.
    pub(super) prepare: &'static [&'static str],
    /// The command. It writes into `out`, in a folder of its own.
    pub(super) command: &'static str,
    /// Files that are the same in every run, but for CPU times in them; all of them if none is named. Others
    /// have measured times.
    pub(super) same: &'static [&'static str],
    /// A file that is there only until the command has finished.
    pub(super) meanwhile: Option<&'static str>,
}

/// Three events that take a moment.
const EVENTS: &str = "gen-dataset --events 3 --simulations 20 --particles 6 --max-steps 4 --out data";
/// A dataset to evaluate, divided as its preset says.
const DIVIDED: &str =
    "gen-dataset --preset divided.json --simulations 8 --particles 4 --max-steps 24 --no-video --out data";
/// One from which a network learns in less than a second.
const SHORT: &str =
    "gen-dataset --preset divided.json --simulations 8 --particles 4 --max-steps 8 --no-video --out data";
/// The preset of these datasets, which is written before.
pub(super) const PRESET: (&str, &str) = (
    "divided.json",
    r#"{"format": "phase-preset/3", "name": "divided", "seed": 1, "layouts": {"all": [0, 4, 8, 12]},
    "groups": [{"variant": "places", "split": "train", "layouts": "all", "events": 3},
               {"variant": "places", "split": "validation", "layouts": "all", "events": 1},
               {"variant": "chase", "split": "test", "layouts": "all", "events": 2}]}"#,
);

pub(super) const JOBS: [Job; 8] = [
    Job {
        name: "gen-dataset",
        prepare: &[],
        command: "gen-dataset --events 3 --simulations 20 --particles 6 --max-steps 4 --jobs 2 --out out",
        same: &[],
        meanwhile: None,
    },
    Job {
        name: "gen-dataset --shard",
        prepare: &[],
        command: "gen-dataset --events 4 --simulations 20 --particles 6 --max-steps 4 --shard 1/2 --out out",
        same: &[],
        meanwhile: None,
    },
    Job {
        name: "merge",
        prepare: &[
            "gen-dataset --events 4 --simulations 20 --particles 6 --max-steps 4 --shard 1/2 --out one",
            "gen-dataset --events 4 --simulations 20 --particles 6 --max-steps 4 --shard 2/2 --out two",
        ],
        command: "merge {in}/one {in}/two --out out",
        same: &[],
        meanwhile: None,
    },
    Job {
        name: "simulate",
        prepare: &["new-scene --kind chasing --out scene.json"],
        command: "simulate --events {in}/scene.json --seeds 3 \
            --simulations 20 --particles 6 --max-steps 4 --out out",
        same: &[],
        meanwhile: None,
    },
    Job {
        name: "export",
        prepare: &[EVENTS],
        command: "export {in}/data --events-per-file 1 --out out",
        same: &[],
        meanwhile: None,
    },
    Job {
        name: "eval",
        prepare: &[DIVIDED],
        command: "eval goals --method cue --events {in}/data --out out",
        same: &["results.json"],
        meanwhile: None,
    },
    Job {
        name: "benchmark",
        prepare: &[DIVIDED],
        command: "benchmark --data {in}/data --methods cue,chance,still \
            --evaluations out/eval --out out/report",
        same: &["report/benchmark.json"],
        meanwhile: None,
    },
    Job {
        name: "train",
        // Any network is written by the same code; this one learns fastest.
        prepare: &[SHORT],
        command: "train socialgnn --data {in}/data --rounds 3 --out out/weights.safetensors",
        same: &["weights.safetensors"],
        meanwhile: Some("weights.safetensors.checkpoint"),
    },
];

#[cfg(test)]
mod tests {
    use super::{JOBS, PRESET};
    use clap::Parser;
    use phase_cli::cli::Cli;
    use phase_dataset::preset::Preset;
    use std::collections::BTreeSet;

    #[test]
    fn the_program_has_every_command_with_its_options() {
        for job in &JOBS {
            for line in job.prepare.iter().chain([&job.command]) {
                let parsed = Cli::try_parse_from(["phase"].into_iter().chain(line.split_whitespace()));
                assert!(parsed.is_ok(), "{}: {}", job.name, parsed.expect_err("an error"));
            }
        }
        let names: BTreeSet<&str> = JOBS.iter().map(|job| job.name).collect();
        assert_eq!(names.len(), JOBS.len(), "names tell commands apart");
        assert!(Preset::parse(PRESET.0, PRESET.1).is_ok());
    }

    #[test]
    fn what_a_command_reads_is_made_before_and_what_it_makes_is_looked_at() {
        for job in &JOBS {
            let read = job.command.split_whitespace().filter_map(|word| word.strip_prefix("{in}/"));
            for name in read {
                let makes = |line: &&str| line.ends_with(&format!("--out {name}"));
                assert!(job.prepare.iter().any(makes), "{}: {name}", job.name);
            }
            let written: Vec<&str> = job.command.split_whitespace().skip_while(|it| *it != "--out").collect();
            assert!(written.get(1).is_some_and(|out| out.starts_with("out")), "{}", job.name);
        }
    }
}
