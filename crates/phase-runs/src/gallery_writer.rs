//! Writing the pages on which events can be watched, one after the other, so that no more than the events of
//! one page are in memory.

use crate::error::RunError;
use phase_dataset::manifest::{EventEntry, PAGE_FILE};
use phase_files::{WriteError, checksum::FileEntry, measured};
use phase_report::gallery::{EVENTS_PER_PAGE, Gallery, PAGES_FOLDER, PageSummary, Timeline};
use std::path::Path;

/// The pages of a dataset so far.
#[derive(Debug)]
pub(crate) struct GalleryWriter<'a> {
    out: &'a Path,
    gallery: Gallery<'a>,
    events: Vec<EventEntry>,
    timelines: Vec<Timeline>,
    pages: Vec<PageSummary>,
    files: Vec<FileEntry>,
}

impl<'a> GalleryWriter<'a> {
    /// No page yet.
    #[must_use]
    pub(crate) const fn new(out: &'a Path, gallery: Gallery<'a>) -> Self {
        Self { out, gallery, events: Vec::new(), timelines: Vec::new(), pages: Vec::new(), files: Vec::new() }
    }

    /// Adds an event; writes a page when it is full.
    pub(crate) fn push(&mut self, entry: EventEntry, timeline: Timeline) -> Result<(), RunError> {
        self.events.push(entry);
        self.timelines.push(timeline);
        if self.events.len() == EVENTS_PER_PAGE { self.write_page() } else { Ok(()) }
    }

    /// Writes what is left, and returns all files.
    pub(crate) fn finish(mut self) -> Result<Vec<FileEntry>, RunError> {
        if !self.events.is_empty() {
            self.write_page()?;
        }
        if !self.gallery.is_one_page() {
            let text = self.gallery.index(&self.pages);
            self.files.push(measured::write(self.out, PAGE_FILE, text.as_bytes())?);
        }
        Ok(self.files)
    }

    fn write_page(&mut self) -> Result<(), RunError> {
        let number = self.pages.len();
        if number == 0 && !self.gallery.is_one_page() {
            let path = self.out.join(PAGES_FOLDER);
            std::fs::create_dir_all(&path).map_err(|source| WriteError {
                path,
                action: "create the folder",
                source,
            })?;
        }
        let text = self.gallery.page(number, &self.events, &self.timelines);
        self.files.push(measured::write(self.out, self.gallery.file(number), text.as_bytes())?);
        self.pages.extend(PageSummary::of(&self.events));
        self.events.clear();
        self.timelines.clear();
        Ok(())
    }
}
