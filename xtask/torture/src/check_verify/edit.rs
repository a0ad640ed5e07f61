//! Random changes of bytes and of JSON.

use phase_model::{Action, random::Pcg64Mcg};
use rand::{
    RngExt,
    seq::{IndexedRandom, IteratorRandom},
};
use serde_json::{Number, Value};

/// Changes some byte.
pub(super) fn flip(bytes: &mut [u8], random: &mut Pcg64Mcg) -> bool {
    let Some(byte) = bytes.iter_mut().choose(random) else { return false };
    *byte ^= 1 << random.random_range(0..8);
    true
}

/// Puts bytes without a meaning at the begin, at the end or somewhere within.
pub(super) fn insert(bytes: &mut Vec<u8>, random: &mut Pcg64Mcg) {
    let stray: &[u8] =
        [&b" "[..], b"\n", b"\0", b"PHASE", b"\xff\xd8\xff"].choose(random).copied().unwrap_or(b" ");
    let place = *[0, bytes.len(), random.random_range(0..=bytes.len())].choose(random).unwrap_or(&0);
    bytes.splice(place..place, stray.iter().copied());
}

/// Inserts white space after a bracket, a comma or a colon, where JSON admits it.
pub(super) fn space(text: &mut String, random: &mut Pcg64Mcg) -> bool {
    let Some(place) = text.rmatch_indices(['[', '{', ',', ':']).map(|(at, _)| at + 1).choose(random) else {
        return false;
    };
    text.insert(place, ' ');
    true
}

/// Changes one number, text or truth value somewhere in a value, or drops an element of a list. Texts become
/// others of the same value, so that they keep a meaning.
pub(super) fn alter(value: &mut Value, random: &mut Pcg64Mcg) -> bool {
    let mut texts = Vec::new();
    collect(value, &mut texts);
    texts.extend(Action::ALL.map(|action| action.name().to_owned()));
    let leaves = count(value);
    if leaves == 0 {
        return false;
    }
    let mut left = random.random_range(0..leaves);
    alter_at(value, &mut left, &texts, random)
}

fn collect(value: &Value, texts: &mut Vec<String>) {
    match value {
        Value::String(text) => texts.push(text.clone()),
        Value::Array(items) => items.iter().for_each(|item| collect(item, texts)),
        Value::Object(members) => members.values().for_each(|item| collect(item, texts)),
        _ => {}
    }
}

fn count(value: &Value) -> usize {
    match value {
        Value::Array(items) => items.iter().map(count).sum(),
        Value::Object(members) => members.values().map(count).sum(),
        _ => 1,
    }
}

fn alter_at(value: &mut Value, left: &mut usize, texts: &[String], random: &mut Pcg64Mcg) -> bool {
    let children: Vec<&mut Value> = match value {
        Value::Array(items) => items.iter_mut().collect(),
        Value::Object(members) => members.values_mut().collect(),
        leaf => {
            if *left > 0 {
                *left -= 1;
                return false;
            }
            *leaf = altered(leaf, texts, random);
            return true;
        }
    };
    children.into_iter().any(|child| {
        let here = count(child);
        if *left >= here {
            *left -= here;
            return false;
        }
        alter_at(child, left, texts, random)
    })
}

fn altered(leaf: &Value, texts: &[String], random: &mut Pcg64Mcg) -> Value {
    match leaf {
        Value::Bool(truth) => Value::Bool(!truth),
        Value::Null => Value::from(random.random_range(0..3)),
        Value::String(text) => {
            let other = texts.iter().filter(|other| *other != text).choose(random);
            Value::from(other.cloned().unwrap_or_else(|| format!("{text}x")))
        }
        Value::Number(number) => Value::Number(nudged(number, random)),
        other => other.clone(),
    }
}

/// A number near by: whole ones a step away, others by as little as their last digit or by a hundredth.
fn nudged(number: &Number, random: &mut Pcg64Mcg) -> Number {
    if let Some(whole) = number.as_i64() {
        return Number::from(if random.random_bool(0.5) {
            whole.wrapping_add(1)
        } else {
            whole.wrapping_sub(1)
        });
    }
    if let Some(whole) = number.as_u64() {
        return Number::from(whole - 1);
    }
    let value: f64 = number.as_f64().unwrap_or_default();
    let single = value as f32;
    let near = if single.is_finite() && random.random_bool(0.5) {
        f64::from(f32::from_bits(single.to_bits() ^ 1))
    } else {
        (value * 1.01 * 1e4).round() / 1e4 + 1e-4
    };
    Number::from_f64(near).unwrap_or_else(|| number.clone())
}

/// Changes something in a member of an event, in the text of its file, which has a line for each member.
pub(super) fn alter_member(text: &str, member: &str, random: &mut Pcg64Mcg) -> Option<String> {
    let begin = format!("\"{member}\":");
    let line = text.lines().find(|line| line.trim_start_matches('{').starts_with(&begin))?;
    let content = line.trim_start_matches('{').strip_prefix(&begin)?;
    let content = content.strip_suffix(',').unwrap_or(content);
    let content =
        if serde_json::from_str::<Value>(content).is_ok() { content } else { content.strip_suffix('}')? };
    let mut value: Value = serde_json::from_str(content).ok()?;
    alter(&mut value, random).then(|| text.replacen(content, &value.to_string(), 1))
}

#[cfg(test)]
mod tests {
    use super::{alter, alter_member, count, flip, insert, space};
    use phase_model::random::{Pcg64Mcg, Purpose, stream};
    use serde_json::{Value, json};

    /// Repeats a check a thousand times, each time with an independent random stream.
    fn often(mut something: impl FnMut(&mut Pcg64Mcg)) {
        (0..1000).for_each(|number| something(&mut stream(1, Purpose::Event, number)));
    }

    /// Leaves of two values of one shape that differ; `None` if the shapes do.
    fn differing(a: &Value, b: &Value) -> Option<usize> {
        match (a, b) {
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                a.iter().zip(b).map(|(a, b)| differing(a, b)).sum()
            }
            (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
                a.values().zip(b.values()).map(|(a, b)| differing(a, b)).sum()
            }
            (Value::Array(_) | Value::Object(_), _) | (_, Value::Array(_) | Value::Object(_)) => None,
            _ => Some(usize::from(a != b)),
        }
    }

    #[test]
    fn one_bit_is_flipped() {
        often(|random| {
            let before = b"an event".to_vec();
            let mut after = before.clone();
            assert!(flip(&mut after, random));
            let bits = before.iter().zip(&after).map(|(a, b)| (a ^ b).count_ones()).sum::<u32>();
            assert_eq!(bits, 1);
        });
        assert!(!flip(&mut [], &mut stream(1, Purpose::Event, 0)), "nothing is there");
    }

    #[test]
    fn stray_bytes_leave_the_others_in_order() {
        often(|random| {
            let before = b"an event".to_vec();
            let mut after = before.clone();
            insert(&mut after, random);
            let added = after.len() - before.len();
            assert!((1..=5).contains(&added));
            let cut = |at: usize| [&after[..at], &after[at + added..]].concat();
            assert!((0..=before.len()).any(|at| cut(at) == before), "{after:?}");
        });
    }

    #[test]
    fn one_leaf_becomes_another() {
        let value = json!({
            "a": [0, -7, u64::MAX, 0.25, 1.0e-9, 1e300],
            "b": {"c": "up", "d": null}, "e": true, "f": [[], {}],
        });
        assert_eq!(count(&value), 9);
        let mut met = std::collections::BTreeSet::new();
        often(|random| {
            let mut changed = value.clone();
            assert!(alter(&mut changed, random));
            assert_eq!(differing(&value, &changed), Some(1), "{changed}");
            met.extend((0..6).filter(|&k| changed["a"][k] != value["a"][k]).map(|k| k.to_string()));
            met.extend(
                ["b", "e"].into_iter().filter(|name| changed[*name] != value[*name]).map(String::from),
            );
        });
        assert_eq!(met.len(), 8, "every leaf has its turn: {met:?}");
        assert!(!alter(&mut json!([{}, []]), &mut stream(1, Purpose::Event, 0)), "there is no leaf");
    }

    #[test]
    fn white_space_changes_nothing_that_is_read() {
        let before = json!({"format": "f", "rows": [[1.5, 2], []], "id": "a"});
        often(|random| {
            let mut text = before.to_string();
            assert!(space(&mut text, random));
            assert_eq!(text.len(), before.to_string().len() + 1);
            assert_eq!(serde_json::from_str::<Value>(&text).expect("JSON"), before, "{text}");
        });
    }

    #[test]
    fn one_member_is_changed_and_the_others_stay() {
        let text = "{\"format\":\"f\",\n\"seed\":7,\n\"rows\":[1,2,3]}\n";
        let before: Value = serde_json::from_str(text).expect("JSON");
        often(|random| {
            for member in ["seed", "rows"] {
                let changed = alter_member(text, member, random).expect("it is there");
                let after: Value = serde_json::from_str(&changed).expect("JSON");
                assert_eq!(differing(&before, &after), Some(1), "{changed}");
                assert_ne!(before[member], after[member], "{changed}");
            }
            assert_eq!(alter_member(text, "nobody", random), None);
        });
    }
}
