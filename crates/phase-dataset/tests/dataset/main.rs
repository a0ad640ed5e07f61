//! Events on disk, tested module by module.

mod atomic;
mod boxes;
mod cache;
mod checksum;
mod composition;
mod croissant;
mod describe;
mod folder;
mod import_pik;
mod import_socialgnn;
mod manifest;
mod parquet;
mod phase_events;
mod preset;
mod record;
mod splits;
mod summary;
#[path = "../../../phase-event/tests/events/support.rs"]
mod support;
mod verify;
