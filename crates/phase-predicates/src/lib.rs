//! On, Touch, Attach and Close: from physical to symbolic PHASE states.
