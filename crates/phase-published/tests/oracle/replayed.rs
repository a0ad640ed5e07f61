//! Decisions of our minds at the recorded states.

use crate::recorded::{Recorded, recordings};
use phase_forward::OriginalWorld;
use phase_model::{
    AGENT_COUNT, Action, AgentId, EventKind, State,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_published::{Belief, Mind, PublishedParameters, RandomNumbers, senses::observe};
use std::{
    num::NonZero,
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

/// Both sources of random numbers.
const RANDOM: [RandomNumbers; 2] = [RandomNumbers::Original, RandomNumbers::Seeded];

/// Both agents of a recording under the truth.
struct Agents {
    minds: [Mind; AGENT_COUNT],
    beliefs: [Belief; AGENT_COUNT],
    /// Random numbers of beliefs and of searches.
    random: [[Pcg64Mcg; AGENT_COUNT]; 2],
}

impl Agents {
    fn new(recording: &Recorded, random: RandomNumbers, state: &State) -> Self {
        let parameters = PublishedParameters {
            older_actions: recording.kind == EventKind::Hindering,
            strongest_coasts: true,
            random,
            ..PublishedParameters::default()
        };
        let Recorded { scene, .. } = recording;
        let physics = scene.physics();
        let streams = |purpose| AgentId::ALL.map(|agent| stream(1, purpose, agent.number().into()));
        let [mut of_beliefs, of_searches] = [Purpose::Belief, Purpose::Search].map(streams);
        let beliefs = AgentId::ALL.map(|agent| {
            let seen = observe(&physics, state, agent);
            let random = &mut of_beliefs[agent.index()];
            Belief::new(scene.layout, &physics, &parameters, &seen, Some(state), random)
        });
        let minds = AgentId::ALL.map(|agent| Mind::new(scene, agent, parameters).expect("a mind"));
        Self { minds, beliefs, random: [of_beliefs, of_searches] }
    }

    fn decide(&mut self) -> [Action; AGENT_COUNT] {
        let mut position = 0;
        [0, 1].map(|k| {
            self.minds[k].begin_at(position);
            let particles = self.beliefs[k].particles();
            let (action, _) = self.minds[k].decide(particles, &mut self.random[1][k]).expect("a decision");
            position = self.minds[k].stream_position();
            action
        })
    }

    fn perceive(&mut self, actions: [Action; AGENT_COUNT], substeps: &[State]) {
        for (k, belief) in self.beliefs.iter_mut().enumerate() {
            let seen = belief.observe(&substeps[substeps.len() - 1]);
            belief.update(actions[k], &seen, substeps, &mut self.random[0][k]);
        }
    }

    /// Whether nothing is left to chance in the decision of an agent: it and those before it know the state.
    fn is_certain(&self, agent: usize) -> bool {
        let knows = |it: &Belief| it.particles().iter().all(|particle| *particle == it.particles()[0]);
        self.beliefs[..=agent].iter().all(knows)
    }
}

/// Decisions that have the effect of the recorded ones.
#[derive(Clone, Copy, Default)]
struct Same {
    same: usize,
    all: usize,
}

impl Same {
    fn add(&mut self, same: bool) {
        self.same += usize::from(same);
        self.all += 1;
    }

    fn plus(self, other: Self) -> Self {
        Self { same: self.same + other.same, all: self.all + other.all }
    }

    fn share(self) -> f64 {
        self.same as f64 / self.all as f64
    }
}

impl core::fmt::Display for Same {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} of {}", self.same, self.all)
    }
}

/// Numbers of decisions at recorded states that have the recorded effect: all, and those in which
/// nothing is left to chance.
fn decisions(recording: &Recorded, random: RandomNumbers) -> [Same; 2] {
    /// Rounding of rows (u).
    const ROUNDING: f32 = 1e-5;
    let mut world = recording.world();
    let mut agents = Agents::new(recording, random, world.state());
    let mut counts = [Same::default(); 2];
    for (t, &actions) in recording.actions.iter().enumerate() {
        let ours = agents.decide();
        let after = |world: &OriginalWorld, actions| {
            let mut world = world.clone();
            (world.step(recording.carried_out(actions)), world)
        };
        let (substeps, known) = after(&world, actions);
        // Two that press against each other move as little as two that rest.
        let together = recording.error(&after(&world, ours).0, t) <= recording.error(&substeps, t) + ROUNDING;
        for (k, &own) in ours.iter().enumerate() {
            let mut one = actions;
            one[k] = own;
            let is_same = together || after(&world, one).1.state() == known.state();
            counts[0].add(is_same);
            if agents.is_certain(k) {
                counts[1].add(is_same);
            }
        }
        world = known;
        agents.perceive(actions, &substeps);
    }
    counts
}

#[test]
fn decisions_are_those_recorded() {
    let Some(recordings) = recordings() else { return };
    let mut sum = Same::default();
    for recording in recordings.iter().filter(|it| ["004", "008", "010"].contains(&&it.id[11..])) {
        let [all, _] = decisions(recording, RandomNumbers::Original);
        sum = sum.plus(all);
    }
    println!("decisions as recorded: {sum}");
    assert!(sum.share() > 0.9);
}

/// Takes 20 minutes of CPU time on all cores:
/// `cargo test -p phase-published --test oracle all_decisions -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn all_decisions_are_those_recorded() {
    let Some(recordings) = recordings() else { return };
    let next = AtomicUsize::new(0);
    let work = || {
        let mut counted = Vec::new();
        while let Some(recording) = recordings.get(next.fetch_add(1, Ordering::Relaxed)) {
            let counts = RANDOM.map(|random| decisions(recording, random));
            let [original, seeded] = counts.map(|[all, certain]| format!("{all}, certain: {certain}"));
            println!("{} {}; original: {original}; seeded: {seeded}", recording.id, recording.kind.name());
            counted.push((usize::from(recording.kind == EventKind::Hindering), counts));
        }
        counted
    };
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let counted: Vec<_> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a count")).collect()
    });
    // By source of random numbers, and by whether there were the older actions.
    let mut sums = [[[Same::default(); 2]; 2]; 2];
    for (older, counts) in counted {
        for (sums, counts) in sums.iter_mut().zip(counts) {
            sums[older] = [0, 1].map(|k| sums[older][k].plus(counts[k]));
        }
    }
    for (random, sums) in RANDOM.into_iter().zip(&sums) {
        for (name, [all, certain]) in ["from the 28th of August on", "hindering"].into_iter().zip(sums) {
            println!("{random:?}, {name}: {all}, certain: {certain}");
        }
    }
    assert!(sums[0][0][0].share() > 0.8);
}
