//! The measurements, as tables.

use super::{GAIN, Kind, energy_gains, meetings, overlaps, rebuilt};
use crate::scenes::Start;
use core::{fmt::Write as _, ops::Range};

/// Engines whose overlaps are measured.
const KINDS: [Kind; 3] = [Kind::World, Kind::Kernel, Kind::KernelWithCache];
/// An engine whose energies are measured beside: with a thousand sweeps the world's solver has converged
/// where it ever does.
const CONVERGED: Kind = Kind::WorldWithPasses(1000);

/// Measures everything in scenes `seeds` of each kind. What comes next is announced.
#[must_use]
pub fn report(seeds: Range<u64>, mut announce: impl FnMut(String)) -> String {
    let seeds = || seeds.clone();
    let mut text = format!(
        "Gains of energy above {GAIN} J in scenes in which agents do no work: substeps, and the largest gain (J).\n\n\
         | start | engine | substeps in motion | holding | separating | otherwise |\n|---|---|---|---|---|---|\n"
    );
    for begins in Start::ALL {
        for kind in [KINDS[0], CONVERGED, KINDS[1], KINDS[2]] {
            announce(format!("energy of {}: {}", kind.name(), begins.name()));
            let gains = energy_gains(kind, begins, seeds());
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} (≤ {:.2}) | {} (≤ {:.2}) | {} (≤ {:.3}) |",
                begins.name(),
                kind.name(),
                gains.substeps,
                gains.holding,
                gains.most_holding,
                gains.separating,
                gains.most_separating,
                gains.free,
                gains.most_free,
            );
        }
    }
    text += "\nOverlaps of two bodies of which none holds the other, after the first step.\n\n\
         | start | engine | substeps | deeper than r/10 | those without held objects, above 0.12 u | deepest (u) | longest (substeps) | beyond way (u) |\n\
         |---|---|---|---|---|---|---|---|\n";
    for begins in Start::ALL {
        for kind in KINDS {
            announce(format!("overlaps of {}: {}", kind.name(), begins.name()));
            let found = overlaps(kind, begins, seeds());
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {:.3} | {} | {:.3} |",
                begins.name(),
                kind.name(),
                found.substeps,
                found.deep,
                found.deep_and_free,
                found.deepest,
                found.longest,
                found.beyond,
            );
        }
    }
    announce("worlds rebuilt from their states".into());
    let found = rebuilt(seeds());
    let _ = writeln!(
        text,
        "\nWorlds rebuilt before each of {} steps: {} steps differ in some bit, {} of them before anything was released, there by {} u;\n\
         after a release by at most {:.4} u. Of copies of the world {} differ.",
        found.steps,
        found.differ,
        found.differ_unreleased,
        quantiles(found.apart),
        found.most_released,
        found.copies_differ,
    );
    announce("meetings of two agents".into());
    let found = meetings(seeds());
    let _ = writeln!(
        text,
        "\n{} meetings of two agents, position errors (u), median / p90 / p99 / maximum:\n\n| steps | error |\n|---|---|",
        found.count
    );
    for (name, errors) in [
        ("world, before the first contact", found.before),
        ("world, the step of the first contact", found.contact),
        ("world, the next three", found.soon),
        ("world, later", found.later),
        ("world, all", found.all),
        ("world, one step of touching agents from the kernel's state", found.one_step),
        ("kernel whose start is moved by 0.00001 u, all", found.disturbed),
        ("kernel whose start is moved by 0.003 u, all", found.disturbed_as_world),
    ] {
        let _ = writeln!(text, "| {name} | {} |", quantiles(errors));
    }
    text.truncate(text.trim_end().len());
    text
}

fn quantiles(errors: Option<[f32; 4]>) -> String {
    errors.map_or("–".into(), |[a, b, c, d]| format!("{a:.6} / {b:.5} / {c:.4} / {d:.3}"))
}
