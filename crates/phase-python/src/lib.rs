//! The native part of the Python package `phase_events`, the module `phase_events._native`.
//!
//! It hands numbers over as numpy arrays and everything else as JSON, in the formats of
//! `docs/reference/formats/overview.md`, so that Python and files have one vocabulary. What users see, with
//! types, units and errors, is documented in the package, `python/phase_events`.
//!
//! Key design decision: an agent's observation is one vector of fixed length ([`phase_sim::vector`]).
//! Learners, vector environments and PHASE's own minds read the same vector, and nothing is lost in it: two
//! minds that play in an environment make the event that [`phase_sim::simulate`] makes. The trade-off is a
//! longer vector than most learners need.
//!
//! The interpreter's lock is released in every call that computes. Everything can be copied and pickled: what
//! changes keeps its past and repeats it (`world`, `mind`, `observer`).

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod arrays;
mod command;
mod drawing;
mod error;
mod event;
mod mind;
mod observed;
mod observer;
mod perceive;
mod pools;
mod saved;
mod scene;
mod world;
mod worlds;

use phase_model::setting::{EVENT_STEPS, EVENTS, THREADS};
use phase_sim::{Engine, vector};
use pyo3::prelude::*;

/// The native part of `phase_events`.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("PhaseError", py.get_type::<error::PhaseError>())?;
    module.add("OBSERVATION_SIZE", vector::SIZE)?;
    module.add("MOST_STEPS", EVENT_STEPS.most())?;
    module.add("MOST_THREADS", THREADS.most())?;
    module.add("MOST_EVENTS", EVENTS.most())?;
    module.add("OBSERVATION_PARTS", observation_parts())?;
    module.add("ACTIONS", scene::action_names())?;
    module.add("ENGINES", Engine::ALL.map(Engine::name))?;
    module.add("GOALS", scene::goals_as_json()?)?;
    module.add("LANDMARKS", observed::landmarks(py)?)?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<worlds::Worlds>()?;
    module.add_class::<saved::WorldState>()?;
    module.add_class::<mind::Mind>()?;
    module.add_class::<event::Event>()?;
    module.add_class::<event::EventSource>()?;
    module.add_class::<observed::Observed>()?;
    module.add_class::<observer::PythonObserver>()?;
    module.add_class::<drawing::Renderer>()?;
    module.add("VERSION", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(mind::decide_all, module)?)?;
    module.add_function(wrap_pyfunction!(event::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(scene::goal_index, module)?)?;
    module.add_function(wrap_pyfunction!(perceive::infer, module)?)?;
    module.add_function(wrap_pyfunction!(perceive::forecast, module)?)?;
    module.add_function(wrap_pyfunction!(perceive::compare_results, module)?)?;
    module.add_function(wrap_pyfunction!(perceive::methods, module)?)?;
    module.add_function(wrap_pyfunction!(command::run, module)?)?;
    module.add_function(wrap_pyfunction!(command::submit, module)?)?;
    module.add_function(wrap_pyfunction!(event::write_text, module)?)?;
    Ok(())
}

/// Name and shape of each part of an observation, in order.
fn observation_parts() -> Vec<(&'static str, Vec<usize>)> {
    vector::PARTS.iter().map(|part| (part.name, part.shape.to_vec())).collect()
}
