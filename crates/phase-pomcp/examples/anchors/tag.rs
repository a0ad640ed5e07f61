//! A robot that has to find and tag an opponent who moves away (Pineau, Gordon & Thrun 2003), by the rules of
//! DESPOT's sources.

use crate::episodes::Problem;
use phase_pomcp::{BeliefModel, GenerativeModel, PomcpSettings, Transition};
use rand::{Rng, RngExt};

/// The problem: 29 squares, two rows of ten and a block of three by three above them.
///
/// A move costs 1, a tag in vain 10, and tagging the opponent on the robot's square earns 10 and ends the
/// problem. The opponent sees the robot where it was before its move and moves away from it along each axis
/// with probability 0.4, to either side with 0.2 where it is on a line with the robot; otherwise it stays, as
/// it does where a wall is.
pub(crate) struct Tag {
    squares: Vec<[i8; 2]>,
}

/// A state: where both are, and what the default policy goes by.
#[derive(Clone, Copy)]
pub(crate) struct Chase {
    robot: [i8; 2],
    opponent: [i8; 2],
    /// The robot's last action.
    last: Option<usize>,
    /// Whether the robot saw the opponent on its square.
    sees: bool,
}

/// North, east, south and west.
const MOVES: [[i8; 2]; 4] = [[0, 1], [1, 0], [0, -1], [-1, 0]];
const TAG: usize = 4;

impl Tag {
    pub(crate) fn new() -> Self {
        let squares = (0..5).flat_map(|y| (0..10).map(move |x| [x, y]));
        Self { squares: squares.filter(|&square| is_inside(square)).collect() }
    }

    fn square(&self, random: &mut impl Rng) -> [i8; 2] {
        self.squares[random.random_range(0..self.squares.len())]
    }
}

fn is_inside([x, y]: [i8; 2]) -> bool {
    (0..10).contains(&x) && (0..2).contains(&y) || (5..8).contains(&x) && (2..5).contains(&y)
}

fn moved(from: [i8; 2], by: [i8; 2]) -> [i8; 2] {
    let to = [from[0] + by[0], from[1] + by[1]];
    if is_inside(to) { to } else { from }
}

/// Where the opponent goes. The probabilities along the axes add up to 0.8.
fn fled(opponent: [i8; 2], robot: [i8; 2], random: &mut impl Rng) -> [i8; 2] {
    let drawn = random.random_range(0..5);
    let axis = match drawn {
        0 | 1 => 0,
        2 | 3 => 1,
        _ => return opponent,
    };
    let away = (opponent[axis] - robot[axis]).signum();
    let mut by = [0; 2];
    by[axis] = if away != 0 {
        away
    } else if drawn % 2 == 0 {
        1
    } else {
        -1
    };
    moved(opponent, by)
}

impl GenerativeModel for Tag {
    type State = Chase;
    type Observation = ([i8; 2], bool); // where the robot is, and whether the opponent is there too

    fn action_count(&self) -> usize {
        5
    }

    fn discount(&self) -> f64 {
        0.95
    }

    fn step(&self, chase: &mut Chase, action: usize, random: &mut impl Rng) -> Transition<([i8; 2], bool)> {
        let tagged = action == TAG && chase.robot == chase.opponent;
        let reward = match action {
            TAG if tagged => 10.0,
            TAG => -10.0,
            _ => -1.0,
        };
        chase.opponent = fled(chase.opponent, chase.robot, random);
        if action != TAG {
            chase.robot = moved(chase.robot, MOVES[action]);
        }
        chase.last = Some(action);
        chase.sees = chase.robot == chase.opponent;
        Transition { observation: (chase.robot, chase.sees), reward, terminal: tagged }
    }

    /// As in POMCP's source: who sees the opponent tags it; otherwise any move that does not lead back or
    /// into a wall.
    fn rollout_action(&self, chase: &Chase, random: &mut impl Rng) -> usize {
        if chase.sees {
            return TAG;
        }
        let goes_on = |&action: &usize| {
            let is_back = chase.last.is_some_and(|last| last != TAG && (last + 2) % 4 == action);
            !is_back && moved(chase.robot, MOVES[action]) != chase.robot
        };
        let preferred = || (0..TAG).filter(goes_on);
        match preferred().count() {
            0 => random.random_range(0..TAG),
            count => preferred().nth(random.random_range(0..count)).unwrap_or(0),
        }
    }

    /// Tagging at random does not pay.
    fn prior_weight(&self, chase: &Chase, action: usize) -> f64 {
        match action {
            TAG if chase.sees => 4.0,
            TAG => 0.1,
            action if moved(chase.robot, MOVES[action]) == chase.robot => 0.1,
            _ => 1.0,
        }
    }
}

impl BeliefModel for Tag {
    /// Squares on which the opponent seldom is die out among the particles, and one day it is there. Then its
    /// square is known if the robot sees it, and otherwise may be any other.
    fn recover(
        &self,
        action: usize,
        &(robot, sees): &([i8; 2], bool),
        random: &mut impl Rng,
    ) -> Option<Chase> {
        let mut opponent = robot;
        while !sees && opponent == robot {
            opponent = self.square(random);
        }
        Some(Chase { robot, opponent, last: Some(action), sees })
    }
}

impl Problem for Tag {
    const SETTINGS: PomcpSettings = PomcpSettings {
        simulations: 1000,
        rollout_steps: 30,
        c_init: 0.8,
        c_base: 1e6,
        horizon: usize::MAX,
        normalise_values: true,
        stop_when_decided: false,
        convergence: 0.0,
        untried_first: false,
    };

    fn start(&self, random: &mut impl Rng) -> Chase {
        Chase { robot: self.square(random), opponent: self.square(random), last: None, sees: false }
    }

    /// The robot knows where it is, and nothing of the opponent.
    fn imagine(&self, chase: &Chase, random: &mut impl Rng) -> Chase {
        Chase { opponent: self.square(random), ..*chase }
    }
}
