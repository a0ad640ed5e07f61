//! Events at rest, tested module by module.

mod atomic;
mod cache;
mod checksum;
mod croissant;
mod folder;
mod import_pik;
mod manifest;
mod parquet;
mod phase_events_read;
mod phase_events_real;
mod phase_events_round_trip;
mod preset;
mod record;
mod splits;
mod summary;
mod support;
mod verify;
mod words;
