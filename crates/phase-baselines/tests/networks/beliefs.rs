//! The belief network.

use crate::support::{event, random};
use phase_baselines::{
    belief_network::{BeliefNetwork, LabelledBeliefs, SETTINGS},
    training::{Network, TrainingRun},
};
use phase_event::{Beliefs, ObservedEvent, SEEN, certain};
use phase_model::{AgentId, Body, Flip, LandmarkId, RoomId, Vec2};

/// Numbers of a row and of every row after it.
fn all_steps(event: &ObservedEvent) -> Vec<usize> {
    (0..event.rows().len()).collect()
}

fn beliefs(network: &BeliefNetwork, event: &ObservedEvent) -> Vec<Beliefs> {
    network.beliefs(event, &all_steps(event)).expect("beliefs")
}

fn moved(event: &ObservedEvent, change: impl Fn(&mut Body)) -> ObservedEvent {
    let mut rows = event.rows().to_vec();
    rows.iter_mut().flatten().for_each(change);
    let sizes = event.object_sizes().to_vec();
    ObservedEvent::new(event.layout(), event.agent_sizes(), sizes, rows).expect("an event")
}

fn reflected(event: &ObservedEvent, flip: Flip) -> ObservedEvent {
    let event = moved(event, |body| {
        body.position = flip.point(body.position);
        body.velocity = flip.vector(body.velocity);
        body.angle = flip.angle(body.angle);
    });
    let (sizes, rows) = (event.object_sizes().to_vec(), event.rows().to_vec());
    ObservedEvent::new(event.layout().flipped(flip), event.agent_sizes(), sizes, rows).expect("an event")
}

/// The room that a room becomes; rooms have the numbers of their landmarks.
fn reflected_room(room: RoomId, flip: Flip) -> usize {
    usize::from(flip.landmark(LandmarkId::ALL[room.index()]))
}

/// The network does not know which room is which.
#[test]
fn a_reflected_event_has_the_reflected_beliefs() {
    let network = BeliefNetwork::new(6, &mut random(0)).expect("a network");
    // Nothing lies on a line between rooms, which belongs to one of them.
    let plain = moved(&event(3, 9, 2, 0.0), |body| body.position += Vec2::new(0.4, 0.3));
    let of_plain = beliefs(&network, &plain);
    for flip in Flip::ALL {
        let of_other = beliefs(&network, &reflected(&plain, flip));
        for (plain, other) in of_plain.iter().zip(&of_other) {
            for (plain, other) in AgentId::ALL.into_iter().flat_map(|k| plain[k].iter().zip(&other[k])) {
                assert!((plain[SEEN] - other[SEEN]).abs() < 1e-9, "{flip:?}");
                for room in RoomId::ALL {
                    let difference = plain[room.index()] - other[reflected_room(room, flip)];
                    assert!(difference.abs() < 1e-3, "{flip:?}, {room:?}: {plain:?} and {other:?}");
                }
            }
        }
    }
}

/// A loss over two events is the mean of theirs over all beliefs, whichever of them is longer.
#[test]
fn events_of_a_batch_do_not_touch_each_other() {
    let network = BeliefNetwork::new(6, &mut random(1)).expect("a network");
    // Every agent takes everything that it does not see to be in room 1.
    let labelled = |number: usize, rows: usize| {
        let event = event(number, rows, 2, 0.0);
        let all = AgentId::ALL.map(|_| vec![certain(1); 3]);
        let unseen = beliefs(&network, &event).iter().flatten().flatten().filter(|it| it[SEEN] < 1.0).count();
        (LabelledBeliefs::new(&event, &vec![all; rows]), unseen as f64)
    };
    let loss = |events: &[&LabelledBeliefs]| {
        f64::from(network.loss(events, None).expect("a loss").loss.to_scalar::<f32>().expect("a number"))
    };
    let (short, of_short) = labelled(1, 5);
    let (long, of_long) = labelled(2, 11);
    assert!(of_short > 0.0 && of_long > 0.0);
    let mean = (loss(&[&short]) * of_short + loss(&[&long]) * of_long) / (of_short + of_long);
    assert!((loss(&[&short, &long]) - mean).abs() < 1e-4, "{mean}");
}

/// It learns that nobody changes its belief about what it does not see.
#[test]
fn it_learns_that_beliefs_last() {
    let samples: Vec<LabelledBeliefs> = (0..8)
        .map(|number| {
            let event = event(number, 8, 2, 0.0);
            // The objects stand still, and so are where they were.
            let object = |k: usize| certain(room_of_object(&event, k));
            let truth = AgentId::ALL.map(|_| vec![certain(SEEN), object(0), object(1)]);
            LabelledBeliefs::new(&event, &vec![truth; 8])
        })
        .collect();
    let network = BeliefNetwork::new(8, &mut random(2)).expect("a network");
    let mut run = TrainingRun::new(network, 5, SETTINGS);
    let first = run.round(&samples, &samples).expect("a round").training.loss;
    let last = (0..2).map(|_| run.round(&samples, &samples).expect("a round").validation.clone()).last();
    let last = last.expect("rounds");
    assert!(last.loss < 0.5 * first, "{first} to {}", last.loss);
    assert!(last.scores[0] > 0.95, "{}", last.scores[0]);
}

fn room_of_object(event: &ObservedEvent, object: usize) -> usize {
    phase_model::layout::room_of(event.rows()[0][2 + object].position).index()
}
