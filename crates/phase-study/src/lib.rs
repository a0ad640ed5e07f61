//! x
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod assignment;
pub mod config;
pub mod forms;
pub mod question;
pub mod record;
pub mod store;
pub mod study;
