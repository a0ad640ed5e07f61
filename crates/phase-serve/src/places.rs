//! Places for guests: a number in all and a number for each address. A new guest gets one; if none is free,
//! the guest that has been silent for longest leaves.

use core::cmp::Reverse;
use std::{
    collections::HashMap,
    net::IpAddr,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};
use tokio::sync::Notify;

/// Places for guests.
#[derive(Debug)]
pub(crate) struct Places {
    most: usize,
    most_of_address: usize,
    guests: Mutex<HashMap<u64, Present>>,
    /// Counts everything that guests do, so that it orders what they did.
    clock: AtomicU64,
}

#[derive(Debug)]
struct Present {
    address: IpAddr,
    used: Arc<AtomicU64>,
    leave: Arc<Notify>,
}

/// Somebody with a place, until this is dropped.
#[derive(Debug)]
pub(crate) struct Guest {
    places: Arc<Places>,
    number: u64,
    used: Arc<AtomicU64>,
    leave: Arc<Notify>,
}

impl Places {
    /// So many places, and so many for one address.
    #[must_use]
    pub(crate) fn new(most: usize, most_of_address: usize) -> Self {
        Self { most, most_of_address, guests: Mutex::default(), clock: AtomicU64::new(0) }
    }

    /// Gives somebody a place. Where its address has no more, one of that address leaves; where there is none
    /// at all, one of the address that has most.
    pub(crate) fn enter(self: &Arc<Self>, address: IpAddr) -> Guest {
        let number = self.tick();
        let (used, leave) = (Arc::new(AtomicU64::new(number)), Arc::new(Notify::new()));
        let mut guests = self.lock();
        let same = guests.values().filter(|guest| guest.address == address).count();
        if same >= self.most_of_address {
            dismiss(&mut guests, |guest| guest.address == address);
        } else if guests.len() >= self.most {
            dismiss(&mut guests, |_| true);
        }
        let present = Present { address, used: Arc::clone(&used), leave: Arc::clone(&leave) };
        guests.insert(number, present);
        drop(guests);
        Guest { places: Arc::clone(self), number, used, leave }
    }

    /// Asks one guest to leave.
    pub(crate) fn make_room(&self) {
        dismiss(&mut self.lock(), |_| true);
    }

    fn tick(&self) -> u64 {
        self.clock.fetch_add(1, Ordering::Relaxed)
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<u64, Present>> {
        self.guests.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Of those that may be, asks the one to leave that has been silent for longest, among those of the address
/// that has most.
fn dismiss(guests: &mut HashMap<u64, Present>, may: impl Fn(&Present) -> bool) {
    let mut counts = HashMap::<IpAddr, usize>::new();
    for guest in guests.values() {
        *counts.entry(guest.address).or_default() += 1;
    }
    let order = |guest: &Present| {
        let count = counts.get(&guest.address).copied().unwrap_or_default();
        (Reverse(count), guest.used.load(Ordering::Relaxed))
    };
    let leaves =
        guests.iter().filter(|(_, guest)| may(guest)).min_by_key(|(_, guest)| order(guest)).map(|(k, _)| *k);
    if let Some(guest) = leaves.and_then(|number| guests.remove(&number)) {
        guest.leave.notify_one();
    }
}

impl Guest {
    /// The guest has done something.
    pub(crate) fn used(&self) {
        self.used.store(self.places.tick(), Ordering::Relaxed);
    }

    /// Waits until its place is needed.
    pub(crate) async fn asked_to_leave(&self) {
        self.leave.notified().await;
    }
}

impl Drop for Guest {
    fn drop(&mut self) {
        self.places.lock().remove(&self.number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::Ipv4Addr;
    use tokio::time::{Duration, timeout};

    fn address(k: u32) -> IpAddr {
        IpAddr::V4(Ipv4Addr::from(k))
    }

    async fn leaves(guest: &Guest) -> bool {
        timeout(Duration::from_millis(1), guest.asked_to_leave()).await.is_ok()
    }

    #[tokio::test]
    async fn the_silent_leave_first_and_those_of_the_crowd() {
        let places = Arc::new(Places::new(4, 3));
        let crowd: Vec<Guest> = (0..3).map(|_| places.enter(address(1))).collect();
        let other = places.enter(address(2));
        crowd[0].used();
        // Its own address is full, and the second of it was silent for longest.
        let fourth = places.enter(address(1));
        assert!(leaves(&crowd[1]).await);
        // All places are taken, most of them by the crowd.
        let third = places.enter(address(3));
        assert!(leaves(&crowd[2]).await);
        for stays in [&crowd[0], &other, &fourth, &third] {
            assert!(!leaves(stays).await);
        }
        // A place that was given up is free.
        drop(other);
        let _fifth = places.enter(address(4));
        assert!(!leaves(&crowd[0]).await && !leaves(&fourth).await && !leaves(&third).await);
    }
}
