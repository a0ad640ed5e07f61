//! SIMPLE, tested module by module.

mod choice;
mod forecast;
mod impression;
mod inference;
mod knowledge;
mod metropolis;
mod mind_kinds;
mod observer;
mod original;
mod posterior;
mod recordings;
mod strength;
mod unknown_goal;
