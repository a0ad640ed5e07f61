//! Files and folders, tested module by module.

mod atomic;
mod cache;
mod checksum;
mod folder;
mod measured;
mod new_folder;
mod regular;
mod run;
