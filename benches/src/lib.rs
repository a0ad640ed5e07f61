//! Criterion benches of the PHASE crates; `cargo bench -p phase-benches`.
//!
//! - `physics`: four steps of the reference world and of the forward model in free motion, pushing and
//!   carrying; saving a state (a copy) and restoring one (in the world: a new world in that state).
//! - `random_actions`: one step of the forward model, exact and coarse, on average, over states in mid-event
//!   and uniformly sampled actions. The states come from scenes of every kind, simulated by the reference
//!   world under random held actions; and, if the environment variable `PHASE_EVENTS` names a
//!   `phase-events/1` file, also from the rows of its recordings, each initial state stepped ten times.
//! - `inverse_dynamics`: inverse dynamics of six simulated events and of the recordings in `PHASE_EVENTS`;
//!   goals and futures of some of these recordings, and the rows of an observer that watches them.
//! - `minds`: field of view, observing, belief updates, planning, deciding; deciding and believing with more
//!   or fewer simulations, particles and rollout steps; one event of 100 steps of each kind (the sampler's
//!   first scene of seed 1); and a reference workload.
