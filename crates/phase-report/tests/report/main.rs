//! Reports, tested module by module.

mod acceptance;
mod benchmark;
mod card;
mod document;
mod gallery;
mod summary;
mod support;
