//! `playground`.

use crate::support::{refuse, succeed, tree};
use std::{fs, path::Path};

#[test]
fn pages_and_webassembly_are_one_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    fs::create_dir(path.join("wasm")).expect("a folder");
    fs::write(path.join("wasm/phase.js"), "export default 1;").expect("written");
    let said = refuse(path, &["playground", "--wasm", "wasm", "--out", "site"]);
    assert!(said.contains("phase_bg.wasm"), "{said}");
    assert!(!path.join("site").exists());

    fs::write(path.join("wasm/phase_bg.wasm"), b"\0asm").expect("written");
    let told = succeed(path, &["playground", "--wasm", "wasm", "--out", "site"]);
    let site = tree(&path.join("site"));
    assert!(told.starts_with(&format!("{} files", site.len())), "{told}");
    assert_eq!(site[Path::new("phase_bg.wasm")], b"\0asm");
    // Whatever a page or a script names is there.
    let page = String::from_utf8_lossy(&site[Path::new("index.html")]).into_owned();
    let scripts = site.iter().filter(|(name, _)| name.extension().is_some_and(|it| it == "js"));
    let named =
        scripts.map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned()).collect::<String>() + &page;
    for name in named.split(['"', '\'']).filter(|it| it.ends_with(".js") || it.ends_with(".css")) {
        assert!(site.contains_key(Path::new(name.trim_start_matches("./"))), "{name}");
    }
    // Nothing is loaded from elsewhere, and nothing is written into the page as code.
    assert!(!named.contains("https://") && !named.contains("http://"));
    assert!(!page.contains("<script>") && !page.contains(" onclick="));
}

#[test]
fn without_webassembly_it_says_how_to_get_it() {
    if phase_web::included().is_some() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let said = refuse(folder.path(), &["playground", "--out", "site"]);
    assert!(said.contains("cargo xtask playground"), "{said}");
}
