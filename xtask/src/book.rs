//! `book`: the documents as a book of pages, with every link inside it.
//!
//! Documents link to files elsewhere in the repository, which mdBook, whose source is one folder, would not
//! have. So the book's source is a copy of the documents and of what they link to, in the same places.

use crate::{
    error::XtaskError,
    results::root,
    tidy::{texts, walk},
    wasm::run_tool,
};
use clap::Args;
use phase_cli::output::print_result;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs, io, iter,
    path::{Path, PathBuf},
    process::Command,
};

/// The folder of the documents, with the book's settings and contents.
const DOCUMENTS: &str = "docs";
/// The first page.
const FIRST: &str = "README.md";
/// mdBook's name of it, and of every other of this name.
const INDEX: &str = "index.md";
/// The contents, as mdBook wants them at the top of its source.
const CONTENTS: &str = "SUMMARY.md";
/// The book's settings.
const SETTINGS: &str = "book.toml";
/// The tool and the command that installs it.
const MDBOOK: &str = "mdbook (cargo install mdbook --version 0.5.4 --locked)";
/// The heading of the documents that are elsewhere.
const ELSEWHERE: &str = "# Beside the documents";

/// Options of `book`.
#[derive(Args, Debug)]
pub struct Book {
    /// Folder for the pages; it is emptied
    #[arg(long, value_name = "DIR", default_value = "target/book")]
    pub out: PathBuf,
}

/// Copies the documents, has mdBook make pages of them and run their examples, and checks the links of the
/// pages.
///
/// # Errors
/// [`XtaskError`] if a file cannot be used, mdBook is missing or fails, or a page has a link to nothing.
pub fn run(options: &Book) -> Result<(), XtaskError> {
    let folder = root().join("target/book-source");
    let documents = assemble(root(), &folder)?;
    let out = std::path::absolute(&options.out).unwrap_or_else(|_| options.out.clone());
    let place = out.as_os_str();
    for arguments in [&["build".as_ref(), "--dest-dir".as_ref(), place][..], &["test".as_ref()]] {
        run_tool(MDBOOK, Command::new("mdbook").current_dir(&folder).args(arguments))?;
    }
    let broken = broken_links(&out).map_err(XtaskError::unreadable(&out))?;
    if let Some((page, link)) = broken.first() {
        let problem =
            format!("{}: links to {link}, which is not there ({} such links)", page.display(), broken.len());
        return Err(XtaskError::Build { what: "the book", problem });
    }
    print_result(format!("{documents} documents in {}", out.join("index.html").display()))?;
    Ok(())
}

/// Makes the book's source and returns the number of its documents.
fn assemble(root: &Path, folder: &Path) -> Result<usize, XtaskError> {
    let failed = XtaskError::unreadable;
    let read = |file: &Path| fs::read_to_string(root.join(file)).map_err(failed(file));
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed(folder))?;
    }
    let mut todo: Vec<PathBuf> = Vec::new();
    walk(&root.join(DOCUMENTS), &mut todo).map_err(failed(&root.join(DOCUMENTS)))?;
    let mut todo: Vec<PathBuf> =
        todo.into_iter().filter_map(|file| file.strip_prefix(root).map(Path::to_owned).ok()).collect();
    todo.push(FIRST.into());
    let mut copied: BTreeMap<PathBuf, String> = BTreeMap::new();
    while let Some(file) = todo.pop() {
        if copied.contains_key(&file) {
            continue;
        }
        let place = folder.join("src").join(place_of(&file));
        let parent = place.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(failed(parent))?;
        let mut title = String::new();
        if file.extension().is_none_or(|ending| ending != "md") {
            fs::copy(root.join(&file), &place).map_err(failed(&file))?;
        } else {
            let text = read(&file)?;
            let page =
                with_places(&if file.starts_with(DOCUMENTS) { text.clone() } else { without_tests(&text) });
            fs::write(&place, page).map_err(failed(&place))?;
            title = text.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or("Untitled").to_owned();
            let targets = texts::targets(&file, &text);
            todo.extend(targets.into_iter().filter(|target| root.join(target).is_file()));
        }
        copied.insert(file, title);
    }
    let text = read(&Path::new(DOCUMENTS).join(CONTENTS))?;
    let mut text = text.replace("](", &format!("]({DOCUMENTS}/")).replace(&format!("{DOCUMENTS}/../"), "");
    let elsewhere = |file: &Path| !file.starts_with(DOCUMENTS) && file != Path::new(FIRST);
    let others = copied.iter().filter(|(file, title)| elsewhere(file) && !title.is_empty());
    text.push_str(&format!("\n{ELSEWHERE}\n\n"));
    for (file, title) in others {
        text.push_str(&format!("- [{}]({})\n", title.replace(['[', ']', '`'], ""), file.display()));
    }
    let place = folder.join("src").join(CONTENTS);
    fs::write(&place, with_places(&text)).map_err(failed(&place))?;
    let settings = read(&Path::new(DOCUMENTS).join(SETTINGS))?.replace("src = \".\"", "src = \"src\"");
    fs::write(folder.join(SETTINGS), settings).map_err(failed(folder))?;
    Ok(copied.values().filter(|title| !title.is_empty()).count() - 1)
}

/// Place of a file in the book's source: a `README.md` is the page that mdBook calls `index.md`.
fn place_of(file: &Path) -> PathBuf {
    if file.ends_with(FIRST) { file.with_file_name(INDEX) } else { file.to_owned() }
}

/// A text with its links to a `README.md` led to where that lies in the book.
fn with_places(text: &str) -> String {
    let place = |text: String, end| text.replace(&format!("{FIRST}{end}"), &format!("{INDEX}{end}"));
    [")", "#"].into_iter().fold(text.to_owned(), place)
}

/// The page of a crate without tests: mdBook, which has none of the crates, cannot run the example. It is
/// that of the crate's documentation (`tidy`), which `cargo test` runs.
fn without_tests(text: &str) -> String {
    text.replace("```rust\n", "```rust,ignore\n")
}

/// Links of the pages to files that are not there: the page, and the link.
fn broken_links(out: &Path) -> io::Result<Vec<(PathBuf, String)>> {
    let mut all = Vec::new();
    walk(out, &mut all)?;
    let all: BTreeSet<&Path> = all.iter().filter_map(|file| file.strip_prefix(out).ok()).collect();
    let mut broken = Vec::new();
    for &page in all.iter().filter(|file| file.extension().is_some_and(|ending| ending == "html")) {
        // What a block of code shows is no link.
        let text = fs::read_to_string(out.join(page))?;
        let (first, others) = text.split_once("<code").unwrap_or((&text, ""));
        let others = others.split("<code").filter_map(|part| Some(part.split_once("</code>")?.1));
        let text: String = iter::once(first).chain(others).collect();
        let links = ["href=\"", "src=\""].into_iter().flat_map(|attribute| {
            text.split(attribute).skip(1).filter_map(|rest| rest.split('"').next()).collect::<Vec<_>>()
        });
        for link in links {
            let target = link.split(['#', '?']).next().unwrap_or_default();
            // The page of an address that was not found has links from the top of a site.
            let elsewhere = target.contains(':') || target.starts_with('/') || page.ends_with("404.html");
            if target.is_empty() || elsewhere {
                continue;
            }
            let place = texts::resolve(&page.parent().unwrap_or(Path::new("")).join(target));
            let there = |path: &Path| all.contains(path) || all.contains(path.join("index.html").as_path());
            if !place.is_some_and(|path| there(&path)) {
                broken.push((page.to_owned(), link.to_owned()));
            }
        }
    }
    Ok(broken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mdbook_is_asked_to_run_no_example_of_a_crate() {
        let folder = tempfile::tempdir().unwrap();
        assemble(root(), folder.path()).unwrap();
        let (source, mut pages) = (folder.path().join("src"), Vec::new());
        walk(&source, &mut pages).unwrap();
        pages.retain(|page| {
            page.extension().is_some_and(|ending| ending == "md") && !page.starts_with(source.join(DOCUMENTS))
        });
        assert!(pages.iter().any(|page| page.ends_with("phase-pomcp/index.md")));
        for page in pages {
            let text = fs::read_to_string(&page).unwrap();
            assert!(!text.lines().any(|line| line == "```rust"), "{}", page.display());
        }
    }
}
