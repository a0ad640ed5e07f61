//! Several searches of the same decision, whose statistics are added up.

use rand::{Rng, SeedableRng};

use crate::{
    ActionStatistics, Decision, GenerativeModel, Pomcp, PomcpError, PomcpSettings, SearchStatistics,
};

/// Independent planners that search the same decision, each in a tree and with a generator of its own (root
/// parallelism, Chaslot et al. 2008).
///
/// The decision is that of the visits of all trees together. It depends on the number of trees, not on the number of
/// threads: with the feature `parallel` the trees are shared among the threads of rayon's pool, without it they are
/// searched one after the other, and the result is the same to the last bit.
///
/// The trade-off: trees learn nothing from each other, so k trees of n simulations decide better than one of n and not
/// as well as one of k·n.
#[derive(Debug, Clone)]
pub struct Forest<O> {
    trees: Vec<Pomcp<O>>,
}

impl<O: Eq + Clone> Forest<O> {
    /// `trees` planners with the same settings; each runs that many simulations.
    ///
    /// # Errors
    /// [`PomcpError::ZeroTrees`], and as [`PomcpSettings::validate`].
    pub fn new(settings: PomcpSettings, trees: usize) -> Result<Self, PomcpError> {
        if trees == 0 {
            return Err(PomcpError::ZeroTrees);
        }
        Ok(Self { trees: vec![Pomcp::new(settings)?; trees] })
    }

    /// The settings of each tree.
    pub fn settings(&self) -> &PomcpSettings {
        self.trees[0].settings()
    }

    /// Finds the action to take as [`Pomcp::search`] does. From `random` it draws a seed for each tree's generator, which
    /// is of the same kind.
    ///
    /// # Errors
    /// As [`Pomcp::search`]; that of the first tree that has one.
    pub fn search<M, R>(
        &mut self,
        model: &M,
        roots: &[M::State],
        random: &mut R,
    ) -> Result<Decision, PomcpError>
    where
        M: GenerativeModel<Observation = O> + Sync,
        M::State: Sync,
        O: Send,
        R: Rng + SeedableRng,
    {
        let seeds: Vec<u64> = self.trees.iter().map(|_| random.next_u64()).collect();
        let search =
            |(tree, seed): (&mut Pomcp<O>, u64)| tree.search(model, roots, &mut R::seed_from_u64(seed));
        let decisions = each_tree(&mut self.trees, seeds, search);
        decisions.into_iter().collect::<Result<Vec<_>, _>>().map(|decisions| sum(&decisions))
    }
}

#[cfg(feature = "parallel")]
fn each_tree<O: Send, T: Send>(
    trees: &mut [Pomcp<O>],
    seeds: Vec<u64>,
    search: impl Fn((&mut Pomcp<O>, u64)) -> T + Sync,
) -> Vec<T> {
    use rayon::prelude::*;
    trees.par_iter_mut().zip(seeds).map(&search).collect()
}

#[cfg(not(feature = "parallel"))]
fn each_tree<O, T>(
    trees: &mut [Pomcp<O>],
    seeds: Vec<u64>,
    search: impl Fn((&mut Pomcp<O>, u64)) -> T,
) -> Vec<T> {
    trees.iter_mut().zip(seeds).map(search).collect()
}

/// Visits and efforts added up, values averaged over visits. There is one decision at least.
fn sum(decisions: &[Decision]) -> Decision {
    let mut actions = vec![ActionStatistics::default(); decisions[0].actions.len()];
    let mut effort = SearchStatistics::default();
    for decision in decisions {
        for (total, action) in actions.iter_mut().zip(&decision.actions) {
            total.visits += action.visits;
            if action.visits > 0 {
                total.value += (action.value - total.value) * action.visits as f64 / total.visits as f64;
            }
        }
        effort.histories += decision.effort.histories;
        effort.depth = effort.depth.max(decision.effort.depth);
        effort.steps += decision.effort.steps;
    }
    Decision::new(actions, effort)
}
