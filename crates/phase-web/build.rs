//! Includes the playground's WebAssembly, if it has been built: `PHASE_PLAYGROUND` names the folder with
//! `phase.js` and `phase_bg.wasm`, as `cargo xtask playground` leaves it in `target/playground`.

use std::{env, error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-env-changed=PHASE_PLAYGROUND");
    let included = match env::var_os("PHASE_PLAYGROUND") {
        None => "None".to_owned(),
        Some(folder) => {
            let include = |name: &str| -> Result<String, Box<dyn Error>> {
                let path = fs::canonicalize(Path::new(&folder).join(name))?;
                println!("cargo::rerun-if-changed={}", path.display());
                Ok(format!("include_bytes!({:?})", path.display().to_string()))
            };
            format!("Some([{}, {}])", include("phase.js")?, include("phase_bg.wasm")?)
        }
    };
    let out = env::var_os("OUT_DIR").ok_or("no OUT_DIR")?;
    fs::write(Path::new(&out).join("wasm.rs"), format!("{included}\n"))?;
    Ok(())
}
