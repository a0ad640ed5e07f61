//! `croissant.json`: the dataset in the vocabulary Croissant 1.0, for search engines and loaders.

use crate::{
    overview::Overview,
    parquet::{self, Description, ParquetFile},
};
use phase_files::checksum::FileEntry;
use serde_json::{Value, json};

/// The file's name.
pub const CROISSANT_FILE: &str = "croissant.json";

/// The description of a dataset whose Parquet files are described: every file that does not
/// belong to a single event with its checksum, and a record set for each Parquet file. The manifest itself,
/// which is written later, has the checksums of the events' own files.
#[must_use]
pub fn croissant(overview: &Overview, about: &str) -> String {
    let parts = parquet::parts(&overview.splits);
    let columns = parquet::descriptions();
    let mut value = json!({
        "@context": context(),
        "@type": "sc:Dataset",
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "name": name(overview),
        "description": about,
        "license": ["https://spdx.org/licenses/MIT", "https://spdx.org/licenses/Apache-2.0"],
        "version": "1.0.0",
        "citeAs": "Netanyahu, Shu, Katz, Barbu and Tenenbaum: PHASE: PHysically-grounded Abstract Social Events \
                   for Machine Social Perception. AAAI 2021.",
        "creator": {"@type": "sc:Organization", "name": overview.generator},
        "distribution": overview.files.iter().map(file).collect::<Vec<_>>(),
        "recordSet": parts.iter().map(|part| record_set(part, &parts, &columns)).collect::<Vec<_>>(),
    });
    if let Some(date) = &overview.date_published {
        value["datePublished"] = date.as_str().into();
    }
    format!("{value:#}\n")
}

/// The files with checksums in a description, for checking them against the manifest.
#[must_use]
pub fn checksums(description: &Value) -> Vec<(&str, &str)> {
    let files = description.get("distribution").and_then(Value::as_array).into_iter().flatten();
    files
        .filter_map(|file| Some((file.get("contentUrl")?.as_str()?, file.get("sha256")?.as_str()?)))
        .collect()
}

fn name(overview: &Overview) -> String {
    format!("{}-seed{}", overview.preset, overview.seed)
}

fn file(entry: &FileEntry) -> Value {
    let format = match entry.path.as_str().rsplit('.').next() {
        Some("parquet") => "application/x-parquet",
        Some("html") => "text/html",
        Some("md") => "text/markdown",
        Some("csv") => "text/csv",
        Some("json") => "application/json",
        _ => "application/octet-stream",
    };
    json!({
        "@type": "cr:FileObject", "@id": entry.path, "name": entry.path, "contentUrl": entry.path,
        "contentSize": format!("{} B", entry.bytes), "encodingFormat": format, "sha256": entry.sha256,
    })
}

/// The events of one file; named after the split, and the file's number if the split has several.
fn record_set(part: &ParquetFile, parts: &[ParquetFile], columns: &[Description]) -> Value {
    let files = parts.iter().filter(|other| other.split == part.split).count();
    let split = part.split.name();
    let name = if files == 1 { split.to_owned() } else { format!("{split}-{:05}", part.number) };
    let field = |column: &Description| field(&name, &part.path, column);
    json!({
        "@type": "cr:RecordSet", "@id": name, "name": name, "key": {"@id": format!("{name}/id")},
        "description": format!("{} events, one a record", part.events),
        "field": columns.iter().map(field).collect::<Vec<_>>(),
    })
}

fn field(record_set: &str, path: &str, column: &Description) -> Value {
    let data_type = match column.kind {
        "string" => "sc:Text",
        "bool" => "sc:Boolean",
        "float32" | "float64" => "sc:Float",
        _ => "sc:Integer",
    };
    let id = format!("{record_set}/{}", column.name);
    let mut field = json!({
        "@type": "cr:Field", "@id": id, "name": id, "description": column.sentence(), "dataType": data_type,
        "source": {"fileObject": {"@id": path}, "extract": {"column": column.name}},
    });
    if !column.shape.is_empty() {
        field["repeated"] = true.into();
    }
    field
}

/// The context that the standard prescribes.
fn context() -> Value {
    json!({
        "@language": "en", "@vocab": "https://schema.org/", "citeAs": "cr:citeAs", "column": "cr:column",
        "conformsTo": "dct:conformsTo", "cr": "http://mlcommons.org/croissant/",
        "rai": "http://mlcommons.org/croissant/RAI/", "data": {"@id": "cr:data", "@type": "@json"},
        "dataType": {"@id": "cr:dataType", "@type": "@vocab"}, "dct": "http://purl.org/dc/terms/",
        "equivalentProperty": "cr:equivalentProperty", "examples": {"@id": "cr:examples", "@type": "@json"},
        "extract": "cr:extract", "field": "cr:field",
        "fileProperty": "cr:fileProperty", "fileObject": "cr:fileObject", "fileSet": "cr:fileSet",
        "format": "cr:format", "includes": "cr:includes", "isLiveDataset": "cr:isLiveDataset",
        "jsonPath": "cr:jsonPath", "key": "cr:key", "md5": "cr:md5", "parentField": "cr:parentField",
        "path": "cr:path", "recordSet": "cr:recordSet", "references": "cr:references", "regex": "cr:regex",
        "repeated": "cr:repeated", "replace": "cr:replace", "samplingRate": "cr:samplingRate",
        "sc": "https://schema.org/",
        "separator": "cr:separator", "source": "cr:source", "subField": "cr:subField",
        "transform": "cr:transform",
    })
}
