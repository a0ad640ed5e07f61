//! Reports, tested module by module.

mod acceptance;
mod benchmark;
mod card;
mod gallery;
mod published;
mod summary;
mod support;
