//! Numbers for all pairs of shapes that can touch, in the order in which the original makes their contacts.

use crate::wall::{MAX_WALLS, WallSet};

/// Number of keys: each wall with each body, and each body with each later body.
pub(crate) const KEYS: usize = 4 * MAX_WALLS + 6;

/// The six pairs of bodies, by key past the walls'.
pub(crate) const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// A set of bodies, one bit each.
pub(crate) type BodyMask = u8;

/// A set of keys, one bit each.
pub(crate) type KeySet = u64;

/// The key of a wall and a body.
pub(crate) const fn wall_key(wall: usize, body: usize) -> usize {
    4 * wall + body
}

/// The key of the pair of bodies with this number.
pub(crate) const fn pair_key(pair: usize) -> usize {
    4 * MAX_WALLS + pair
}

/// All keys of walls with bodies.
pub(crate) const WALL_KEYS: KeySet = bit(pair_key(0)) - 1;

/// The set of one key.
pub(crate) const fn bit(key: usize) -> KeySet {
    1 << key
}

/// The pair number of an agent and an object (as bodies 2 and 3).
pub(crate) const fn pair_of(agent: usize, object: usize) -> usize {
    2 * agent + object - 1
}

/// The keys of a set from the highest to the lowest: newest contact first.
pub(crate) fn descending(mut set: KeySet) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let key = set.checked_ilog2()? as usize;
        set &= !bit(key);
        Some(key)
    })
}

/// The keys of some walls with a body.
#[inline]
pub(crate) fn wall_keys(mut walls: WallSet, body: usize) -> KeySet {
    let mut keys = 0;
    while walls != 0 {
        keys |= bit(wall_key(walls.trailing_zeros() as usize, body));
        walls &= walls - 1;
    }
    keys
}

/// The bodies that belong to some pairs.
pub(crate) fn bodies_of(pairs: KeySet) -> BodyMask {
    let mut bodies = 0;
    if pairs != 0 {
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            if pairs & bit(pair_key(pair)) != 0 {
                bodies |= 1 << a | 1 << b;
            }
        }
    }
    bodies
}
