//! SocialGNN: what it sees and what it does not.

use crate::support::{difference, event, random, unlike};
use phase_baselines::{
    nodes::{Batch, Nodes},
    social_gnn::SocialGnn,
};
use phase_event::ObservedEvent;
use phase_model::{Body, Layout, MAX_ENTITIES, Size, Vec2, arena::CENTRE};

fn network() -> SocialGnn {
    SocialGnn::new(8, 6, &mut random(0)).expect("a network")
}

fn logits(batch: &Batch) -> Vec<Vec<f32>> {
    network().logits(batch).expect("logits").to_vec2().expect("numbers")
}

/// Two agents at rest for some rows, so far apart (u), one on each side of the arena's centre along x.
fn apart(distance: f32, base: u8) -> ObservedEvent {
    let mut bodies = [Body::at_rest(CENTRE, 0.0); MAX_ENTITIES];
    // Off the centre, from which walls radiate.
    for (body, side) in bodies.iter_mut().zip([-0.5, 0.5]) {
        body.position = CENTRE + Vec2::new(side * distance, 5.0);
    }
    let layout = Layout::new(base, None).expect("a layout");
    ObservedEvent::new(layout, [Size::Small; 2], Vec::new(), vec![bodies; 4]).expect("an event")
}

/// Whether the two agents of such an event are in contact.
fn in_contact(distance: f32, base: u8) -> bool {
    let nodes = Nodes::of(&apart(distance, base));
    let batch = Batch::new(&[&nodes]).expect("a batch");
    let contacts = batch.contacts(0, 0).expect("a row");
    assert_eq!(contacts[0][1], contacts[1][0]);
    assert!((0..contacts.len()).all(|k| !contacts[k][k]));
    assert_eq!(batch.contacts(0, 4), None);
    contacts[0][1]
}

#[test]
fn company_and_padding_change_nothing() {
    let nodes = unlike();
    let all: Vec<&Nodes> = nodes.iter().collect();
    let together = logits(&Batch::new(&all).unwrap());
    assert_eq!(together, logits(&Batch::padded_with(&all, 55.5).unwrap()));
    for (nodes, among) in nodes.iter().zip(&together) {
        assert!(difference(&logits(&Batch::new(&[nodes]).unwrap())[0], among) < 1e-5);
    }
    assert!(difference(&together[0], &together[1]) > 1e-4);
}

#[test]
fn bodies_past_the_last_object_are_not_seen() {
    let judged = |rubbish| network().judge(&event(1, 7, 1, rubbish)).unwrap();
    assert_eq!(judged(0.0), judged(f32::NAN));
}

#[test]
fn probabilities_sum_to_one_even_for_one_row() {
    let relation = network().judge(&event(0, 1, 0, 0.0)).unwrap();
    let sum = relation.friendly + relation.adversarial + relation.neutral;
    assert!((sum - 1.0).abs() < 1e-6, "{sum}");
}

#[test]
fn bodies_near_each_other_are_in_contact() {
    let reach = 1.2 * 2.0 * Size::Small.radius();
    assert!(in_contact(0.98 * reach, 0));
    assert!(!in_contact(1.02 * reach, 0));
}

#[test]
fn a_wall_between_them_prevents_contact() {
    let upright = |base: &u8| {
        let walls = Layout::new(*base, None).expect("a layout").walls();
        walls.iter().any(|wall| wall.a.x == wall.b.x && wall.a.y.max(wall.b.y) > CENTRE.y + 6.0)
    };
    let base = (0..22).find(|base| upright(base)).expect("a layout with a wall above the centre");
    assert!(in_contact(1.7, 0));
    assert!(!in_contact(1.7, base));
}

/// With contacts between bodies, and walls, but the same positions, the answer differs.
#[test]
fn contacts_and_walls_are_seen() {
    let logits = |event: &ObservedEvent| {
        let nodes = Nodes::of(event);
        logits(&Batch::new(&[&nodes]).unwrap())
    };
    let reach = 1.2 * 2.0 * Size::Small.radius();
    let [touching, near, nearer] = [0.9999, 1.0001, 1.0003].map(|share| logits(&apart(share * reach, 0)));
    assert!(difference(&touching[0], &near[0]) > 10.0 * difference(&near[0], &nearer[0]));
    assert!(difference(&logits(&apart(8.0, 0))[0], &logits(&apart(8.0, 21))[0]) > 1e-4);
}

#[test]
fn the_order_of_rows_matters() {
    let straight = event(3, 12, 2, 0.0);
    let mut rows = straight.rows().to_vec();
    rows.reverse();
    let sizes = straight.object_sizes().to_vec();
    let back = ObservedEvent::new(straight.layout(), straight.agent_sizes(), sizes, rows).unwrap();
    assert_ne!(network().judge(&straight).unwrap(), network().judge(&back).unwrap());
}
