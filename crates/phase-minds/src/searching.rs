//! Whether and how minds search.

use crate::MindParameters;
use phase_agent::Prior;
use phase_published::{PublishedParameters, RandomNumbers};

impl MindParameters {
    /// These parameters for published minds with the original's random numbers, if they are wanted, and
    /// either as in the recordings or as in worlds of ours: in the former they know that agents of the
    /// greatest strength coast when they mean to stop, and have the older actions. Other minds stay as they
    /// are.
    #[must_use]
    pub const fn as_recorded(mut self, original_random: bool, recorded: bool) -> Self {
        if let Self::Published(parameters) = &mut self {
            if original_random {
                parameters.random = RandomNumbers::Original;
            }
            parameters.strongest_coasts = recorded;
            parameters.older_actions = recorded;
        }
        self
    }

    /// These parameters for published minds that search as the original does, once a decision and with as
    /// many simulations. Only then do its random numbers repeat what it did. Other minds stay as they are.
    #[must_use]
    pub fn searching_as_original(mut self) -> Self {
        if let Self::Published(parameters) = &mut self {
            let PublishedParameters { simulations, searches, .. } = PublishedParameters::default();
            (parameters.simulations, parameters.searches) = (simulations, searches);
            parameters.network_alone = false;
        }
        self
    }

    /// These parameters for a mind that takes what a policy network says that a search would choose.
    #[must_use]
    pub const fn asking_network(mut self) -> Self {
        match &mut self {
            Self::Phase(parameters) => parameters.prior = Prior::NetworkAlone,
            Self::Published(parameters) => parameters.network_alone = true,
        }
        self
    }

    /// Whether the mind takes what a policy network says, without a search.
    #[must_use]
    pub const fn asks_network(&self) -> bool {
        match self {
            Self::Phase(parameters) => matches!(parameters.prior, Prior::NetworkAlone),
            Self::Published(parameters) => parameters.network_alone,
        }
    }

    /// These parameters for a mind that searches: one that would ask a network searches without it.
    #[must_use]
    pub const fn searching(mut self) -> Self {
        if self.asks_network() {
            match &mut self {
                Self::Phase(parameters) => parameters.prior = Prior::Habits,
                Self::Published(parameters) => parameters.network_alone = false,
            }
        }
        self
    }

    /// These parameters for a mind that searches once a decision, as one that acts does.
    #[must_use]
    pub const fn searching_once(mut self) -> Self {
        if let Self::Published(parameters) = &mut self {
            parameters.searches = 1;
        }
        self
    }
}
