//! x
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod analysis;
pub mod assignment;
pub mod config;
pub mod export;
pub mod forms;
pub mod question;
pub mod record;
pub mod store;
pub mod study;
