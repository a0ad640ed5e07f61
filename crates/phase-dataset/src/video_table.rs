//! `videos/metadata.csv`: the labels of every video, beside the videos, as the `videofolder` loader of the
//! `datasets` library reads them.

use crate::manifest::EventEntry;

/// The file, in a dataset's folder.
pub const VIDEO_TABLE_FILE: &str = "videos/metadata.csv";

/// Its first line. No value needs quoting: ids and names have neither commas nor quotes.
pub const VIDEO_TABLE_HEADER: &str = "file_name,id,kind,variant,relation,split,set,stance\n";

/// The row of an event; none if it has no video. Names of files are relative to the folder of the table.
#[must_use]
pub fn video_row(event: &EventEntry) -> Option<String> {
    let file = event.video.as_ref()?.path.name();
    let (set, stance) =
        event.set.as_ref().map_or(("", ""), |place| (place.set.as_str(), place.stance.name()));
    let fields = [
        file,
        &event.id,
        event.kind.name(),
        event.variant.map_or("", phase_sampler::Variant::name),
        event.relation.name(),
        event.split().name(),
        set,
        stance,
    ];
    Some(format!("{}\n", fields.join(",")))
}
