//! Machines that tests run as, by emulators.

use clap::ValueEnum;
use std::{path::Path, process::Command};

/// A machine other than this one.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum, Debug)]
pub(super) enum Machine {
    /// 64-bit ARM, by `qemu-aarch64`; needs `aarch64-linux-gnu-gcc` to link
    Aarch64,
    /// WebAssembly with 32-bit pointers and without vector instructions, by `node`
    Wasm,
}

impl Machine {
    /// The compiler's name of it.
    const fn target(self) -> &'static str {
        match self {
            Self::Aarch64 => "aarch64-unknown-linux-gnu",
            Self::Wasm => "wasm32-wasip1",
        }
    }

    /// Command that starts its programs. Paths in it are absolute: cargo starts tests in the folders of their
    /// packages.
    fn runner(self, root: &Path) -> Vec<String> {
        match self {
            // Where the linker for it has its libraries, too.
            Self::Aarch64 => ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"].map(str::to_owned).into(),
            Self::Wasm => {
                let host = root.join("xtask/golden/wasi.mjs").to_string_lossy().into_owned();
                vec!["node".into(), "--no-warnings".into(), host]
            }
        }
    }

    /// Has `cargo test` build for this machine and start what it builds.
    pub(super) fn prepare(self, root: &Path, tests: &mut Command) {
        let target = self.target();
        // Without rustup the compiler may have the target all the same; cargo says if it does not.
        let _ = Command::new("rustup").args(["target", "add", target]).current_dir(root).output();
        tests.args(["--target", target]);
        // A list of texts is the same in TOML as here.
        tests.arg("--config").arg(format!("target.{target}.runner={:?}", self.runner(root)));
        if self == Self::Aarch64 {
            tests.args(["--config", &format!("target.{target}.linker=\"aarch64-linux-gnu-gcc\"")]);
        }
    }
}
