//! What a PHASE agent sees and feels: a conical field of view with occlusion, and touch.
