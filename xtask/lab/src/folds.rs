//! The division of events into folds.

use phase_files::checksum::sha256;
use phase_model::EventKind;

/// The fold of each event, from 0. Every kind is spread evenly over the folds, whose sizes differ by at most
/// one; which events share a fold follows from their ids and the seed, not from their order.
pub(crate) fn assign(events: &[(&str, EventKind)], folds: usize, seed: u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..events.len()).collect();
    let place = |&k: &usize| {
        let (id, kind) = events[k];
        (kind, sha256(format!("{seed} {id}").as_bytes()), k)
    };
    order.sort_by_cached_key(place);
    let mut fold_of = vec![0; events.len()];
    for (place, &event) in order.iter().enumerate() {
        fold_of[event] = place % folds;
    }
    fold_of
}

#[cfg(test)]
mod tests {
    use super::assign;
    use phase_model::EventKind;

    #[test]
    fn folds_partition_the_events_evenly_and_by_kind() {
        let ids: Vec<String> = (0..23).map(|k| format!("event-{k}")).collect();
        let events: Vec<(&str, EventKind)> =
            ids.iter().enumerate().map(|(k, id)| (id.as_str(), EventKind::ALL[k % 3])).collect();
        let folds = assign(&events, 5, 1);
        let sizes = |kind: Option<EventKind>| -> Vec<usize> {
            let counted = |k: &usize| kind.is_none_or(|kind| events[*k].1 == kind);
            (0..5).map(|fold| (0..23).filter(counted).filter(|&k| folds[k] == fold).count()).collect()
        };
        assert_eq!(sizes(None).iter().sum::<usize>(), 23, "each event has a fold");
        for kind in [None, Some(EventKind::ALL[0]), Some(EventKind::ALL[1]), Some(EventKind::ALL[2])] {
            let sizes = sizes(kind);
            let least = sizes.iter().min();
            let most = sizes.iter().max();
            assert!(most.zip(least).is_some_and(|(most, least)| most - least <= 1), "{sizes:?}");
        }
        assert_ne!(folds, assign(&events, 5, 2));
    }

    #[test]
    fn the_order_of_the_events_does_not_matter() {
        let kind = EventKind::ALL[0];
        let events = [("a", kind), ("b", kind), ("c", kind), ("d", kind)];
        let mut reversed = events;
        reversed.reverse();
        let mut folds = assign(&reversed, 2, 1);
        folds.reverse();
        assert_eq!(folds, assign(&events, 2, 1));
    }
}
