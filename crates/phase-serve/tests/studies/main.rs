//! Rating studies over HTTP.

mod api;
mod files;
mod kill;
mod support;
