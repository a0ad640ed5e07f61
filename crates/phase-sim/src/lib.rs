//! Two PHASE agents and a world make a social event.
