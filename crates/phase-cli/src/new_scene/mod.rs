//! `new-scene`: a scene to start from, in a file with comments.
//!
//! JSON has no comments; the reader of `phase-events/1` ignores members whose names begin with `_`, so they
//! are in one named `_comment`.

pub mod options;
mod text;

use crate::{context::Context, error::CliError};
use options::NewScene;
use phase_files::{atomic, told};
use phase_model::{Awareness, Layout, Scene, layout::USED_BASES, random};
use phase_sampler::{Request, Starts, Variant, sample};
use serde_json::json;

/// Runs the command.
///
/// # Errors
/// [`CliError::Usage`] if the file exists, [`CliError::NoScene`] if no scene of the kind fits the layout,
/// [`CliError::Output`] if it cannot be written, [`CliError::Serialise`].
pub fn run(arguments: &NewScene, context: &Context) -> Result<(), CliError> {
    let out = &arguments.out;
    let kind = arguments.kind;
    if out.exists() {
        return Err(CliError::Usage(format!("--out: {} exists; choose another file", out.display())));
    }
    let mut scene = scene(arguments)?;
    if let Some(level) = arguments.level {
        scene.agents.iter_mut().for_each(|agent| agent.awareness = Awareness::ignorant(level));
    }
    let file = text::file(kind.name(), &scene, context.program.name)?;
    atomic::write(out, file.as_bytes()).map_err(CliError::Output)?;
    // Sets and selected presets are tested; one scene is not.
    context.note(format!(
        "note: the scene is drawn, not tested: its event may not show {}; other seeds give other scenes",
        kind.name()
    ));
    let next =
        format!("{} simulate --events {} --out out/{}", context.program.name, out.display(), kind.name());
    let value = json!({
        "file": told(out), "id": kind.name(), "kind": kind, "layout": scene.layout, "seed": arguments.seed,
    });
    let name = kind.name();
    let a = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    arguments
        .output
        .print(format!("{} holds {a} {name} scene; simulate it with\n{next}", out.display()), &value)
}

/// A scene of the kind, in the layout if one is given. The variants of the kind are tried in an order that
/// the seed decides.
fn scene(arguments: &NewScene) -> Result<Scene, CliError> {
    let bases = arguments.layout.map_or_else(|| USED_BASES.to_vec(), |base| vec![base]);
    let layouts: Vec<Layout> = bases.into_iter().filter_map(|base| Layout::new(base, None).ok()).collect();
    let variants = Variant::of(arguments.kind);
    let mut failure = None;
    for k in 0..variants.len() {
        let variant = variants[(arguments.seed as usize + k) % variants.len()];
        let goal_index = arguments.seed as usize % variant.goal_count();
        let mut random = random::stream(arguments.seed, random::Purpose::Scene, k as u64);
        match sample(&Request { variant, goal_index, layouts: &layouts, starts: Starts::Near }, &mut random) {
            Ok(scene) => return Ok(scene),
            Err(error) => failure = failure.or(Some(error)),
        }
    }
    let kind = arguments.kind;
    let layout = arguments.layout.unwrap_or_default();
    Err(failure.map_or_else(
        || CliError::Usage(format!("--kind {}: has no variants", kind.name())),
        |source| CliError::NoScene { layout, kind, source },
    ))
}
