//! Absent nodes change nothing, and what order means.

use crate::support::{difference, event, random, unlike};
use phase_baselines::{
    arg::Arg,
    nodes::{Batch, Nodes},
    recognition::{Logits, Recognition},
    two_level_lstm::TwoLevelLstm,
};
use phase_event::ObservedEvent;
use phase_model::{Layout, Size};

/// All outputs of a network for a batch, event by event.
fn said(network: &dyn Recognition, batch: &Batch) -> Vec<Vec<f32>> {
    let Logits { goals, relations } = network.logits(batch, None).expect("numbers");
    (0..batch.events())
        .map(|event| {
            let mut values: Vec<f32> = goals
                .get(event)
                .expect("numbers")
                .flatten_all()
                .expect("numbers")
                .to_vec1()
                .expect("numbers");
            values.extend(relations.get(event).expect("numbers").to_vec1::<f32>().expect("numbers"));
            values
        })
        .collect()
}

fn networks() -> [Box<dyn Recognition>; 2] {
    let lstm = TwoLevelLstm::new(8, &mut random(0)).expect("numbers");
    [Box::new(lstm), Box::new(Arg::new(8, 2, &mut random(0)).expect("numbers"))]
}

#[test]
fn company_and_padding_change_nothing() {
    let nodes = unlike();
    let all: Vec<&Nodes> = nodes.iter().collect();
    for network in networks() {
        let together = said(&*network, &Batch::new(&all).unwrap());
        assert_eq!(together, said(&*network, &Batch::padded_with(&all, 55.5).unwrap()));
        for (nodes, among) in nodes.iter().zip(&together) {
            let alone = said(&*network, &Batch::new(&[nodes]).unwrap());
            assert!(difference(&alone[0], among) < 1e-5);
        }
        // Outputs for different events differ.
        assert!(difference(&together[0], &together[1]) > 1e-4);
    }
}

#[test]
fn bodies_past_the_last_object_are_not_seen() {
    for network in networks() {
        let judged = |rubbish| network.judge(&event(1, 7, 1, rubbish)).unwrap();
        assert_eq!(judged(0.0), judged(f32::NAN));
    }
}

#[test]
fn goals_about_absent_objects_are_not_named() {
    for network in networks() {
        for (objects, count) in [(0, 14), (1, 22), (2, 30)] {
            let judgement = network.judge(&event(2, 7, objects, 0.0)).unwrap();
            for goals in &judgement.goals {
                assert_eq!(goals.len(), count);
                assert!((goals.iter().map(|(_, p)| p).sum::<f64>() - 1.0).abs() < 1e-6);
                assert!(goals.windows(2).all(|pair| pair[0].1 >= pair[1].1));
            }
        }
    }
}

#[test]
fn events_of_one_row_are_judged() {
    for network in networks() {
        network.judge(&event(0, 1, 0, 0.0)).unwrap();
    }
}

#[test]
fn walls_are_seen() {
    let event = |base| {
        let rows = event(0, 6, 1, 0.0).rows().to_vec();
        let layout = Layout::new(base, None).unwrap();
        ObservedEvent::new(layout, [Size::Small; 2], vec![Size::Small], rows).unwrap()
    };
    for network in networks() {
        assert_ne!(network.judge(&event(0)).unwrap().relation, network.judge(&event(21)).unwrap().relation);
    }
}

#[test]
fn the_order_of_rows_matters() {
    let straight = event(3, 12, 2, 0.0);
    let mut rows = straight.rows().to_vec();
    rows.reverse();
    let back =
        ObservedEvent::new(straight.layout(), straight.agent_sizes(), straight.object_sizes().to_vec(), rows);
    for network in networks() {
        let logits = [&straight, &back.clone().unwrap()].map(|event| network.judge(event).unwrap());
        assert_ne!(logits[0].relation, logits[1].relation);
    }
}

#[test]
fn frames_of_a_graph_have_no_order() {
    let network = Arg::new(8, 2, &mut random(0)).unwrap();
    let nodes = Nodes::of(&event(3, 14, 2, 0.0));
    let batch = Batch::new(&[&nodes]).unwrap();
    let relations =
        |rows| network.logits_at(&batch, &[rows]).unwrap().relations.get(0).unwrap().to_vec1().unwrap();
    let some: Vec<f32> = relations([0, 2, 3, 5, 6, 8, 9, 10, 12, 13]);
    assert!(difference(&some, &relations([9, 2, 13, 5, 12, 8, 0, 10, 6, 3])) < 1e-5);
    assert!(difference(&some, &relations([1, 2, 3, 5, 6, 8, 9, 10, 12, 13])) > 1e-5);
}
