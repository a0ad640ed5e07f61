//! The `README.md` inside a generated dataset.

use crate::{manifest::Manifest, words};
use phase_model::EventKind;

/// The dataset's file for people: what it is, how it was made, what is in it, and its licence.
#[must_use]
pub fn card(manifest: &Manifest, command: &str) -> String {
    let mut kinds = String::new();
    for kind in EventKind::ALL {
        let events: Vec<_> = manifest.events.iter().filter(|event| event.kind == kind).collect();
        if !events.is_empty() {
            let (name, what) = (kind.name(), words::kind(kind));
            kinds.push_str(&format!("| {name} | {} | {what} |\n", events.len()));
        }
    }
    format!(
        "# {preset}: {count} PHASE events\n\n\
         Physically grounded social events: two agents see, believe, plan and act in a physical world, and what \
         they want of each other shows in how they move.\n\n\
         Made by {generator} with\n\n```sh\n{command}\n```\n\n\
         The same command makes the same files, byte for byte, on the same platform.\n\n\
         | kind | events | what it is meant to show |\n|---|---|---|\n{kinds}\n\
         | file | what it is |\n|---|---|\n\
         | `index.html` | opens in a browser, offline, and shows every video with its labels |\n\
         | `events/<id>.json` | format `phase-events/1`: scene, labels, trajectory, actions, subgoals, substeps |\n\
         | `videos/<id>.mp4` | H.264, 20 frames a second, five frames a step |\n\
         | `manifest.json` | format `phase-dataset/1`: settings, seeds, and the checksum of every file |\n\n\
         Labels say what a scene was set up for; whether the event shows it is not judged.\n\n\
         Licence: MIT OR Apache-2.0, as the program's.\n",
        preset = manifest.preset,
        count = manifest.events.len(),
        generator = manifest.generator,
    )
}
