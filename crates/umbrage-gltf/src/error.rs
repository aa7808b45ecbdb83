use std::fmt::Display;
use umbrage_plane::ViewError;

/// Why a glTF file cannot be read, or a scene cannot be written. Its text is one line, which names the field by its path in the
/// JSON, such as `meshes[3].primitives[0].attributes.POSITION`, the value there, and what was expected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// A field whose value cannot be used.
    #[error("{path}: {value}, expected {expected}")]
    Field {
        /// Where it stands: a path in the JSON, or a field of the binary container.
        path: String,
        /// What stands there.
        value: String,
        /// What would have been right.
        expected: String,
    },
    /// What should be JSON is not.
    #[error("json: {0}")]
    Json(String),
    /// An extension without which the file cannot be shown, and which is not supported.
    #[error("extensionsRequired: {name:?} is not supported")]
    Extension {
        /// The extension's name.
        name: String,
    },
    /// More memory than was allowed. Nothing of that size was allocated.
    #[error("{path}: {bytes} bytes are needed, {left} are left of the {most} that are allowed")]
    Budget {
        /// What needs it.
        path: String,
        /// How much it needs.
        bytes: u64,
        /// How much is left.
        left: u64,
        /// How much is allowed in all.
        most: u64,
    },
    /// A camera or a light that makes no view.
    #[error("{path}: {fault}")]
    View {
        /// The camera or light.
        path: String,
        /// What is wrong with it.
        fault: ViewError,
    },
    /// A file beside the scene, or the scene itself, that the system does not give.
    #[error("{path}: {fault}")]
    Io {
        /// The field that names the file, or the scene's own file.
        path: String,
        /// What the system said.
        fault: std::io::Error,
    },
    /// A fault of a file.
    #[error("{file}: {fault}")]
    In {
        /// The file's path as it was given, without line breaks.
        file: String,
        /// The fault.
        fault: Box<GltfError>,
    },
}

impl GltfError {
    /// A field whose value cannot be used.
    pub(crate) fn field(path: impl Into<String>, value: impl Display, expected: impl Display) -> Self {
        Self::Field { path: path.into(), value: value.to_string(), expected: expected.to_string() }
    }
}

/// Text from a file as it may stand in a line: in quotes, without line breaks, and not too long.
pub(crate) fn quoted(text: &str) -> String {
    const MOST: usize = 60;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{:?}..", &text[..end]),
        None => format!("{text:?}"),
    }
}
