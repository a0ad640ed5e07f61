//! Events on disk, tested module by module.

mod boxes;
mod composition;
mod croissant;
mod event_cache;
mod import_counted;
mod import_pik;
mod import_predictions;
mod import_socialgnn;
mod leftovers;
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
