//! Nothing: the manifest of this crate asks for features of shared packages, so that every program of the
//! workspace is built with the same ones, and no package is built twice.

#![forbid(unsafe_code)]
#![deny(missing_docs)]
