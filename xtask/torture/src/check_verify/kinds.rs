//! The kinds of edits.

use super::{
    event_edits, file_edits,
    folder::{EditedCopy, Mends, Original},
};
use crate::error::TortureError;
use phase_model::random::Pcg64Mcg;

/// Whether there was anything to edit.
pub(super) type Made = Result<bool, TortureError>;
/// Makes an edit.
type Make = fn(&mut EditedCopy, &mut Pcg64Mcg, &Original) -> Made;

/// A kind of edits.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) mends: Mends,
    pub(super) make: Make,
}

const fn kind(name: &'static str, mends: Mends, make: Make) -> Kind {
    Kind { name, mends, make }
}

/// All kinds, accidents first. The last two make something genuine of the whole.
pub(super) const KINDS: [Kind; 44] = [
    kind("link to a copy of a file", Mends::Nothing, file_edits::link),
    kind("link to a copy of a folder", Mends::Nothing, file_edits::link_of_folder),
    kind("pipe in place of a file", Mends::Nothing, file_edits::pipe),
    kind("missing file", Mends::Nothing, file_edits::missing),
    kind("further file or folder", Mends::Nothing, file_edits::further),
    kind("byte of a file", Mends::Nothing, file_edits::byte),
    kind("stray bytes in a file", Mends::Nothing, file_edits::stray),
    kind("cut file", Mends::Nothing, file_edits::cut),
    kind("byte of a file", Mends::Checksums, file_edits::byte_listed),
    kind("stray bytes in a file", Mends::Checksums, file_edits::stray_listed),
    kind("white space in an event", Mends::Checksums, event_edits::white_space),
    kind("comment in an event", Mends::Checksums, event_edits::comment),
    kind("text of card, page or table", Mends::Checksums, file_edits::text),
    kind("value in the Parquet files", Mends::Checksums, file_edits::parquet),
    kind("videos exchanged", Mends::Checksums, file_edits::videos_exchanged),
    kind("video with two frames exchanged", Mends::Checksums, file_edits::frames_exchanged),
    kind("generator of an event", Mends::Checksums, |copy, random, _| {
        event_edits::member(copy, random, "generator")
    }),
    kind("settings of an event", Mends::Checksums, |copy, random, _| {
        event_edits::member(copy, random, "settings")
    }),
    kind("seed of an event", Mends::Checksums, |copy, random, _| event_edits::member(copy, random, "seed")),
    kind("thoughts", Mends::Checksums, |copy, random, _| event_edits::member(copy, random, "thoughts")),
    kind("subgoals or values", Mends::Checksums, event_edits::subgoals),
    kind("actions", Mends::Checksums, |copy, random, _| event_edits::member(copy, random, "actions")),
    kind("substeps", Mends::Checksums, |copy, random, _| event_edits::member(copy, random, "substeps")),
    kind("trajectory", Mends::Checksums, |copy, random, _| event_edits::member(copy, random, "trajectory")),
    kind("labels or scene", Mends::Checksums, event_edits::labels),
    kind("member of the manifest", Mends::Digest, file_edits::in_manifest),
    kind("white space in the manifest", Mends::Digest, file_edits::space_in_manifest),
    kind("generator everywhere", Mends::Everything, event_edits::generator_everywhere),
    kind("settings everywhere", Mends::Everything, event_edits::settings_everywhere),
    kind("seed of an event", Mends::Everything, |copy, random, _| event_edits::member(copy, random, "seed")),
    kind("seed of the dataset", Mends::Everything, event_edits::dataset_seed),
    kind("split of an event", Mends::Everything, event_edits::split),
    kind("variant of an event", Mends::Everything, event_edits::variant),
    kind("thoughts", Mends::Everything, |copy, random, _| event_edits::member(copy, random, "thoughts")),
    kind("subgoals and values", Mends::Everything, event_edits::pursued),
    kind("actions", Mends::Everything, |copy, random, _| event_edits::member(copy, random, "actions")),
    kind("substeps", Mends::Everything, event_edits::substeps_with_video),
    kind("labels or scene", Mends::Everything, event_edits::labels),
    kind("last step cut off", Mends::Everything, event_edits::last_step),
    kind("events exchanged", Mends::Everything, event_edits::events_exchanged),
    kind("order of the events", Mends::Everything, event_edits::order),
    kind("other genuine event", Mends::Everything, event_edits::other_event),
    kind("date of publication", Mends::Everything, event_edits::date),
    kind("other genuine dataset", Mends::Nothing, |copy, _, original| {
        copy.fill(&original.other()).map(|()| true)
    }),
];
