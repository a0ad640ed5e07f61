//! Logistics: several carriers plan together. Trucks drive within their cities, an aeroplane between
//! airports, and parcels change from one to another.
//!
//! `cargo run --package phase-planner --example logistics`

use phase_planner::search::{SymbolicProblem, solve};

/// Places, by number; the airport of a city is its first place.
const CITIES: [&[usize]; 2] = [&[0, 1, 2], &[3, 4]];
/// Carriers: a truck for each city, and the aeroplane.
const TRUCKS: usize = CITIES.len();
const AEROPLANE: usize = TRUCKS;
/// What a move costs: of a truck, and of the aeroplane; loading and unloading cost 1.
const DRIVE: f32 = 2.0;
const FLIGHT: f32 = 10.0;

/// Where a parcel is: at a place, or in a carrier.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Parcel {
    At(usize),
    In(usize),
}

/// Places of the carriers, and the parcels.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct World {
    carriers: [usize; TRUCKS + 1],
    parcels: Vec<Parcel>,
}

/// What one carrier does.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Operation {
    carrier: usize,
    act: Act,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Act {
    Move(usize),
    Load(usize),
    Unload(usize),
}

/// Parcels with their destinations.
struct Logistics {
    destinations: Vec<usize>,
}

/// Places that a carrier can reach.
fn places(carrier: usize) -> Vec<usize> {
    if carrier == AEROPLANE { CITIES.map(|city| city[0]).to_vec() } else { CITIES[carrier].to_vec() }
}

impl SymbolicProblem for Logistics {
    type State = World;
    type Operator = Operation;

    fn successors(&self, world: &World) -> impl IntoIterator<Item = (Operation, World, f32)> {
        let mut successors = Vec::new();
        for (carrier, &here) in world.carriers.iter().enumerate() {
            let cost = if carrier == AEROPLANE { FLIGHT } else { DRIVE };
            for to in places(carrier).into_iter().filter(|&to| to != here) {
                let mut after = world.clone();
                after.carriers[carrier] = to;
                successors.push((Operation { carrier, act: Act::Move(to) }, after, cost));
            }
            for (k, parcel) in world.parcels.iter().enumerate() {
                let (act, there) = match *parcel {
                    Parcel::At(place) if place == here => (Act::Load(k), Parcel::In(carrier)),
                    Parcel::In(inside) if inside == carrier => (Act::Unload(k), Parcel::At(here)),
                    _ => continue,
                };
                let mut after = world.clone();
                after.parcels[k] = there;
                successors.push((Operation { carrier, act }, after, 1.0));
            }
        }
        successors
    }

    fn is_goal(&self, world: &World) -> bool {
        world.parcels.iter().zip(&self.destinations).all(|(parcel, &place)| *parcel == Parcel::At(place))
    }

    /// A parcel that is not at its destination has to be unloaded there, and loaded before, if it is not.
    fn heuristic(&self, world: &World) -> f32 {
        let left = |(parcel, &destination): (&Parcel, &usize)| match *parcel {
            Parcel::At(place) if place == destination => 0.0,
            Parcel::At(_) => 2.0,
            Parcel::In(_) => 1.0,
        };
        world.parcels.iter().zip(&self.destinations).map(left).sum()
    }
}

fn main() {
    // A parcel from the suburb 2 of the first city to the suburb 4 of the second, and one the other way as
    // far as the airport.
    let problem = Logistics { destinations: vec![4, 0] };
    let world = World { carriers: [0, 4, 0], parcels: vec![Parcel::At(2), Parcel::At(4)] };
    let plan = solve(&problem, world).expect("everything can be delivered");
    for carrier in 0..=AEROPLANE {
        let part: Vec<String> = plan
            .part(|operation| operation.carrier == carrier)
            .map(|(_, operation)| format!("{:?}", operation.act))
            .collect();
        println!("carrier {carrier}: {}", part.join(", "));
    }
    println!("cost {}", plan.cost);
    // The aeroplane flies there and back, and each truck makes two drives. One parcel travels in all three
    // carriers and the other in two, and is loaded and unloaded each time.
    assert_eq!(plan.cost, 2.0 * FLIGHT + 4.0 * DRIVE + 3.0 * 2.0 + 2.0 * 2.0);
}

#[test]
fn it_runs() {
    main();
}
