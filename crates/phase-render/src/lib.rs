//! PHASE events as frames and video.
