//! Random situations: A* against Dijkstra's algorithm, and helpers beside agents with an own errand.

mod helping;
mod problems;
mod search;
