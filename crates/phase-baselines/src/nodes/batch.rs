//! Several events side by side, step by step.

use super::{ContactMatrix, FEATURES, FIXED, MOVING, NODES, Nodes};
use candle_core::{Device, Result, Tensor};
use phase_model::{Segment, Vec2};
use std::sync::Arc;

/// Additive padding mask: below any LSTM output once it is added to one.
const PADDING_BIAS: f32 = -4.0;

/// A padded batch of events. Rows past an event's end and absent objects or walls are padded and masked.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Features of moving nodes, by row: (events · [`MOVING`]) × [`FEATURES`].
    pub(crate) moving: Vec<Tensor>,
    /// Features of every distinct landmark or wall, once: × [`FEATURES`].
    pub(crate) fixed: Tensor,
    /// Indices of fixed nodes: events · [`FIXED`] places in [`fixed`](Self::fixed).
    pub(crate) fixed_places: Tensor,
    /// events × [`NODES`]: 0 for present nodes, otherwise so low that it is never the maximum.
    pub(crate) padding_mask: Tensor,
    /// Rows of each event.
    lengths: Vec<usize>,
    /// Objects of each event.
    objects: Vec<usize>,
    /// events × [`NODES`]: which nodes are present.
    present: Vec<bool>,
    /// Positions of moving nodes (u), by event and row.
    positions: Vec<Vec<[Vec2; MOVING]>>,
    /// Positions of fixed nodes (u), by event.
    places: Vec<Vec<Vec2>>,
    /// Contacts of moving nodes, by event and row.
    contacts: Vec<Vec<ContactMatrix>>,
    /// Inner walls (u), by event.
    walls: Vec<Vec<Segment>>,
}

impl Batch {
    /// Batches events, at least one.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn new(events: &[&Nodes]) -> Result<Self> {
        Self::padded_with(events, 0.0)
    }

    /// A batch with some value instead of zeros as padding. The networks' outputs do not depend on it.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    pub fn padded_with(events: &[&Nodes], padding: f32) -> Result<Self> {
        let max_norm = events.iter().map(|nodes| nodes.rows()).max().unwrap_or(0);
        let moving = (0..max_norm).map(|row| {
            let mut features = Vec::with_capacity(events.len() * MOVING * FEATURES);
            for nodes in events {
                for node in 0..MOVING {
                    match nodes.moving.get(row) {
                        Some(all) if nodes.has_moving(node) => features.extend_from_slice(&all[node]),
                        _ => features.extend_from_slice(&[padding; FEATURES]),
                    }
                }
            }
            Tensor::from_vec(features, (events.len() * MOVING, FEATURES), &Device::Cpu)
        });
        let (fixed, fixed_places) = fixed(events)?;
        let present: Vec<bool> =
            events.iter().flat_map(|nodes| (0..NODES).map(|node| nodes.has(node))).collect();
        let padding_mask: Vec<f32> =
            present.iter().map(|present| if *present { 0.0 } else { PADDING_BIAS }).collect();
        Ok(Self {
            moving: moving.collect::<Result<_>>()?,
            fixed,
            fixed_places,
            padding_mask: Tensor::from_vec(padding_mask, (events.len(), NODES), &Device::Cpu)?,
            lengths: events.iter().map(|nodes| nodes.rows()).collect(),
            objects: events.iter().map(|nodes| nodes.objects).collect(),
            present,
            positions: events.iter().map(|nodes| nodes.positions.clone()).collect(),
            places: events.iter().map(|nodes| nodes.places.clone()).collect(),
            contacts: events.iter().map(|nodes| nodes.contacts.clone()).collect(),
            walls: events.iter().map(|nodes| nodes.walls.clone()).collect(),
        })
    }

    /// Number of events.
    #[must_use]
    pub fn events(&self) -> usize {
        self.lengths.len()
    }

    /// Rows of each event.
    #[must_use]
    pub fn lengths(&self) -> &[usize] {
        &self.lengths
    }

    /// Objects of each event.
    #[must_use]
    pub fn objects(&self) -> &[usize] {
        &self.objects
    }

    /// Whether an event has a node.
    #[must_use]
    pub fn has(&self, event: usize, node: usize) -> bool {
        self.present.get(event * NODES + node).copied().unwrap_or(false)
    }

    /// Position of a moving node in a row of an event (u); `None` past its end.
    #[must_use]
    pub fn positions(&self, event: usize, row: usize) -> Option<&[Vec2; MOVING]> {
        self.positions.get(event)?.get(row)
    }

    /// Position of a node in a row of an event (u); `None` if it is absent.
    #[must_use]
    pub fn position(&self, event: usize, node: usize, row: usize) -> Option<Vec2> {
        if !self.has(event, node) {
            None
        } else if node < MOVING {
            Some(self.positions(event, row)?[node])
        } else {
            self.places.get(event)?.get(node - MOVING).copied()
        }
    }

    /// Contacts of moving nodes in a row of an event; `None` past its end.
    #[must_use]
    pub fn contacts(&self, event: usize, row: usize) -> Option<&ContactMatrix> {
        self.contacts.get(event)?.get(row)
    }

    /// Inner walls of an event (u), at most [`WALLS`](super::WALLS); none for an event that does not exist.
    #[must_use]
    pub fn walls(&self, event: usize) -> &[Segment] {
        self.walls.get(event).map_or(&[], Vec::as_slice)
    }

    /// Whether each event is active at a row, repeated `each` times; `None` if all are.
    pub(crate) fn active(&self, row: usize, each: usize) -> Option<Arc<[bool]>> {
        if self.lengths.iter().all(|&length| row < length) {
            return None;
        }
        let rows = self.lengths.iter().flat_map(|&length| core::iter::repeat_n(row < length, each));
        Some(rows.collect())
    }
}

/// Every distinct landmark and wall once, in order of appearance, and the index of each.
fn fixed(events: &[&Nodes]) -> Result<(Tensor, Tensor)> {
    let mut different: Vec<&[f32; FEATURES]> = Vec::new();
    let mut places = Vec::with_capacity(events.len() * FIXED);
    for nodes in events {
        for k in 0..FIXED {
            // Absent entries may have any value: they are masked.
            let place = nodes.fixed.get(k).map_or(0, |features| {
                different.iter().position(|known| *known == features).unwrap_or_else(|| {
                    different.push(features);
                    different.len() - 1
                })
            });
            places.push(place as u32);
        }
    }
    let features: Vec<f32> = different.iter().flat_map(|features| features.iter().copied()).collect();
    let count = places.len();
    Ok((
        Tensor::from_vec(features, (different.len(), FEATURES), &Device::Cpu)?,
        Tensor::from_vec(places, count, &Device::Cpu)?,
    ))
}
