//! Figures of SIMPLE's recognition of the truth, over a group of events.

use super::Member;
use crate::check_minds::recognition::{Recognition, SocialAgent};
use phase_model::AGENT_COUNT;
use phase_statistics::mean;
use serde::Serialize;

/// A posterior probability above which SIMPLE is as good as certain.
const CERTAIN: f64 = 0.9;

/// Figures of SIMPLE's recognition of the truth.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub(in crate::check_minds) struct RecognitionFigures {
    /// Mean log posterior probability of the true goals and attitudes (nat).
    pub(in crate::check_minds) log_posterior: Option<f64>,
    /// Mean posterior probability of the true relation.
    pub(in crate::check_minds) relation_probability: Option<f64>,
    /// Share of events whose true relation is the likeliest.
    pub(in crate::check_minds) relation_top1: Option<f64>,
    /// Share of agents whose true goal is the likeliest; always of both agents.
    pub(in crate::check_minds) goal_top1: Option<f64>,
    /// Events in which an agent helps or hinders, and whether the right one is named.
    pub(in crate::check_minds) social_agent: Option<SocialFigures>,
}

/// Whether the agent that helps (or hinders) is told from the other: numbers of events.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub(in crate::check_minds) struct SocialFigures {
    /// In which one agent helps or hinders.
    pub(in crate::check_minds) events: usize,
    /// In which the true pair of attitudes is the likeliest.
    pub(in crate::check_minds) named: usize,
    /// In which the right agent is likelier than the other to have that attitude.
    pub(in crate::check_minds) likelier: usize,
    /// In which the wrong agent has it with a probability above 0.9.
    pub(in crate::check_minds) wrong_above_90: usize,
    /// Mean posterior probability of the right agent having it.
    pub(in crate::check_minds) probability: f64,
}

impl RecognitionFigures {
    pub(super) fn of(members: &[Member<'_>]) -> Self {
        let all: Option<Vec<Recognition>> = members.iter().map(|member| member.event.recognition).collect();
        let Some(all) = all else { return Self::default() };
        let mean_of = |of: fn(&Recognition) -> f64| mean(&all.iter().map(of).collect::<Vec<_>>());
        Self {
            log_posterior: mean_of(|it| it.log_posterior),
            relation_probability: mean_of(|it| it.relation),
            relation_top1: mean_of(|it| f64::from(u8::from(it.relation_right))),
            goal_top1: mean_of(|it| it.goals_right as f64 / AGENT_COUNT as f64),
            social_agent: SocialFigures::of(&all.iter().filter_map(|it| it.social).collect::<Vec<_>>()),
        }
    }
}

impl SocialFigures {
    fn of(all: &[SocialAgent]) -> Option<Self> {
        let count = |counts: fn(&SocialAgent) -> bool| all.iter().filter(|it| counts(it)).count();
        Some(Self {
            events: all.len(),
            named: count(|it| it.named),
            likelier: count(|it| it.right > it.wrong),
            wrong_above_90: count(|it| it.wrong > CERTAIN),
            probability: mean(&all.iter().map(|it| it.right).collect::<Vec<_>>())?,
        })
    }
}
