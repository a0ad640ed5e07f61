//! The contacts of a substep, and the data kept for the next substep.

use crate::contact::Contact;
use core::fmt;

/// Maximum number of contacts solved at once; more than four bodies between walls ever have.
pub(crate) const MAX_CONTACTS: usize = 16;

/// The data of a contact that is kept for the next substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CachedContact {
    pub(crate) key: u8,
    pub(crate) count: u8,
    pub(crate) names: [u16; 2],
    pub(crate) impulses: [f32; 2],
}

impl CachedContact {
    pub(crate) const NONE: Self = Self { key: u8::MAX, count: 0, names: [0; 2], impulses: [0.0; 2] };
}

/// The contacts found in a substep, newest first, and the data kept from the substep before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactSet {
    pub(crate) contacts: [Contact; MAX_CONTACTS],
    pub(crate) count: usize,
    pub(crate) traces: CachedContacts,
}

impl ContactSet {
    pub(crate) const NONE: Self =
        Self { contacts: [Contact::NONE; MAX_CONTACTS], count: 0, traces: CachedContacts::NONE };

    /// The contacts found.
    pub(crate) fn current(&self) -> &[Contact] {
        &self.contacts[..self.count]
    }

    /// The contacts found, to be solved.
    pub(crate) fn current_mut(&mut self) -> &mut [Contact] {
        &mut self.contacts[..self.count]
    }

    /// Takes over the contacts found now, with the impulses their points had in the last substep. Contacts
    /// past the maximum are dropped.
    pub(crate) fn replace(&mut self, current: impl Iterator<Item = Contact>) {
        self.count = 0;
        for (place, mut contact) in self.contacts.iter_mut().zip(current) {
            self.traces.warm_start(&mut contact);
            *place = contact;
            self.count += 1;
        }
    }

    /// Keeps the data for the next substep.
    pub(crate) fn keep(&mut self) {
        self.traces.count = self.count;
        for (trace, contact) in self.traces.list.iter_mut().zip(&self.contacts[..self.count]) {
            *trace = CachedContact {
                key: contact.key,
                count: contact.manifold.count as u8,
                names: contact.manifold.names,
                impulses: contact.impulses,
            };
        }
    }
}

/// The data kept of all contacts of a substep.
#[derive(Clone, Copy)]
pub(crate) struct CachedContacts {
    list: [CachedContact; MAX_CONTACTS],
    count: usize,
}

impl fmt::Debug for CachedContacts {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.kept()).finish()
    }
}

impl CachedContacts {
    pub(crate) const NONE: Self = Self { list: [CachedContact::NONE; MAX_CONTACTS], count: 0 };

    /// The contacts that are kept, newest first.
    pub(crate) fn kept(&self) -> &[CachedContact] {
        &self.list[..self.count]
    }

    /// Restores the impulses of a contact's points.
    fn warm_start(&self, contact: &mut Contact) {
        let Some(trace) = self.kept().iter().find(|trace| trace.key == contact.key) else {
            return;
        };
        for point in 0..contact.manifold.count {
            for old in 0..usize::from(trace.count) {
                if trace.names[old] == contact.manifold.names[point] {
                    contact.impulses[point] = trace.impulses[old];
                    break;
                }
            }
        }
    }
}
