//! Common parts of the networks for Task 2: inputs, loss, forecasts.

use crate::{
    nodes::{Batch, MOVING, Nodes},
    training::{Loss, TrainingSettings},
};
use candle_core::{D, Device, Result, Tensor};
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Forecast, Vec2, arena::STEP_SECONDS, random::Pcg64Mcg};

/// Steps that the networks predict at a time.
pub const HORIZON: usize = 10;
/// Settings of the training of these networks: batch size and learning rate are the paper's.
pub const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 8,
    learning_rate: 1e-2,
    max_gradient_norm: 10.0,
    round: 320,
    patience: 15,
    rounds: 200,
};
/// Metric beside the loss: the same distance over agents alone (u).
pub(crate) const METRICS: [&str; 1] = ["agents"];
/// Keeps the gradient of a distance finite where it is 0 (u²).
const EPSILON: f64 = 1e-6;

/// A moment of one event of a batch: everything after it is to be predicted from everything before.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ForecastOrigin {
    /// The event's index in the batch.
    pub event: usize,
    /// The last row that is known.
    pub row: usize,
}

/// A network that predicts trajectories.
pub trait Forecasting {
    /// Displacements of all moving nodes over the [`HORIZON`] steps after some moments (u), in that order:
    /// (moments · [`MOVING`]) × [`HORIZON`] × 2. The values of absent objects are meaningless.
    ///
    /// # Errors
    ///
    /// If there is no such origin, or a tensor cannot be allocated.
    fn displacements(&self, batch: &Batch, origins: &[ForecastOrigin]) -> Result<Tensor>;

    /// The moments of a batch used for training and for evaluation. All but the last row of each event,
    /// unless that is too many.
    fn origins(&self, batch: &Batch, _chance: Option<&mut Pcg64Mcg>) -> Vec<ForecastOrigin> {
        let each = batch.lengths().iter().enumerate();
        each.flat_map(|(event, &length)| {
            (0..length.saturating_sub(1)).map(move |row| ForecastOrigin { event, row })
        })
        .collect()
    }

    /// Positions of all moving entities in the next `steps` steps. [`HORIZON`] of them are predicted at a
    /// time; for more, the network is given its own predictions as input.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    fn forecast(&self, event: &ObservedEvent, steps: usize) -> Result<Forecast> {
        let entities = event.entities().count();
        let mut forecast = vec![Vec::with_capacity(steps + HORIZON); entities];
        let mut known = event.clone();
        while forecast.first().is_some_and(|path| path.len() < steps) {
            let nodes = Nodes::of(&known);
            let batch = Batch::new(&[&nodes])?;
            let moment = ForecastOrigin { event: 0, row: nodes.rows() - 1 };
            let moved: Vec<Vec<Vec<f32>>> = self.displacements(&batch, &[moment])?.to_vec3()?;
            let Some(last) = known.rows().last() else { break };
            for ((path, body), moved) in forecast.iter_mut().zip(last).zip(&moved) {
                path.extend(moved.iter().map(|by| body.position + Vec2::new(by[0], by[1])));
            }
            let Some(longer) = continued(&known, &forecast) else { break };
            known = longer;
        }
        forecast.iter_mut().for_each(|path| path.truncate(steps));
        Ok(forecast)
    }
}

/// The event extended by the last [`HORIZON`] positions of a forecast, with velocities from finite
/// differences and constant angles. `None` if a value is not finite.
fn continued(event: &ObservedEvent, forecast: &Forecast) -> Option<ObservedEvent> {
    let mut rows = event.rows().to_vec();
    for step in (0..HORIZON).rev() {
        let mut row = *rows.last()?;
        for (body, path) in row.iter_mut().zip(forecast) {
            let position = *path.get(path.len().checked_sub(1 + step)?)?;
            body.velocity = (position - body.position) / STEP_SECONDS as f32;
            body.position = position;
        }
        rows.push(row);
    }
    ObservedEvent::new(event.layout(), event.agent_sizes(), event.object_sizes().to_vec(), rows).ok()
}

/// Mean distance between predicted and true positions (u), over everything present and all steps to predict.
pub(crate) fn loss(
    network: &impl Forecasting,
    events: &[&Nodes],
    random: Option<&mut Pcg64Mcg>,
) -> Result<Loss> {
    let batch = Batch::new(events)?;
    let origins = network.origins(&batch, random);
    let displacements = network.displacements(&batch, &origins)?;
    let mut truth = Vec::with_capacity(origins.len() * MOVING * HORIZON * 2);
    let mut agents = Vec::new();
    let mut all = Vec::new();
    for &ForecastOrigin { event, row } in &origins {
        for node in 0..MOVING {
            for step in 1..=HORIZON {
                let path = batch.positions(event, row).zip(batch.positions(event, row + step));
                let path = path.filter(|_| batch.has(event, node));
                truth.extend(path.map_or([0.0; 2], |(now, then)| (then[node] - now[node]).to_array()));
                let counts = if path.is_some() { 1.0_f32 } else { 0.0 };
                all.push(counts);
                agents.push(if node < AGENT_COUNT { counts } else { 0.0 });
            }
        }
    }
    let truth = Tensor::from_vec(truth, displacements.shape(), &Device::Cpu)?;
    let off = ((displacements - truth)?.sqr()?.sum(D::Minus1)? + EPSILON)?.sqrt()?;
    let mean = |counts: Vec<f32>| -> Result<Tensor> {
        let count = f64::from(counts.iter().sum::<f32>()).max(1.0);
        (&off * Tensor::from_vec(counts, off.shape(), &Device::Cpu)?)?.sum_all()? / count
    };
    let agents = f64::from(mean(agents)?.to_scalar::<f32>()?);
    Ok(Loss { loss: mean(all)?, scores: vec![agents] })
}

/// The rows of stacked values (rows of the event, events of the batch, moving nodes) that belong to some
/// moments.
pub(crate) fn places(batch: &Batch, origins: &[ForecastOrigin]) -> Result<Tensor> {
    let rows = origins.iter().flat_map(|&ForecastOrigin { event, row }| {
        (0..MOVING).map(move |node| ((row * batch.events() + event) * MOVING + node) as u32)
    });
    Tensor::from_iter(rows, &Device::Cpu)
}
