//! The PHASE dynamics as a plain-data kernel that a planner can copy and step millions of times.
