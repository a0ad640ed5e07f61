//! Plans, tested module by module.

mod contest;
mod generic;
mod plan;
mod random;
mod support;
mod value;
