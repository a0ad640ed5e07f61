//! `playground`: the playground as static files.

use crate::{context::Context, error::CliError, output::print_result};
use clap::Args;
use phase_files::{WriteError, atomic, regular};
use phase_web::WASM;
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Options of `playground`.
#[derive(Args, Debug)]
pub struct Playground {
    /// Folder for the files, which any web server can host
    #[arg(long, value_name = "DIR", default_value = "out/playground")]
    pub out: PathBuf,
    /// Folder with phase.js and phase_bg.wasm, instead of those that this program includes
    #[arg(long, value_name = "DIR")]
    pub wasm: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// [`CliError::Usage`] if there is no WebAssembly, [`CliError::File`] if it cannot be read,
/// [`CliError::Output`] if a file cannot be written.
pub fn run(arguments: &Playground, context: &Context) -> Result<(), CliError> {
    let out = &arguments.out;
    let given = arguments.wasm.as_deref().map(read_wasm).transpose()?;
    let wasm = match &given {
        Some([script, code]) => [&script[..], &code[..]],
        None => phase_web::included().ok_or_else(|| {
            CliError::Usage(format!(
                "this {} includes no WebAssembly; `cargo xtask playground` in the source builds it, or --wasm names a folder with it",
                context.program.name
            ))
        })?,
    };
    let files = phase_web::playground(wasm);
    let bytes: usize = files.iter().map(|file| file.bytes.len()).sum();
    let failed = |source| WriteError { path: out.clone(), action: "create the folder", source };
    fs::create_dir_all(out).map_err(|source| CliError::Output(failed(source)))?;
    for file in &files {
        atomic::write(&out.join(file.path), file.bytes).map_err(CliError::Output)?;
    }
    print_result(format!(
        "{} files, {:.1} MB, in {}; host them with any web server, such as\npython3 -m http.server --bind 127.0.0.1 --directory {}",
        files.len(),
        bytes as f64 / 1e6,
        out.display(),
        out.display()
    ))
}

/// The two files of a folder, in the order of [`WASM`].
///
/// # Errors
/// [`CliError::File`].
pub fn read_wasm(folder: &Path) -> Result<[Vec<u8>; 2], CliError> {
    let file = |name: &str| regular::bytes(&folder.join(name));
    Ok([file(WASM[0])?, file(WASM[1])?])
}
