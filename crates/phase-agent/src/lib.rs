//! One PHASE agent's mind: belief to subgoal to action.
