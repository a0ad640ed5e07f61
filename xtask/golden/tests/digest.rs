//! Digests depend on every bit, and tables report the differences.

use phase_golden::{Digest, fixtures, table::differences};
use phase_model::Vec2;

#[test]
fn digest_is_sha256() {
    // FIPS 180-4: the digest of the empty message.
    let expected = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
    assert_eq!(Digest::new().hex(), expected);
}

#[test]
fn one_bit_changes_a_digest() {
    let (physics, state) = &fixtures::scenes()[1];
    let digest_of = |state| {
        let mut digest = Digest::new();
        digest.state(physics, state);
        digest.hex()
    };
    let mut changed = *state;
    changed.bodies[2].velocity = Vec2::new(-0.0, 0.0);
    assert_ne!(digest_of(state), digest_of(&changed));
    // The scene has one object: the unused slot of the second is not part of the digest.
    let mut absent = *state;
    absent.bodies[3].position = Vec2::ONE;
    assert_eq!(digest_of(state), digest_of(&absent));
}

#[test]
fn bodies_start_apart_and_within_the_arena() {
    for (physics, state) in fixtures::scenes() {
        let entities: Vec<_> = physics.entities().collect();
        for (k, &a) in entities.iter().enumerate() {
            assert!(phase_model::arena::contains(state.position(a)));
            for &b in &entities[k + 1..] {
                assert!(state.position(a).distance(state.position(b)) > 1.2);
            }
        }
    }
}

#[test]
fn tables_name_the_lines_that_differ() {
    assert!(differences("a 1\nb 2\n", "a 1\nb 2\n").is_empty());
    assert_eq!(differences("a 1\nb 2\n", "a 1\nb 3\n"), ["- b 2", "+ b 3"]);
    assert_eq!(differences("a 1\nb 2\n", "b 2\na 1\n").len(), 1);
}
