//! A PHASE agent's belief: complete-world particles that are predicted, checked and redrawn.
