//! Limits of what an address may do: token buckets for its rate, and how much at the same time.

use std::{
    collections::HashMap,
    net::{IpAddr, Ipv6Addr},
    sync::{Mutex, PoisonError},
    time::{Duration, Instant},
};

/// So many addresses are remembered at most; then those that have asked for nothing lately are forgotten.
const REMEMBERED: usize = 10_000;

/// A bucket of permissions that fills at a steady rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bucket {
    level: f64,
    filled: Instant,
    rate: f64,
    size: f64,
}

impl Bucket {
    /// A full bucket: so many at once, and then so many a second.
    #[must_use]
    pub(crate) const fn new(size: f64, rate: f64, now: Instant) -> Self {
        Self { level: size, filled: now, rate, size }
    }

    /// Takes one, if there is one.
    pub(crate) fn take(&mut self, now: Instant) -> bool {
        self.fill(now);
        let allowed = self.level >= 1.0;
        if allowed {
            self.level -= 1.0;
        }
        allowed
    }

    /// Takes this many, whether there are so many or not; how long it is until none is owed.
    pub(crate) fn spend(&mut self, count: usize, now: Instant) -> Duration {
        self.fill(now);
        self.level -= count as f64;
        Duration::from_secs_f64((-self.level / self.rate).max(0.0))
    }

    fn fill(&mut self, now: Instant) {
        let passed = now.saturating_duration_since(self.filled).as_secs_f64();
        self.level = (self.level + passed * self.rate).min(self.size);
        self.filled = now;
    }

    fn is_full(&self, now: Instant) -> bool {
        let passed = now.saturating_duration_since(self.filled).as_secs_f64();
        self.level + passed * self.rate >= self.size
    }
}

/// A bucket for each address.
#[derive(Debug)]
pub(crate) struct PerAddress {
    buckets: Mutex<HashMap<IpAddr, Bucket>>,
    size: f64,
    rate: f64,
}

impl PerAddress {
    /// So many at once, and then so many a second.
    #[must_use]
    pub(crate) fn new(size: f64, rate: f64) -> Self {
        Self { buckets: Mutex::default(), size, rate }
    }

    /// Whether somebody may ask now.
    pub(crate) fn take(&self, address: IpAddr, now: Instant) -> bool {
        let mut buckets = self.buckets.lock().unwrap_or_else(PoisonError::into_inner);
        if buckets.len() >= REMEMBERED {
            buckets.retain(|_, bucket| !bucket.is_full(now));
        }
        if buckets.len() >= REMEMBERED && !buckets.contains_key(&address) {
            return false;
        }
        buckets.entry(address).or_insert_with(|| Bucket::new(self.size, self.rate, now)).take(now)
    }
}

/// The address by which a client is counted: one that has a network of IPv6 to itself has one place, not as
/// many as there are addresses in it.
pub(crate) fn network(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            IpAddr::V6(Ipv6Addr::new(a, b, c, d, 0, 0, 0, 0))
        }
        address => address,
    }
}

/// Counts the things that each address does at the same time.
#[derive(Debug)]
pub(crate) struct AtOnce {
    most: usize,
    counts: Mutex<HashMap<IpAddr, usize>>,
}

/// Something that an address does, until this is dropped.
#[derive(Debug)]
pub(crate) struct Doing<'a> {
    all: &'a AtOnce,
    address: IpAddr,
}

impl AtOnce {
    /// So many things of an address.
    #[must_use]
    pub(crate) fn new(most: usize) -> Self {
        Self { most, counts: Mutex::default() }
    }

    /// Begins something, unless the address does too much already.
    pub(crate) fn begin(&self, address: IpAddr) -> Option<Doing<'_>> {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        let count = counts.entry(address).or_default();
        if *count >= self.most {
            return None;
        }
        *count += 1;
        Some(Doing { all: self, address })
    }
}

impl Drop for Doing<'_> {
    fn drop(&mut self) {
        let mut counts = self.all.counts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = counts.get_mut(&self.address) {
            *count -= 1;
            if *count == 0 {
                counts.remove(&self.address);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::Ipv4Addr;

    #[test]
    fn buckets_fill_at_their_rate() {
        let start = Instant::now();
        let mut bucket = Bucket::new(3.0, 2.0, start);
        let allowed = (0..5).filter(|_| bucket.take(start)).count();
        assert_eq!(allowed, 3);
        let later = start + Duration::from_secs(1);
        assert_eq!((0..5).filter(|_| bucket.take(later)).count(), 2);
        let much_later = start + Duration::from_secs(100);
        assert_eq!((0..9).filter(|_| bucket.take(much_later)).count(), 3);
        let at_last = start + Duration::from_secs(200);
        assert_eq!(bucket.spend(2, at_last), Duration::ZERO);
        assert_eq!(bucket.spend(5, at_last), Duration::from_secs(2));
        assert!(!bucket.take(at_last + Duration::from_secs(2)));
    }

    #[test]
    fn addresses_do_not_use_up_memory_or_one_another() {
        let now = Instant::now();
        let limit = PerAddress::new(1.0, 1.0);
        let address = |k: u32| IpAddr::V4(Ipv4Addr::from(k));
        assert!(limit.take(address(0), now) && !limit.take(address(0), now) && limit.take(address(1), now));
        (2..20_000).for_each(|k| {
            limit.take(address(k), now);
        });
        assert!(limit.buckets.lock().unwrap().len() <= REMEMBERED);
        assert!(limit.take(address(30_000), now + Duration::from_secs(2)));
    }

    #[test]
    fn an_address_does_so_much_at_once() {
        let all = AtOnce::new(2);
        let [one, other] = ["10.0.0.1", "10.0.0.2"].map(|text| text.parse().expect("an address"));
        let first = all.begin(one);
        let _second = all.begin(one);
        assert!(first.is_some() && all.begin(one).is_none() && all.begin(other).is_some());
        drop(first);
        assert!(all.begin(one).is_some());
        assert_eq!(all.counts.lock().unwrap().len(), 1);
    }

    #[test]
    fn a_network_of_ipv6_counts_as_one() {
        let of = |text: &str| network(text.parse().expect("an address"));
        assert_eq!(of("2001:db8:1:2::1"), of("2001:db8:1:2:ffff::9"));
        assert_ne!(of("2001:db8:1:2::1"), of("2001:db8:1:3::1"));
        assert_eq!(of("::ffff:10.0.0.1"), of("10.0.0.1"));
    }
}
