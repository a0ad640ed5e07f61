//! Forecasts, and what they must not depend on.

use crate::support::{difference, event, random, unlike};
use candle_core::{Device, Result, Tensor};
use phase_baselines::{
    forecasting::{ForecastOrigin, Forecasting, HORIZON},
    nodes::{Batch, MOVING, Nodes},
    social_lstm::SocialLstm,
    stgat::Stgat,
};
use phase_event::ObservedEvent;
use phase_model::{Body, Layout, Size, Vec2, arena::CENTRE};

fn networks() -> [Box<dyn Forecasting>; 2] {
    let social = SocialLstm::new(8, &mut random(0)).expect("a network");
    [Box::new(social), Box::new(Stgat::new(8, 2, &mut random(0)).expect("a network"))]
}

/// A network's outputs for an event's row, for present nodes.
fn said(network: &dyn Forecasting, batch: &Batch, moment: ForecastOrigin) -> Vec<f32> {
    let displacements = network.displacements(batch, &[moment]).expect("an answer");
    assert_eq!(displacements.dims(), [MOVING, HORIZON, 2]);
    let present = (0..MOVING).filter(|&node| batch.has(moment.event, node));
    let of_node = |node| -> Vec<f32> {
        displacements.get(node).expect("a node").flatten_all().expect("numbers").to_vec1().expect("numbers")
    };
    present.flat_map(of_node).collect()
}

#[test]
fn company_and_padding_change_nothing() {
    let nodes = unlike();
    let all: Vec<&Nodes> = nodes.iter().collect();
    for network in networks() {
        for (event, nodes) in nodes.iter().enumerate() {
            let moment = ForecastOrigin { event, row: 3 };
            let together = said(&*network, &Batch::new(&all).unwrap(), moment);
            assert_eq!(together, said(&*network, &Batch::padded_with(&all, 55.5).unwrap(), moment));
            let alone = said(&*network, &Batch::new(&[nodes]).unwrap(), ForecastOrigin { event: 0, row: 3 });
            assert!(difference(&together, &alone) < 1e-5);
        }
    }
}

#[test]
fn what_comes_later_is_not_known() {
    let event = event(3, 12, 2, 0.0);
    for network in networks() {
        let at_row_4 = |event: &ObservedEvent| {
            let nodes = Nodes::of(event);
            said(&*network, &Batch::new(&[&nodes]).unwrap(), ForecastOrigin { event: 0, row: 4 })
        };
        assert!(difference(&at_row_4(&event), &at_row_4(&event.prefix(4))) < 1e-6);
        assert!(difference(&at_row_4(&event), &at_row_4(&crate::support::event(5, 12, 2, 0.0))) > 1e-4);
    }
}

#[test]
fn neighbours_matter_where_they_can_be_seen() {
    // Agent 1 stands at some distance of agent 0, for two rows so that it has been seen once.
    let at = |distance: f32| {
        let mut rows = [Default::default(); 3];
        for row in &mut rows {
            *row = [Body::at_rest(CENTRE - Vec2::new(9.0, 9.0), 0.0); 4];
            row[1] = Body::at_rest(CENTRE - Vec2::new(9.0 - distance, 9.0), 0.0);
        }
        let layout = Layout::new(0, None).unwrap();
        ObservedEvent::new(layout, [Size::Small; 2], Vec::new(), rows.to_vec()).unwrap()
    };
    for (network, far_too) in networks().into_iter().zip([false, true]) {
        let first = |distance| network.forecast(&at(distance), 1).unwrap()[0][0];
        assert_ne!(first(1.0), first(5.0));
        // The grid ends 8 u away, graph attention does not.
        assert_eq!(first(12.0) != first(16.0), far_too);
    }
}

/// Predicts that every entity continues as in its last step, and 1 u a step upwards as well.
struct Onwards;

impl Forecasting for Onwards {
    fn displacements(&self, batch: &Batch, origins: &[ForecastOrigin]) -> Result<Tensor> {
        let [moment] = origins else { unreachable!("one event is asked about") };
        let before = batch.positions(0, moment.row - 1).expect("a row");
        let now = batch.positions(0, moment.row).expect("a row");
        let mut values = Vec::new();
        for node in 0..MOVING {
            let by = now[node] - before[node] + Vec2::new(0.0, 1.0);
            (1..=HORIZON).for_each(|step| values.extend((by * step as f32).to_array()));
        }
        Tensor::from_vec(values, (MOVING, HORIZON, 2), &Device::Cpu)
    }
}

#[test]
fn what_was_predicted_is_seen_when_more_is_asked_for() {
    let mut rows = vec![[Body::at_rest(CENTRE, 0.5); 4]; 2];
    rows[1][0].position += Vec2::new(0.25, 0.0);
    let layout = Layout::new(0, None).unwrap();
    let event = ObservedEvent::new(layout, [Size::Small; 2], vec![Size::Small], rows).unwrap();
    let forecast = Onwards.forecast(&event, 13).unwrap();
    assert_eq!(forecast.len(), 3);
    assert!(forecast.iter().all(|path| path.len() == 13));
    // Ten steps of (0.25, 1), then three of (0.25, 2).
    let expected = [(0, (0.5, 1.0)), (9, (2.75, 10.0)), (10, (3.0, 12.0)), (12, (3.5, 16.0))];
    for (step, (x, y)) in expected {
        assert!((forecast[0][step] - CENTRE - Vec2::new(x, y)).length() < 1e-4);
    }
    assert_eq!(Onwards.forecast(&event, 0).unwrap(), vec![Vec::new(); 3]);
}

#[test]
fn forecasts_have_their_shape() {
    for network in networks() {
        for (rows, objects, steps) in [(1, 0, 1), (21, 2, 20), (5, 1, 25)] {
            let forecast = network.forecast(&event(1, rows, objects, f32::NAN), steps).unwrap();
            assert_eq!(forecast.len(), 2 + objects);
            assert!(
                forecast.iter().all(|path| path.len() == steps && path.iter().all(|point| point.is_finite()))
            );
        }
    }
}
