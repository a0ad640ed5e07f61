//! Random situations: A* against Dijkstra's algorithm, helpers beside agents with an own errand, and
//! hinderers.

mod helping;
mod hindering;
mod problems;
mod search;
