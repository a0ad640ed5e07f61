//! High-level planning in PHASE: A* over symbolic states of both agents, subgoals and their value.
