//! Studies against what their documentation says.

mod assignment;
mod config;
mod session;
mod store;
mod support;
