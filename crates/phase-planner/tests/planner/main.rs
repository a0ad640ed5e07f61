//! Plans, tested module by module.

mod contest;
mod feasible;
mod generic;
mod plan;
mod random;
mod support;
mod value;
