//! `draw-behaviour`: scenes for `check-behaviour`, drawn from the sampler without simulating anything.
//!
//! Each part has a recipe: variants of the sampler, and a condition on geometry and forces that says what
//! makes a draw a scene of this part. The first draws that satisfy it are kept, each in another base layout.
//! No agent acts, so what agents are good at does not select the scenes.

mod candidate;
mod conditions;
mod recipes;
mod walk;

use crate::error::LabError;
use candidate::Candidate;
use clap::{Args, value_parser};
use phase_cli::{console::print_message, parallel::Jobs};
use phase_event::{Controller, Recording, Trajectory};
use phase_files::{WriteError, atomic};
use phase_model::{
    AGENT_COUNT, Attitude, Body, Layout, Scene, Vec2,
    layout::USED_BASES,
    random::{Purpose, stream},
};
use phase_runs::{error::RunError, parallel::make_all};
use phase_sampler::{Request, sample};
use recipes::{RECIPES, Recipe};
use std::{fs, path::PathBuf};
use thiserror::Error;

/// Maximum number of draws for one scene.
const MAX_DRAWS: u64 = 50_000;
/// Streams of each recipe: recipe `k` uses those from `k * STREAMS`.
const STREAMS: u64 = 1 << 32;
/// Starts are rounded to this fraction of a unit, so that files are readable (1/u).
const POSITION_GRID: f32 = 100.0;
/// Angles are rounded to this fraction of a radian (1/rad).
const ANGLE_GRID: f32 = 10_000.0;

/// Options of `draw-behaviour`.
#[derive(Args, Debug)]
pub struct DrawBehaviour {
    /// Seed of the draws
    #[arg(long, value_name = "N", default_value_t = 17)]
    pub seed: u64,
    /// Scenes of each part, each in another base layout
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = value_parser!(u8).range(1..=6))]
    pub scenes: u8,
    /// Folder for the files, one for each part; files of the same names are replaced
    #[arg(long, value_name = "DIR", default_value = "out/behaviour-drawn")]
    pub out: PathBuf,
    /// Number of parts at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// No scene of a part was found.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("--seed {seed}: no further scene of {part} was found in {MAX_DRAWS} draws")]
pub struct DrawError {
    /// The seed.
    pub seed: u64,
    /// The part.
    pub part: &'static str,
}

/// Runs the command.
///
/// # Errors
/// [`DrawError`] if a part has no scene, [`RunError`] if a file cannot be written.
pub fn run(arguments: &DrawBehaviour) -> Result<(), LabError> {
    let drawn = make_all(arguments.jobs.threads(), RECIPES.len(), |index| {
        let scenes = draw(index, arguments.seed, usize::from(arguments.scenes));
        if let Ok(scenes) = &scenes {
            let ids: Vec<&str> = scenes.iter().map(|scene| scene.id.as_str()).collect();
            print_message(format!("{}: {}", RECIPES[index].part, ids.join(", ")));
        }
        Ok(Some(scenes))
    })?;
    let Some(drawn) = drawn else { return Err(RunError::Interrupted(arguments.out.clone()).into()) };
    let drawn = drawn.into_iter().collect::<Result<Vec<_>, _>>()?;
    let out = &arguments.out;
    let failed = |source| WriteError { path: out.clone(), action: "create the folder", source };
    fs::create_dir_all(out).map_err(failed).map_err(RunError::Output)?;
    for (recipe, scenes) in RECIPES.iter().zip(&drawn) {
        let text = phase_event::to_json(scenes).map_err(RunError::from)?;
        let file = out.join(format!("{}.json", recipe.part));
        atomic::write(&file, text.as_bytes()).map_err(RunError::Output)?;
    }
    Ok(())
}

/// The scenes of a recipe. Draw `k` has its own random stream, and its number is the end of the scene's id.
fn draw(index: usize, seed: u64, count: usize) -> Result<Vec<Recording>, DrawError> {
    let recipe = &RECIPES[index];
    let mut scenes: Vec<Recording> = Vec::new();
    let mut first = 0;
    let mut number = 0;
    while scenes.len() < count {
        if number - first == MAX_DRAWS {
            return Err(DrawError { seed, part: recipe.part });
        }
        let bases: Vec<u8> = scenes.iter().map(|it| it.scene.layout.base()).collect();
        let drawn = attempt(recipe, scenes.len(), &bases, seed, index as u64 * STREAMS + number);
        number += 1;
        if let Some(scene) = drawn {
            let (variant, _) = recipe.sources[scenes.len() % recipe.sources.len()];
            scenes.push(recording(format!("drawn-{}-{}", variant.name(), number - 1), scene));
            first = number;
        }
    }
    Ok(scenes)
}

/// One draw for the scene of this index, in a base layout that is not taken; `None` if it is not kept.
fn attempt(recipe: &Recipe, index: usize, taken: &[u8], seed: u64, number: u64) -> Option<Scene> {
    let free = USED_BASES.into_iter().filter(|base| !taken.contains(base));
    let layouts: Vec<Layout> = free.filter_map(|base| Layout::new(base, None).ok()).collect();
    let (variant, rewriting) = recipe.sources[index % recipe.sources.len()];
    let goal_index = (number % STREAMS) as usize;
    let request = Request { variant, goal_index, layouts: &layouts };
    let scene = sample(&request, &mut stream(seed, Purpose::Scene, number)).ok()?;
    // The sampler exchanges the agents in half of its scenes; the table's roles are fixed.
    let in_order =
        scene.goals() == variant.goals(goal_index) && scene.agents[1].attitude == Attitude::Neutral;
    if !in_order {
        return None;
    }
    let scene = rounded(rewriting.apply(scene));
    let candidate = Candidate(&scene);
    (candidate.is_sound() && (recipe.condition)(&candidate)).then_some(scene)
}

fn rounded(mut scene: Scene) -> Scene {
    let nearest = |value: f32, grid: f32| (value * grid).round() / grid;
    let round = |body: &mut Body| {
        let Vec2 { x, y } = body.position;
        body.position = Vec2::new(nearest(x, POSITION_GRID), nearest(y, POSITION_GRID));
        body.angle = nearest(body.angle, ANGLE_GRID);
    };
    scene.agents.iter_mut().for_each(|agent| round(&mut agent.start));
    scene.objects.iter_mut().for_each(|object| round(&mut object.start));
    scene
}

/// A recording of the start alone.
fn recording(id: String, scene: Scene) -> Recording {
    let row = |body: &Body| {
        let position = body.position;
        let velocity = body.velocity;
        vec![[position.x, position.y, velocity.x, velocity.y, body.angle]]
    };
    let trajectory = Trajectory {
        agents: scene.agents.map(|agent| row(&agent.start)),
        objects: scene.objects.iter().map(|object| row(&object.start)).collect(),
    };
    Recording {
        id,
        relation: scene.relation(),
        scene,
        relation_human: None,
        row_0: Some("initial state".into()),
        recorded_steps: None,
        controllers: [Controller::Mind; AGENT_COUNT],
        trajectory,
        recovered_actions: None,
        seed: None,
        simulation: None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Candidate, RECIPES, draw};
    use crate::check_behaviour::sets::SceneSet;
    use phase_dataset::phase_events;
    use std::collections::BTreeSet;

    /// The files were drawn with the sampler of their day. Whatever became of it, they satisfy their
    /// conditions.
    #[test]
    fn bundled_scenes_satisfy_the_condition_of_their_part() {
        let folders = SceneSet::Drawn.folders();
        for recipe in &RECIPES {
            let file = folders[0].join(format!("{}.json", recipe.part));
            let recordings = phase_events::read(&file).expect("readable");
            assert_eq!(recordings.len(), 3, "{}", recipe.part);
            let ids: BTreeSet<&str> = recordings.iter().map(|it| it.id.as_str()).collect();
            let bases: BTreeSet<u8> = recordings.iter().map(|it| it.scene.layout.base()).collect();
            assert_eq!((ids.len(), bases.len()), (3, 3), "{}", recipe.part);
            for recording in &recordings {
                let candidate = Candidate(&recording.scene);
                let id = &recording.id;
                assert!(candidate.is_sound(), "{} {id}", recipe.part);
                assert!((recipe.condition)(&candidate), "{} {id}", recipe.part);
                assert_eq!(recording.scene.check_kind(), Ok(()), "{} {id}", recipe.part);
            }
        }
    }

    #[test]
    fn draws_depend_on_the_seed_alone() {
        assert_eq!(draw(0, 3, 2), draw(0, 3, 2));
        assert_ne!(draw(0, 3, 2), draw(0, 4, 2));
    }

    /// In the scenes of part 1 goals are about agents, so that there is nothing to search, carry or take.
    #[test]
    fn conditions_about_objects_need_an_object() {
        let scenes = draw(0, 17, 1).expect("scenes");
        let candidate = Candidate(&scenes[0].scene);
        let about_objects =
            ["02-search", "04-together", "05a-reach", "06b-take", "06c-drag", "06d-hide", "08-compete"];
        for recipe in RECIPES.iter().filter(|recipe| about_objects.contains(&recipe.part)) {
            assert!(!(recipe.condition)(&candidate), "{}", recipe.part);
        }
    }
}
