//! Reading, replaying and statistics, on small synthetic records and engines whose errors are known.

mod family;
mod measure;
mod read;
mod replay;
mod spread;
mod support;
