//! The true PHASE world: a scene simulated by rapier2d, stepped by actions.
