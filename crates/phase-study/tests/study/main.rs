//! Studies against what their documentation says.

mod analysis;
mod assignment;
mod config;
mod design;
mod export;
mod jspsych;
mod session;
mod store;
mod support;
