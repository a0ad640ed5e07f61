//! Reading, replaying and statistics, on small records of our own and engines whose errors are known.

mod family;
mod measure;
mod read;
mod spread;
mod support;
