//! The pages of PHASE, as files: the playground, which any web server can host, and those of the server.
//!
//! Key design decision: pages are plain HTML, CSS and JavaScript modules, without a bundler and without other
//! people's scripts, so that what is read here is what browsers run. The WebAssembly that they call is built
//! from `phase-playground`, by another target of the compiler, so it is not always there: a release of
//! `phase` includes it (`build.rs`), `cargo xtask playground` builds it. The trade-off is a command that has
//! to say so where it is missing.
//!
//! ```
//! let wasm = [&b"export default"[..], b"\0asm"];
//! let files = phase_web::playground(wasm);
//! assert!(files.iter().any(|file| file.path == "index.html"));
//! assert!(files.iter().any(|file| file.path == "phase_bg.wasm" && file.bytes == b"\0asm"));
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

/// A file of a page.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct File<'a> {
    /// Its path, relative to the page.
    pub path: &'static str,
    /// Its contents.
    pub bytes: &'a [u8],
}

/// Names of the two files that the tool `wasm-bindgen` makes.
pub const WASM: [&str; 2] = ["phase.js", "phase_bg.wasm"];

/// Contents of these files, if this build includes them.
const INCLUDED: Option<[&[u8]; 2]> = include!(concat!(env!("OUT_DIR"), "/wasm.rs"));

const PLAYGROUND: [(&str, &[u8]); 11] = [
    ("index.html", include_bytes!("../pages/playground/index.html")),
    ("playground.css", include_bytes!("../pages/playground/playground.css")),
    ("playground.js", include_bytes!("../pages/playground/playground.js")),
    ("editor.js", include_bytes!("../pages/playground/editor.js")),
    ("panels.js", include_bytes!("../pages/playground/panels.js")),
    ("keyboard.js", include_bytes!("../pages/playground/keyboard.js")),
    ("share.js", include_bytes!("../pages/playground/share.js")),
    ("simulator.js", include_bytes!("../pages/playground/simulator.js")),
    ("tracker.js", include_bytes!("../pages/playground/tracker.js")),
    ("video.js", include_bytes!("../pages/playground/video.js")),
    ("observer.js", include_bytes!("../pages/playground/observer.js")),
];

/// Files of a server beside the playground: the first page, the game, the admin page, and everything that the
/// pages of all studies share.
const SITE: [(&str, &[u8]); 15] = [
    ("index.html", include_bytes!("../pages/home/index.html")),
    ("home.js", include_bytes!("../pages/home/home.js")),
    ("site.css", include_bytes!("../pages/home/site.css")),
    ("play/index.html", include_bytes!("../pages/play/index.html")),
    ("play/play.css", include_bytes!("../pages/play/play.css")),
    ("play/play.js", include_bytes!("../pages/play/play.js")),
    ("play/arena.js", include_bytes!("../pages/play/arena.js")),
    ("play/keys.js", include_bytes!("../pages/play/keys.js")),
    ("admin/index.html", include_bytes!("../pages/admin/index.html")),
    ("admin/admin.js", include_bytes!("../pages/admin/admin.js")),
    ("admin/studies.js", include_bytes!("../pages/admin/studies.js")),
    ("study/study.js", include_bytes!("../pages/study/study.js")),
    ("study/study.css", include_bytes!("../pages/study/study.css")),
    ("study/forms.js", include_bytes!("../pages/study/forms.js")),
    ("study/connection.js", include_bytes!("../pages/study/connection.js")),
];

/// The page of a rating study; it belongs below `study/<name>/`.
pub const STUDY_PAGE: &[u8] = include_bytes!("../pages/study/index.html");

/// The page in place of the playground where there is no WebAssembly.
pub const NO_PLAYGROUND: &[u8] = include_bytes!("../pages/home/no-playground.html");

/// The files of a server's pages, less the playground. They need the server's interface.
pub fn site() -> impl Iterator<Item = File<'static>> {
    SITE.into_iter().map(|(path, bytes)| File { path, bytes })
}

/// The WebAssembly that this build includes, in the order of [`WASM`]; `None` if it was built without.
#[must_use]
pub const fn included() -> Option<[&'static [u8]; 2]> {
    INCLUDED
}

/// The files of the playground with this WebAssembly, in the order of [`WASM`].
#[must_use]
pub fn playground(wasm: [&[u8]; 2]) -> Vec<File<'_>> {
    let pages = PLAYGROUND.into_iter().chain(WASM.into_iter().zip(wasm));
    pages.map(|(path, bytes)| File { path, bytes }).collect()
}
