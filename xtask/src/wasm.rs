//! Builds the playground's WebAssembly: compiles `phase-playground` for browsers and has `wasm-bindgen` write
//! what JavaScript loads.

use crate::{error::XtaskError, results::root};
use phase_cli::context::Context;
use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

const TARGET: &str = "wasm32-unknown-unknown";
const PROFILE: &str = "wasm";
const PACKAGE: &str = "phase-playground";
/// The tool has to have exactly the version of the library.
const TOOL: &str = "wasm-bindgen";

/// Builds it and returns the folder with `phase.js` and `phase_bg.wasm`.
///
/// # Errors
/// [`XtaskError::Build`] if a tool is missing or fails.
pub fn build(context: &Context) -> Result<PathBuf, XtaskError> {
    let root = root();
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    // Without rustup the compiler may have the target all the same; cargo says if it does not.
    let _ = Command::new("rustup").args(["target", "add", TARGET]).current_dir(root).output();
    context.note("compiling the playground for browsers, which takes minutes the first time");
    let cargo = || {
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.current_dir(root);
        cargo
    };
    let options = ["build", "--package", PACKAGE, "--target", TARGET, "--profile", PROFILE];
    run_tool("cargo build", cargo().args(options).arg("--target-dir").arg(&target))?;
    let version = version(root)?;
    let tools = target.join("tools");
    let tool = tools.join("bin").join(TOOL);
    let has = Command::new(&tool).arg("--version").output();
    let has = has.is_ok_and(|said| String::from_utf8_lossy(&said.stdout).contains(&version));
    if !has {
        context.note(format!("installing {TOOL} {version} in {}", tools.display()));
        // Without optimisation it takes seconds longer to run, and minutes less to build.
        let install = ["install", "wasm-bindgen-cli", "--bin", TOOL, "--debug", "--version", &version];
        run_tool("cargo install", cargo().args(install).args(["--force", "--root"]).arg(&tools))?;
    }
    let module = target.join(TARGET).join(PROFILE).join("phase_playground.wasm");
    let out = target.join("playground");
    let failed = |problem: String| XtaskError::Build { what: "the playground", problem };
    fs::create_dir_all(&out).map_err(|error| failed(format!("{}: {error}", out.display())))?;
    let options =
        ["--target", "web", "--no-typescript", "--remove-name-section", "--out-name", "phase", "--out-dir"];
    run_tool(TOOL, Command::new(&tool).args(options).arg(&out).arg(&module))?;
    Ok(out)
}

/// The version of the library, from the lock file.
fn version(root: &Path) -> Result<String, XtaskError> {
    let file = root.join("Cargo.lock");
    let lock = fs::read_to_string(&file).map_err(XtaskError::unreadable(&file))?;
    let mut lines = lock.lines().skip_while(|line| *line != "name = \"wasm-bindgen\"");
    let version = lines.nth(1).and_then(|line| line.strip_prefix("version = \"")?.strip_suffix('"'));
    version.map(str::to_owned).ok_or_else(|| XtaskError::Build {
        what: "the playground",
        problem: "Cargo.lock has no wasm-bindgen".into(),
    })
}

/// Runs a tool, named `what` in errors, and waits for its success.
pub(crate) fn run_tool(what: &'static str, command: &mut Command) -> Result<(), XtaskError> {
    let status = command.status();
    let status = status.map_err(|error| XtaskError::Build { what, problem: error.to_string() })?;
    if status.success() {
        return Ok(());
    }
    Err(XtaskError::Build { what, problem: format!("failed ({status}); see above") })
}
