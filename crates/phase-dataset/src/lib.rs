//! PHASE events at rest: formats, manifests, import and export.
