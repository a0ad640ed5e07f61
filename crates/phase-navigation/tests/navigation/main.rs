//! Ways through the arena, tested module by module.

mod assemblies;
mod distances;
mod fields;
mod floors;
mod oracle;
mod rooms;
mod routes;
