//! The page on which videos of a dataset with overlays can be watched, as its own can.

use super::{Rendered, Rendering, View};
use crate::{error::RunError, gallery_writer::GalleryWriter, source::SeenInput};
use phase_dataset::manifest::{MANIFEST_FILE, Manifest, PAGE_FILE};
use phase_files::checksum::FileEntry;
use phase_report::gallery::{Gallery, Timeline};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

impl View {
    /// A sentence about what it shows beside the bodies.
    const fn overlay(self) -> Option<&'static str> {
        match self {
            Self::World => None,
            Self::Belief(_) => Some("The videos show what one agent sees, believes and plans."),
            Self::Beliefs => Some("The videos show what both agents see, believe and plan."),
            Self::Observer(_) => Some("Below the videos is what SIMPLE makes of them."),
        }
    }
}

impl Rendering {
    /// Writes the page of videos with an overlay into their folder, if they are of a dataset; returns where
    /// it is. The page of the dataset itself is left alone.
    pub(super) fn write_page(
        &self,
        source: &SeenInput,
        folder: &Path,
        made: &[Rendered],
    ) -> Result<Option<PathBuf>, RunError> {
        let file = self.events.join(MANIFEST_FILE);
        let Some(overlay) = self.view.overlay() else { return Ok(None) };
        if self.contact_sheet.is_some() || !file.is_file() || folder.join(MANIFEST_FILE).exists() {
            return Ok(None);
        }
        let manifest = Manifest::read(&file)?;
        let gallery = Gallery {
            preset: &manifest.preset,
            generator: &manifest.generator,
            seed: manifest.seed,
            events: made.len(),
            overlay: Some(overlay),
        };
        let entries: BTreeMap<&str, _> = manifest.events.iter().map(|it| (it.id.as_str(), it)).collect();
        let mut pages = GalleryWriter::new(folder, gallery);
        for (index, rendered) in made.iter().enumerate() {
            let event = source.load(index)?;
            let (Some(&entry), Some(simulation)) = (entries.get(rendered.id.as_str()), event.simulation())
            else {
                continue;
            };
            let name = rendered.file.file_name().unwrap_or_default().to_string_lossy();
            let mut entry = entry.clone();
            entry.video = Some(FileEntry::of(folder, name)?);
            pages.push(entry, Timeline::of(&simulation.event))?;
        }
        pages.finish()?;
        Ok(Some(folder.join(PAGE_FILE)))
    }
}
