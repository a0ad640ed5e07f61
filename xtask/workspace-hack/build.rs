//! Nothing: packages that are built for the machine that builds get their features by a build script.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
}
