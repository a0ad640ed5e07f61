//! The posterior that SIMPLE infers from a simulated event is pinned bit for bit.

use phase_event::{Event, ObservedEvent};
use phase_golden::{Digest, Golden};
use phase_model::{
    Body, EventKind, MAX_ENTITIES,
    arena::SUBSTEPS,
    random::{Purpose, stream},
};
use phase_simple::{InferenceSettings, StrengthRegressor, explain};

/// Seed of the scene, of the event and of the inference.
const SEED: u64 = 2021;

/// The part of an event that a viewer sees: the initial bodies, then the mean over the substeps of each step.
fn observed(event: &Event) -> ObservedEvent {
    let mean = |bodies: [[Body; MAX_ENTITIES]; SUBSTEPS], k: usize| {
        let mut mean = Body::default();
        for substep in bodies {
            mean.position += substep[k].position / SUBSTEPS as f32;
            mean.velocity += substep[k].velocity / SUBSTEPS as f32;
            mean.angle += substep[k].angle / SUBSTEPS as f32;
        }
        mean
    };
    let rows = event.steps.iter().map(|step| {
        let bodies = step.substeps.map(|state| state.bodies);
        core::array::from_fn(|k| mean(bodies, k))
    });
    let rows = core::iter::once(event.initial.bodies).chain(rows).collect();
    let scene = &event.scene;
    let objects = scene.objects.iter().map(|object| object.size).collect();
    ObservedEvent::new(scene.layout, scene.agents.map(|agent| agent.size), objects, rows)
        .expect("a simulated event can be observed")
}

#[test]
fn golden_posterior_is_unchanged() -> Result<(), String> {
    let mut settings = phase_sim::SimulationSettings::default();
    settings.minds = settings.minds.with_simulations(50);
    let mut random = stream(SEED, Purpose::Scene, EventKind::Hindering as u64);
    let scene = phase_sampler::sample_kind(EventKind::Hindering, &mut random).expect("a scene");
    let event = phase_sim::simulate(&scene, SEED, &settings).map_err(|error| error.to_string())?;
    let strengths = StrengthRegressor::bundled().map_err(|error| error.to_string())?;
    let inference = explain(&observed(&event), &strengths, SEED, &InferenceSettings::default())
        .map_err(|error| error.to_string())?;

    let mut golden = Golden::new(env!("CARGO_MANIFEST_DIR"), "posterior");
    let mut digest = Digest::new();
    for (hypothesis, weight) in &inference.posterior.hypotheses {
        for goal in hypothesis.goals {
            // The goal in the notation of the file formats.
            digest.text(&serde_json::to_string(&goal).map_err(|error| error.to_string())?);
        }
        for attitude in hypothesis.attitudes {
            digest.integer((attitude.alpha() + 1) as u64);
        }
        for strength in hypothesis.strengths {
            digest.integer(u64::from(strength.level()));
        }
        digest.double(*weight);
    }
    golden.add("hypotheses", inference.posterior.hypotheses.len().to_string());
    golden.add("posterior", digest.hex());
    golden.check()
}
